"""Study of the judge's reach: faults of fixed schemes at places of models and moments that chance draws.

make judge-study, or NDDLC_INTERPRETED=1 python -m tests.checker.judge.placed_study [faults [first [mission ...]]]

The schemes are those of `faults.py`: a constraint of one line is never propagated, every third observation is lost, an
edge is a tick off. Each fault is flown in a process of its own, by missions that chance draws, until a record breaks
its model; whether it does the plain oracle says, in a process where nothing is broken.
"""

import gc
import sys
from random import Random
from typing import Any

import runtime.build_form
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.judge.faults import Fault, broken, faults
from tests.checker.judge.study_fates import BROKE, LOST, Tally, fate_of, is_same
from tests.checker.judge.study_missions import NAMES, Ready, apart, ready
from tests.executive.flying import Flown

_SECONDS, _MISSIONS = 8, 3
_SPANS = (20, 60, 150)  # pieces of text of a model: small ones are hit more often than large ones


class _Missions:
    """Missions with their right flights, which are made when they are first asked for."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.all = list(ready(names))
        self.rights: dict[str, Flown] = {}
        gc.freeze()

    def right(self, mission: Ready) -> Flown:
        """The right flight, to which neither judge nor oracle objects."""
        if mission.name not in self.rights:
            flown = mission.flown(apart(mission.fly, 10 * _SECONDS))
            assert flown.report.holds, f"the judge objects to {mission.name}: {flown.report.disagreements[0]}"
            assert not mission.objections(flown), f"the oracle objects to {mission.name}: {mission.objections(flown)}"
            self.rights[mission.name] = flown
        return self.rights[mission.name]

    def put(self, fault: Fault, dice: Random) -> tuple[str, str, str]:
        """Fly a fault by some missions: its fate, the mission that showed it, and what was said."""
        fate, where, what = "alike", "", ""
        for mission in dice.sample(self.all, min(_MISSIONS, len(self.all))):
            right = self.right(mission)
            result = apart(lambda mission=mission: _fly(fault, mission), _SECONDS)  # type: ignore[misc]
            if result is None:
                found, said = LOST, ""
            elif is_same(right._replace(outcome=result[0], record=result[1]), right):
                continue
            else:
                found, said = fate_of(mission, *result)
            if fate in ("alike", LOST) or found in BROKE:
                fate, where, what = found, mission.name, said
            if found in BROKE:
                break
        return fate, where, what


def _fly(fault: Fault, mission: Ready) -> tuple[Outcome, MissionRecord]:
    with broken(fault):
        return mission.fly()


def study(count: int, first: int, names: tuple[str, ...]) -> int:
    """Fly so many faults; how many records break the model and are not noticed."""
    missions = _Missions(names)
    tally = Tally()
    known: set[Any] = set()
    for number in range(first, first + count):
        dice = Random(number)
        fault = dice.choice(faults(dice, dice.choice(_SPANS)))
        if (fault.kind, fault.name) in known:
            continue
        known.add((fault.kind, fault.name))
        fate, mission, said = missions.put(fault, dice)
        tally.add(fault.kind, fate)
        print(number, fault.kind, f"{fault.function}: {fault.name}", fate, mission, said, sep="; ", flush=True)
    return tally.report()


if __name__ == "__main__":
    assert runtime.build_form.build_form() != "compiled", "functions of the compiled engine cannot be replaced"
    _COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    _FIRST = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    sys.exit(study(_COUNT, _FIRST, tuple(sys.argv[3:]) or NAMES) > 0)
