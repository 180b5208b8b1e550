"""What becomes of flights under faults: what judge and oracle say of each record, and the count of it all."""

from collections import Counter

from checker.judge.rendering import disagreement_text
from checker.statistics import exact_interval
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.judge.fault_study import is_alike
from tests.checker.judge.study_missions import Ready
from tests.executive.flying import Flown

LOST = "raised, or without an end"
BROKE = ("noticed", "MISSED")


def is_same(flown: Flown, right: Flown) -> bool:
    """Whether a flight executed the same and ended alike."""
    ours, theirs = flown.outcome, right.outcome
    return is_alike(flown, right) and (ours.abort and ours.abort.code) == (theirs.abort and theirs.abort.code)


def fate_of(mission: Ready, outcome: Outcome, record: MissionRecord) -> tuple[str, str]:
    """What judge and oracle say of a record that is another than it should be."""
    try:
        flown = mission.flown((outcome, record))
        found = mission.objections(flown)
    except (TypeError, KeyError, ValueError, AssertionError, IndexError) as problem:
        return "no record", repr(problem)
    said = [disagreement_text(one).splitlines()[0] for one in flown.report.disagreements]
    if found:
        return ("noticed", said[0]) if said else ("MISSED", found[0])
    return ("only the judge objects", said[0]) if said else ("another right mission", "")


class Tally:
    """How many faults had each fate, by kind."""

    def __init__(self) -> None:
        self.fates: Counter[str] = Counter()
        self.of_kinds: Counter[tuple[str, str]] = Counter()

    def add(self, kind: str, fate: str) -> None:
        """Count a fault."""
        self.fates[fate] += 1
        self.of_kinds[kind, fate] += 1

    def report(self) -> int:
        """Print the counts and, of what broke a model, the share that was noticed; how much was missed."""
        print(dict(sorted(self.fates.items())))
        for kind in sorted({kind for kind, _ in self.of_kinds}):
            _print_share(kind, self.of_kinds[kind, "noticed"], self.of_kinds[kind, "MISSED"])
        _print_share("all", self.fates["noticed"], self.fates["MISSED"])
        return self.fates["MISSED"]


def _print_share(kind: str, noticed: int, missed: int) -> None:
    if noticed + missed:
        low, high = exact_interval(noticed, noticed + missed, 0.95)
        of = f"{kind}: of {noticed + missed} faults with a record that breaks the model {noticed} noticed"
        print(f"{of}: {noticed / (noticed + missed):.3f} [{low:.3f} {high:.3f}]")
