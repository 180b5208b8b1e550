"""Study of minimal conflicts: failing missions of all models and their mutants, each conflict put to z3.

make conflict-study, or python -m tests.checker.conflict_study [missions [first]]

Each conflict that is printed for a failing mission is to contradict itself by the model's text, and to hold together
without any one of its parts. What has no translation, or is a constraint in Python, is counted apart; so are missions
that fail without a conflict. Two missions with the same conflict count once.
"""

import sys
import time
from collections import Counter
from itertools import count

from checker.causes import failed_by
from checker.proofs.conflict import Confirmation, Finding, confirm, needed_elements
from checker.proofs.places import ModelText, text_of
from runtime.executive.mission import run_mission
from runtime.executive.outcome import Conflict, Outcome
from tests.checker.judge.missions import GPS
from tests.executive.mutants.flights import FILES, Limits, Mutant, SlowError, at_most, mutant_of

_ROOT = GPS.parents[2]
_SECONDS, _UNTIL = 10.0, 4000  # of a flight, and its last tick
_SEEDS = 3  # missions of each mutant
_FILES = sorted({*FILES, *(_ROOT / "tests/checker/unseen").glob("*/mission.toml")})


def verdict_on(conflict: Conflict, text: ModelText) -> tuple[str, str]:
    """What z3 says of a conflict, and of what is left of it without each of its parts; and of what it says so."""
    found = confirm(conflict, text)
    if found.untranslated:
        return "untranslated", ", ".join(found.untranslated)
    if found.finding is not Finding.CONFIRMED:
        return found.finding.value, ""
    if found.called:
        return "with a constraint in Python", ""
    if not found.is_minimal:
        return "perhaps not minimal", ""
    return _each_is_needed(conflict, text, found)


def _each_is_needed(conflict: Conflict, text: ModelText, found: Confirmation) -> tuple[str, str]:
    shown = tuple(conflict.elements[number] for number in needed_elements(conflict, found))
    for dropped in range(len(shown)):
        rest = Conflict(tuple(one for number, one in enumerate(shown) if number != dropped))
        if confirm(rest, text).finding is not Finding.REFUTED:
            return "not minimal", repr(shown[dropped])
    return "confirmed", f"{len(shown)} parts"


def _conflicts(outcome: Outcome) -> list[Conflict]:
    told = failed_by(outcome).conflict
    repairs = outcome.abort.repairs if outcome.abort is not None else ()
    return [one for one in (told, *repairs) if one is not None]


def _of_mutant(mutant: Mutant, seen: Counter[str], known: set[tuple[str, Conflict]]) -> None:
    """Fly some missions of a mutant, and put the conflicts of those that fail to z3."""
    reactors = zip(mutant.agent.reactors, mutant.programs.programs, strict=True)
    text = text_of(mutant.agent, {one.model: program for one, program in reactors})
    for seed in range(_SEEDS if mutant.agent.parameters else 1):
        with at_most(_SECONDS):
            outcome = run_mission(mutant.agent, mutant.programs, seed, until=_UNTIL)
        if outcome.abort is None and not outcome.open_goals:
            continue
        seen["missions that fail"] += 1
        conflicts = _conflicts(outcome)
        seen["missions without a conflict"] += not conflicts
        seen["missions whose conflict was seen before"] += bool(conflicts) and (mutant.name, conflicts[0]) in known
        is_new = False
        for conflict in conflicts:
            if (mutant.name, conflict) in known:
                continue
            known.add((mutant.name, conflict))
            fate, what = verdict_on(conflict, text)
            seen[fate] += 1
            is_new = True
            if fate != "confirmed":
                print(mutant.name, seed, fate, what, sep="; ", flush=True)
        seen["missions"] += is_new


def study(missions: int, first: int) -> int:
    """Go on until so many failing missions had new conflicts; how many conflicts were not as they should be."""
    seen: Counter[str] = Counter()
    known: set[tuple[str, Conflict]] = set()
    begun = time.process_time()
    for number in count(first):
        if seen["missions"] >= missions:
            break
        _, mutant = mutant_of(number, _FILES, Limits())
        if mutant is None:
            continue
        try:
            _of_mutant(mutant, seen, known)
        except SlowError:
            seen["slow"] += 1
        except Exception as problem:
            seen["raised"] += 1
            print(mutant.name, "raised", repr(problem)[:200], sep="; ", flush=True)
        if number % 50 == 0:
            print(number, dict(seen), f"{time.process_time() - begun:.0f} s", flush=True)
    print(dict(sorted(seen.items())), f"{time.process_time() - begun:.0f} s")
    return sum(seen[fate] for fate in ("not confirmed", "undecided", "perhaps not minimal", "not minimal"))


if __name__ == "__main__":
    _MISSIONS = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    sys.exit(study(_MISSIONS, int(sys.argv[2]) if len(sys.argv) > 2 else 0) > 0)
