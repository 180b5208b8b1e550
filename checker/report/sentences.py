"""The sentences that every form of the report shares."""

from checker.findings import Ending, Findings
from checker.oracle import CODE_NAMES, USER_CODE, Verdict
from checker.sampling.rendering import number
from checker.statistics import Rate

_ENDINGS = {Ending.SECONDS: "time was over", Ending.FAILURES: "failures enough"}


def percent(share: float) -> str:
    """A share as people read it, such as `5.5 %`."""
    return f"{_percentage(share)} %"


def counted(count: int, word: str) -> str:
    """`1 goal`, `2 goals`."""
    return f"{count} {word}{'' if count == 1 else 's'}"


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
    broken = f", {errors} not flown to the end because of an error {blamed(findings)}" if errors else ""
    return f"{name}: {flown}, {rate.failures} failed{broken}"


def blamed(findings: Findings) -> str:
    """Whose error kept missions from being flown."""
    is_ours = any(result.judgement.code != USER_CODE for result in findings.errors)
    return "of the tool" if is_ours else "in a constraint of the project"


def rate_line(rate: Rate) -> str:
    """The rate with its exact (Clopper-Pearson) interval."""
    level = number(rate.confidence * 100.0)
    return f"failure rate {percent(rate.observed)}; exact {level} % interval {_interval(rate.exact)}"


def decision(findings: Findings) -> str:
    """Whether the limit is kept, and how sure that is."""
    rate = findings.rate
    limit = f"the accepted {percent(rate.limit)}"
    if rate.missions == 0:
        return "no mission was flown to its end: nothing is known"
    if rate.exceeds:
        sure = "and the whole interval is" if rate.is_certain else "though the interval includes it: more missions tell"
        return f"FAILS: the rate is above {limit}, {sure}{' too' if rate.is_certain else ''}"
    sure = (
        "and so is the whole interval" if rate.is_certain else "though the interval reaches beyond: more missions tell"
    )
    return f"{'HOLDS' if findings.holds else 'UNDECIDED'}: the rate is within {limit}, {sure}"


def fault_title(findings: Findings, index: int) -> str:
    """What a bucket is: code, its meaning, how many missions and when."""
    bucket = findings.faults[index].bucket
    first, last = bucket.first_tick, bucket.last_tick
    when = f"at tick {first}" if first == last else f"at ticks {first} to {last}"
    name = CODE_NAMES.get(bucket.code, "unknown")
    return f"{bucket.code} {name}: {missions(len(bucket.missions))} ({percent(bucket.share)}), {when}"


def verdict_word(findings: Findings) -> str:
    """One word for the whole: holds, fails, interrupted, error."""
    if findings.is_interrupted:
        return "interrupted"
    if findings.rate.exceeds:
        return "fails"
    return "error" if findings.count(Verdict.ERROR) else "holds"


def _interval(bounds: tuple[float, float]) -> str:
    return f"{_percentage(bounds[0])} to {percent(bounds[1])}"


def _percentage(share: float) -> str:
    return number(round(share * 100.0, 2 if share < 0.1 else 1))
