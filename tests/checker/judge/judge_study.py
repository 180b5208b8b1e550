"""Study of the judge's reach: faults in the source of engine and executive, flown, put to the judge and to an oracle.

make judge-study, or NDDLC_INTERPRETED=1 python -m tests.checker.judge.judge_study [faults [first [mission ...]]]

Each fault is one changed node of a line that missions run, of one of six kinds in turn, always or at some moments. It
is flown in a process of its own, by missions that run its line, until a record breaks its model; record and trace are
judged here, where nothing is broken. Whether a record breaks the model the plain oracle says, which shares nothing with
the judge; nothing about a fault or a mission is chosen by what the judge says.
"""

import gc
import sys
from pathlib import Path
from random import Random

import runtime.build_form
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.judge.aimed_faults import KINDS, Targets
from tests.checker.judge.faults import EndlessError, at_most
from tests.checker.judge.source_faults import SourceFault
from tests.checker.judge.study_fates import BROKE, LOST, Tally, fate_of, is_same
from tests.checker.judge.study_missions import (
    NAMES,
    ROOT,
    apart,
    functions_of_the_engine,
    ready,
    stand_of,
)
from tests.executive.flying import Flown

_SECONDS, _OF_EACH_FLIGHT = 20, 3.0
_FLIGHTS, _CHANGED, _LOST = 8, 4, 2  # missions of a fault, at most; of those changed records, and those lost
Flights = list[tuple[int, Outcome, MissionRecord]]


class _Study:
    """Missions, the places in the source that they run, and what became of the faults there."""

    def __init__(self, names: tuple[str, ...]) -> None:
        stands = [stand_of(mission) for mission in ready(names)]
        self.stands = [stand for stand in stands if stand is not None]
        lines: dict[str, set[int]] = {}
        for stand in self.stands:
            for file, found in stand.lines.items():
                lines.setdefault(file, set()).update(found)
        self.targets = Targets(lines, str(ROOT / "runtime") + "/")
        self.functions = functions_of_the_engine()
        self.tally = Tally()
        gc.freeze()  # what is here already need not be looked at, nor copied, in any process of a fault

    def put(self, fault: SourceFault, dice: Random) -> tuple[str, str, str]:
        """Fly a fault: its fate, the mission that showed it, and what was said."""
        numbers = [n for n, one in enumerate(self.stands) if fault.place.line in one.lines.get(fault.place.file, ())]
        dice.shuffle(numbers)
        changed: Flights | None = apart(lambda: self._changed(fault, numbers[:_FLIGHTS]), _SECONDS)
        if changed is None:
            return LOST, "", ""
        fate, where, what = "alike", "", ""
        for number, outcome, record in changed:
            stand = self.stands[number]
            found, said = fate_of(stand.mission, outcome, record)
            if fate == "alike" or found in BROKE:
                fate, where, what = found, stand.mission.name, said
            if found in BROKE:
                break
        return fate, where, what

    def _changed(self, fault: SourceFault, numbers: list[int]) -> Flights | None:
        """The first flights of a fault that are others than they should be; in the process of the fault."""
        fault.put_in_place(self.functions)
        found: Flights = []
        lost = 0
        for number in numbers:
            stand = self.stands[number]
            fault.count_anew()
            try:
                with at_most(_OF_EACH_FLIGHT):
                    outcome, record = stand.mission.fly()
                flown = Flown(stand.right.agent, stand.right.programs, outcome, record, stand.right.report)
                if not is_same(flown, stand.right):
                    found.append((number, outcome, record))
            except (Exception, EndlessError):  # the engine is broken, it may raise anything
                lost += 1
            if lost == _LOST or len(found) == _CHANGED:
                break
        return found if found or not lost else None


def study(count: int, first: int, names: tuple[str, ...]) -> int:
    """Fly so many faults; how many records break the model and are not noticed."""
    all_of_it = _Study(names)
    print(len(all_of_it.stands), "missions", flush=True)
    for number in range(first, first + count):
        dice = Random(number)
        kind = KINDS[number % len(KINDS)]
        fault = all_of_it.targets.fault(dice, kind)
        if fault is None:
            continue
        fate, mission, said = all_of_it.put(fault, dice)
        all_of_it.targets.note(kind, fault, broke=fate in BROKE)
        all_of_it.tally.add(kind, fate)
        place = fault.place
        where = f"{Path(place.file).relative_to(ROOT)}:{place.line} {place.function}"
        changed = f"{place.change} {place.text[:60]!r} {fault.moment} {fault.nth}"
        print(number, kind, where, changed, fate, mission, said, sep="; ", flush=True)
    return all_of_it.tally.report()


if __name__ == "__main__":
    assert runtime.build_form.build_form() != "compiled", "functions of the compiled engine cannot be replaced"
    _COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    _FIRST = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    sys.exit(study(_COUNT, _FIRST, tuple(sys.argv[3:]) or NAMES) > 0)
