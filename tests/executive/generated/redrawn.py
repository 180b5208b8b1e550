"""Random simulators whose commands and skies are drawn for anew, flown by both engines, every tick visited or not.

    python -m tests.executive.generated.redrawn [COUNT [FIRST]]    COUNT simulators (100) from seed FIRST on (0)

Prints each seed whose four flights differ, or with which the judge disagrees, and exits with 1 then.
"""

import random
import sys

from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import Outcome
from tests.executive.flying import in_all_ways, lines, simulator

_UNTIL = 80
_NEEDS = (
    "met_by(object.Ready r);",
    "starts_during(Sky.Clear s);",
    "contained_by(Sky.Clear s);",
    "starts_during(Bath.Hot h);",
    "contained_by(Bath.Hot h);",
    "equals(Bath.Hot h);",
    "contains(Bath.Hot h);",
    "meets(object.Rest w);",
    "meets(object.Ready w);",
    "before(Bath.Hot q);",
    "starts_before(Bath.Hot q);",
    "float g; g == sampledParameter(LOAD); if (g > 0.5) { starts_during(Sky.Clear s2); }",
    "start >= 10;",
)


def _duration(chance: random.Random, local: str, top: int) -> str:
    if chance.choice(["c", "d", "d"]) == "c":
        return f"duration == {chance.randint(1, top)};"
    least, most = chance.randint(1, 3), chance.randint(1, top)
    return f"float {local}; {local} == sampledParameter(LOAD); duration == {least} + ceil({local} * {most}.0);"


def _sky(chance: random.Random) -> str:
    if chance.random() >= 0.7:
        return f"Sky::Clear {{ duration == {chance.randint(2, 9)}; meets(object.Cloudy n); }}"
    lasts = f"duration == {chance.randint(2, 8)} + ceil(c * {chance.randint(1, 6)}.0);"
    turns = f"if (c > {chance.choice([0.3, 0.5, 0.8])}) {{ meets(object.Cloudy n); }} else {{ meets(object.Clear n); }}"
    return f"Sky::Clear {{ float c; c == sampledParameter(LOAD); {lasts} {turns} }}"


def _rules(chance: random.Random, commands: list[str]) -> list[str]:
    found = [_sky(chance), f"Sky::Cloudy {{ {_duration(chance, 'd', 5)} meets(object.Clear n); }}"]
    bath = _duration(chance, "h", 6)
    found.append(
        f"Bath::Hot {{ {bath} {chance.choice(['', '', 'starts_during(Sky.Clear s);', 'meets(object.Cold k);'])} }}"
    )
    ready = _duration(chance, "e", 4)
    found.append(f"Arm::Ready {{ {ready} {chance.choice(['', '', 'starts_during(Sky.Cloudy s);'])} }}")
    for command in commands:
        body = [_duration(chance, "l", 6), *(need for need in _NEEDS if chance.random() < 0.2)]
        chance.shuffle(body)
        found.append(f"Arm::{command} {{ {' '.join(body)} }}")
    return found


def _goals(chance: random.Random, commands: list[str]) -> tuple[GoalConfiguration, ...]:
    asked = []
    for _ in range(chance.randint(1, 5)):
        at = chance.randint(0, 40)
        first = at + chance.randint(1, 6)
        last = first + chance.choice([0, 1, 3, 8, 20, 60])
        asked.append((at, "arm" if chance.random() < 0.75 else "bath", (float(first), float(last))))
    asked.sort(key=lambda one: one[0])
    return tuple(
        GoalConfiguration(line, chance.choice(commands) if line == "arm" else "Hot", at, False, start)
        for at, line, start in asked
    )


def fly_redrawn(seed: int) -> Outcome:
    """Fly the simulator of `seed` in all ways; an AssertionError tells that they differ."""
    chance = random.Random(seed)
    commands = ["Do", "Go"][: chance.randint(1, 2)]
    predicates = " ".join(f"predicate {each} {{ }}" for each in commands)
    text = "\n".join(
        [
            "float LOAD = [0.0 1.0];",
            f"class Arm extends AgentTimeline {{ predicate Rest {{ }} predicate Ready {{ }} {predicates}"
            ' Arm(Mode m) { super(m, "Rest"); } }',
            "class Sky extends AgentTimeline { predicate Clear { } predicate Cloudy { }"
            ' Sky(Mode m) { super(m, "Clear"); } }',
            "class Bath extends AgentTimeline { predicate Cold { } predicate Hot { }"
            ' Bath(Mode m) { super(m, "Cold"); } }',
            *_rules(chance, commands),
            "Arm arm = new Arm(Internal); Bath bath = new Bath(Internal); Sky sky = new Sky(Internal); close();",
        ]
    )
    goals = _goals(chance, commands)
    is_redrawn = chance.choice([True, True, True, False])
    update = chance.choice([1, 2, 3, 5, 10, 20])
    load = ParameterConfiguration("LOAD", 0.0, 1.0, mode="intra" if is_redrawn else "inter", update=update)
    order = chance.choice(["arm bath sky", "sky bath arm", "bath arm sky", "sky arm bath"])
    return in_all_ways(simulator("world", text, order), _UNTIL, goals, (load,), seed)


def _main() -> int:
    count, first, *_ = (*map(int, sys.argv[1:]), *(100, 0)[len(sys.argv) - 1 :])
    wrong = begun = rejected = 0
    for seed in range(first, first + count):
        try:
            outcome = fly_redrawn(seed)
        except Exception as problem:
            wrong += 1
            print(f"seed {seed}: {type(problem).__name__}: {str(problem)[:200]}", flush=True)
            continue
        begun += sum(" Do" in line or " Go" in line for line in lines(outcome, "observation"))
        rejected += len(lines(outcome, "reject"))
    print(f"{count} simulators, {wrong} wrong; {begun} commands begun, {rejected} rejected")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(_main())
