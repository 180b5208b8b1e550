"""The sentences that every form of the report shares."""

from collections import Counter

from checker.counterfactual.tried import TrialsEnd
from checker.findings import Ending, Findings, regressed
from checker.limits import Limit
from checker.oracle import CODE_NAMES, OUT_OF_TIME, USER_CODE, Verdict
from checker.rate import Method, Rate
from checker.regression import FlownCase
from checker.rendering import failure_text
from checker.sampling.rendering import number
from checker.statistics import Interval
from nddl_lang.text.printable import counted

_ENDINGS = {
    Ending.SECONDS: "time was over",
    Ending.FAILURES: "failures enough",
    Ending.DECIDED: "decided",
    Ending.STUCK: "none came to its end in time",
}
_METHODS = {
    Method.EXACT: "exact {level} % interval",
    Method.SEQUENCE: "{level} % confidence sequence",
    Method.WEIGHTED: "{level} % interval of weighted missions",
}

_MOST_CASES = 8


def percent(share: float) -> str:
    """A share as people read it, such as `5.5 %`."""
    return f"{_percentage(share)} %"


def explained_by(findings: Findings, number: int, quote: str = "") -> str:
    """The command that explains a mission, as it can be followed; `quote` stands on both sides of it."""
    if findings.is_stored:
        return f"{quote}nddlc explain {findings.run_id}#{number}{quote}"
    return f"{quote}nddlc explain latest#{number}{quote} after a check without --no-store"


def missions(count: int) -> str:
    """`1 mission`, `2 missions`."""
    return counted(count, "mission")


def headline(findings: Findings) -> str:
    """How many missions failed, in one line."""
    rate = findings.rate
    name = findings.agent.name
    flown = f"{missions(len(findings.results))}"
    if findings.is_interrupted:
        flown += f" of {findings.planned} (interrupted)"
    elif findings.ending is not Ending.COMPLETE:
        flown += f" of {findings.planned} ({_ENDINGS[findings.ending]})"
    errors = len(findings.errors)
    why = f"because of an error {origin}" if (origin := _origin_of_errors(findings)) else "in time"
    broken = f", {errors} not flown to the end {why}" if errors else ""
    return f"{name}: {flown}, {rate.failures} failed{broken}"


def _origin_of_errors(findings: Findings) -> str:
    """Whose error kept missions from being flown; empty where they took too long."""
    codes = {result.judgement.code for result in findings.errors}
    if codes == {OUT_OF_TIME}:
        return ""
    return "in a constraint of the project" if codes <= {USER_CODE, OUT_OF_TIME} else "of the tool"


def errors_title(findings: Findings) -> str:
    """What missions that were not flown to their end are called."""
    origin = _origin_of_errors(findings)
    return f"errors {origin}" if origin else "missions that took too long"


def observed_share(rate: Rate) -> str:
    """The share of missions that failed; of none nothing is known."""
    return percent(rate.observed) if rate.counted else "not known"


def rate_line(rate: Rate) -> str:
    """The rate with its interval; where there is none, why."""
    level = number(rate.confidence * 100.0)
    if not rate.counted:
        return "failure rate: not known"
    if rate.interval is None:
        share = f"{percent(rate.observed)} of the missions failed"
        return f"{share}; no interval: a design chose them, so that they are not independent"
    basis, placed = "", ""
    if rate.has_gaps:
        basis = f" in the {missions(rate.counted)} before the first one still in flight"
    elif rate.counted < rate.missions:
        basis = f" in the {missions(rate.counted)} that no design chose"
        failed = rate.failures - rate.counted_failures
        placed = f"; {failed} of the {rate.missions - rate.counted} that the design chose failed" if failed else ""
    elif rate.method is Method.WEIGHTED:
        basis = f" ({rate.failures} of {rate.missions} missions failed, where failures were sought)"
    method = _METHODS[rate.method].format(level=level)
    return f"failure rate {percent(rate.observed)}{basis}; {method} {_interval_text(rate.interval)}{placed}"


def stop_line(findings: Findings) -> str:
    """What the stopping rule came to; empty without one."""
    sampling = findings.sampling
    if not sampling.rule:
        return ""
    fate = {True: "shown", False: "refuted", None: "still open"}[sampling.shown]
    return f"{sampling.rule}: {fate} after {missions(len(findings.results))}"


def cut_line(findings: Findings) -> str:
    """What a signal kept from being sought; empty where nothing."""
    if not findings.is_cut:
        return ""
    faults = [str(index + 1) for index, fault in enumerate(findings.faults) if fault.is_cut]
    left = f", the condition of {'fault' if len(faults) == 1 else 'faults'} {', '.join(faults)}" if faults else ""
    sought = [str(k + 1) for k, one in enumerate(findings.faults) if one.causes.ended is TrialsEnd.CANCELLED]
    causes = f"causes of {'fault' if len(sought) == 1 else 'faults'} {', '.join(sought)} (in part)" if sought else ""
    return f"interrupted after all missions; left out: {(causes + left).removeprefix(', ')}"


def case_lines(findings: Findings) -> list[str]:
    """What became of the regression cases; none without any."""
    cases = findings.cases
    if not cases:
        return []
    failing = [one for one in cases if not one.passes]
    still = f"{len(failing)} still fail" if failing else "none of them fails any more"
    lines = [f"{counted(len(cases), 'regression case')} flown first: {still}"]
    for one in failing[:_MOST_CASES]:
        why = failure_text(one.result.judgement, one.result.open_goals)
        was = f" ({one.case.was})" if one.case.was not in ("", one.result.judgement.code) else ""
        lines.append(f"{case_name(one)}{was}: {' '.join(filter(None, (one.result.judgement.code, why)))}")
    return [*lines, *([f"{len(failing) - _MOST_CASES} more"] if len(failing) > _MOST_CASES else [])]


def case_name(one: FlownCase) -> str:
    """A promoted case by its name; `k3` for the third of the failures that the store has kept."""
    if one.case.is_promoted:
        return f"case `{one.case.name}`"
    return f"k{-one.result.number}" if one.result.number < 0 else f"mission {one.result.number}"


def sensitivity_line(findings: Findings) -> str:
    """The parameters that drive failing; empty where none can be told from chance."""
    telling = [one for one in findings.sensitivities if round(one.interval[0], 2) > 0.0]
    if not telling:
        return ""
    listed = [
        f"{one.parameter} {number(round(one.distance, 2))} "
        f"({number(round(one.interval[0], 2))} to {number(round(one.interval[1], 2))})"
        for one in telling
    ]
    return f"failing depends on {', '.join(listed)} (distance of its draws from chance, 0 to 1)"


def decision(findings: Findings) -> str:
    """Whether the limit is kept, and how sure that is."""
    rate = findings.rate
    limit = f"the accepted {percent(rate.limit)}"
    if rate.missions == 0:
        return "no mission was flown to its end: nothing is known"
    failing = regressed(findings.cases, rate.limit)
    if failing and (rate.observed <= rate.limit):
        return f"FAILS: {counted(len(failing), 'regression case')} still {'fails' if len(failing) == 1 else 'fail'}"
    is_outside = rate.interval is not None and not rate.interval[0] <= rate.limit <= rate.interval[1]
    if rate.exceeds and rate.is_certain and not is_outside:
        return f"FAILS: no mission may fail, and {rate.failures} of {missions(rate.missions)} did"
    if rate.interval is None:
        word = "FAILS" if rate.exceeds else "HOLDS" if findings.holds else "UNDECIDED"
        side = "above" if rate.exceeds else "within"
        return f"{word}: the share is {side} {limit}; how sure that is a design does not tell"
    if rate.exceeds and rate.observed <= rate.limit:
        beside = rate.failures - rate.counted_failures
        return (
            f"FAILS: {rate.failures} of {missions(rate.missions)} failed, {beside} of them chosen by the sampler, and "
            f"those flown at random do not show that the rate is within {limit}"
        )
    if rate.exceeds:
        sure = "and the whole interval is" if rate.is_certain else "though the interval includes it: more missions tell"
        return f"FAILS: the rate is above {limit}, {sure}{' too' if rate.is_certain else ''}"
    sure = (
        "and so is the whole interval" if rate.is_certain else "though the interval reaches beyond: more missions tell"
    )
    return f"{'HOLDS' if findings.holds else 'UNDECIDED'}: the rate is within {limit}, {sure}"


def repaired_line(findings: Findings) -> str:
    """How many missions passed after a repair, where nobody has said how many repairs are too many."""
    passed = sum(one.verdict is Verdict.PASS and one.losses.repaired > 0 for one in findings.results)
    if not passed or any(limit is Limit.REPAIRS for limit, _ in findings.mission.check.limits):
        return ""
    return (
        f"{missions(passed)} passed after repairs, which may set aside what a rule says of what was over by then: "
        "`max_repairs = 0` in [check] makes such missions fail"
    )


def fault_title(findings: Findings, index: int) -> str:
    """What a bucket is: code, its meaning, how many missions and when."""
    bucket = findings.faults[index].bucket
    first, last = bucket.first_tick, bucket.last_tick
    when = f"at tick {first}" if first == last else f"at ticks {first} to {last}"
    name = CODE_NAMES.get(bucket.code, "unknown")
    interval = findings.faults[index].interval
    rate = "" if interval is None else f"; rate {_interval_text(interval)}"
    alike = set(bucket.missions)
    codes = Counter(one.judgement.code for one in findings.results if one.number in alike)
    others = ", ".join(f"{count} of them {code}" for code, count in codes.items() if code != bucket.code)
    among = f" ({percent(bucket.share)}{f'; {others}' if others else ''})"
    return f"{bucket.code} {name}: {missions(len(bucket.missions))}{among}, {when}{rate}"


def verdict_word(findings: Findings) -> str:
    """One word for the whole: holds, fails, interrupted, error, unknown."""
    if findings.is_interrupted:
        return "interrupted"
    if findings.rate.exceeds:
        return "fails"
    if findings.count(Verdict.ERROR):
        return "error"
    return "unknown" if findings.is_unknown else "holds"


def _interval_text(bounds: Interval) -> str:
    """`1.2 to 3.4 %`."""
    return f"{_percentage(bounds[0])} to {percent(bounds[1])}"


def _percentage(share: float) -> str:
    return number(round(share * 100.0, 2 if share < 0.1 else 1))
