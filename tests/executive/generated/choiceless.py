"""Random simulators of all relations that register code knows, flown by both engines, every tick visited or not.

    python -m tests.executive.generated.choiceless [COUNT [FIRST]]    COUNT simulators (100) from seed FIRST on (0)

Prints each seed whose four flights differ, or with which the judge disagrees, and exits with 1 then.
"""

import random
import sys
from dataclasses import replace

from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import Outcome
from runtime.limits import LimitError
from tests.executive.determined_models import Case
from tests.executive.flying import in_all_ways, simulator

_UNTIL = 30
_BOUNDED = 20_000  # the first seed whose goals say when to end, and are taken back
_TYPES = ("int k;", "Some k;", "Few k;", "int k = LIMIT;", "int k;")
_VALUES = ("n", "n + 1", "n - 1", "1", "2", "3", "0", "n * 2", "7 - n")
_KINDS = ("lasts", "told", "least", "most", "end", "next", "far", "together", "within", "before", "draw", "guard")


def _line(chance: random.Random, lines: int, mine: int, depth: int) -> str:
    """One line of a rule; `n` is a parameter of its token."""
    others = [each for each in range(lines) if each != mine] or [mine]
    other, name = chance.choice(others), f"x{chance.randrange(10**6)}"
    value = f"{name}.k == {chance.choice(_VALUES)};"
    length = chance.choice(("", "", f" {name}.duration == {chance.choice(_VALUES)};"))
    match chance.choice(_KINDS):
        case "lasts":
            return f"duration == {chance.choice((1, 2, 3, 4, 6))};"
        case "told":
            return f"duration == {chance.choice(_VALUES)};"
        case "least":
            return f"duration >= {chance.choice((1, 2, 3, 'n'))};"
        case "most":
            return f"duration <= {chance.choice((2, 3, 5, 'n'))};"
        case "end":
            return f"end <= {chance.choice((15, 20, 'start + n'))};"
        case "next":
            return f"meets(object.Q {name}); {value}{length}"
        case "far":
            return f"meets(T{other}.Q {name}); {value}{length}"
        case "together":
            return f"{chance.choice(('equals', 'starts'))}(T{other}.Q {name}); {value}"
        case "within":
            return f"{chance.choice(('contained_by', 'starts_during', 'ends'))}(T{other}.{chance.choice('DQ')} {name});"
        case "before":
            return f"met_by(object.{chance.choice('DDQ')} {name});"
        case "draw":
            return f"int {name}; {name} == sampledParameter(LAG); duration == {name};"
        case _ if depth < 2:
            then, otherwise = (_line(chance, lines, mine, depth + 1) for _ in range(2))
            condition = f"bool {name}; {name} == (n < {chance.choice((1, 2, 3))});"
            return f"{condition} if ({name}) {{ {then} }} else {{ {otherwise} }}"
        case _:
            return ""


def _text(chance: random.Random, lines: int) -> str:
    found = ["typedef int [1 3] Some; typedef int {1, 3} Few; int LIMIT = 2; int LAG = [1 4];"]
    for each in range(lines):
        predicates = f"predicate D {{ }} predicate P {{ int n; }} predicate Q {{ {chance.choice(_TYPES)} }}"
        found.append(f'class T{each} extends AgentTimeline {{ {predicates} T{each}(Mode m) {{ super(m, "D"); }} }}')
    for each in range(lines):
        bodies = [
            [_line(chance, lines, each, 0) for _ in range(chance.choice(many))] for many in ((1, 2, 3), (0, 1, 1, 2))
        ]
        found.append(f"T{each}::P {{ {' '.join(bodies[0])} }}")
        found.append(f"T{each}::Q {{ int n; n == k; {' '.join(bodies[1])} }}")
        if chance.random() < 0.2:
            found.append(f"T{each}::D {{ duration >= {chance.choice((1, 2, 3))}; }}")
    return "\n".join([*found, *(f"T{each} t{each} = new T{each}(Internal);" for each in range(lines)), "close();"])


def _goal(chance: random.Random, lines: int) -> GoalConfiguration:
    at, is_q = chance.choice((0, 0, 3, 8)), chance.random() < 0.25
    first = at + chance.choice((0, 1, 2, 5, 9))
    start = (float(first), float(first + chance.choice((0, 0, 2, 6, 20))))
    value = ("k" if is_q else "n", chance.randrange(0, 5))
    line, predicate = f"t{chance.randrange(lines)}", "Q" if is_q else "P"
    return GoalConfiguration(line, predicate, at, chance.random() < 0.3, start, None, None, (value,))


def _told_when_to_end(chance: random.Random, goal: GoalConfiguration) -> GoalConfiguration:
    """The same with bounds of its end or duration, and often taken back."""
    assert goal.start is not None
    first = goal.start[0]
    end = (first + chance.choice((1, 2, 4)), first + chance.choice((4, 6, 9, 20))) if chance.random() < 0.5 else None
    duration = (chance.choice((1.0, 2.0)), chance.choice((2.0, 3.0, 5.0, 8.0))) if chance.random() < 0.4 else None
    recall = int(first) + chance.choice((0, 1, 1, 2, 3, 5)) if chance.random() < 0.7 else None
    return replace(goal, end=end, duration=duration, recall=recall)


def fly_choiceless(seed: int) -> Outcome | None:
    """Fly the simulator of `seed` in all ways, which may raise; None where it leaves a choice."""
    chance = random.Random(seed)
    lines = chance.choice((1, 2, 2, 3))
    flyer = simulator("sim", _text(chance, lines), " ".join(f"t{each}" for each in range(lines)))
    goals = tuple(_goal(chance, lines) for _ in range(chance.choice((1, 1, 2, 3, 4))))
    if seed >= _BOUNDED:
        goals = tuple(_told_when_to_end(chance, goal) for goal in goals)
    update = chance.choice((1, 5))
    lag = ParameterConfiguration("LAG", 1, 4, distribution="discrete", values=(1, 2, 4), mode="intra", update=update)
    if not Case((flyer,), goals, (lag,), _UNTIL).is_compiled():
        return None
    return in_all_ways(flyer, _UNTIL, goals, (lag,), seed)


def _main() -> int:
    count, first, *_ = (*map(int, sys.argv[1:]), *(100, 0)[len(sys.argv) - 1 :])
    wrong = flown = 0
    for seed in range(first, first + count):
        try:
            flown += fly_choiceless(seed) is not None
        except LimitError:
            continue  # its rules find no end
        except Exception as problem:
            wrong += 1
            print(f"seed {seed}: {type(problem).__name__}: {str(problem)[:200]}", flush=True)
    print(f"{count} simulators, {flown} flown alike, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(_main())
