"""Conditions of models whose truth is known, each measured on fresh missions: `make truths`."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from checker.batch.worker import Task, fly_one
from checker.buckets import group_failures
from checker.conditions.condition import Condition, Row
from checker.conditions.find import find_condition
from checker.conditions.flights import Ended, label_of
from checker.conditions.measure import measured_on
from checker.conditions.rendering import condition_text
from checker.conditions.space import Space
from checker.sampling.seeds import mission_seed
from tests.checker.conditions.campaigns import RANGES, campaign, flown, reflying

LEAST = 0.95
FRESH_SEED = 987_654_321
_GUARDS = "bool u; bool v; u == (p > {0}); v == (q < {1}); if (u == true) {{ if (v == true) {{ {2} }} }}"
_WHOLE = "int P = [0 20]; int Q = [0 20]; float R = [0.0 1.0];"
_SWITCH = "int P = [0 1]; float Q = [0.0 10.0]; float R = [0.0 10.0];"
_CHOICE = "[parameters.P]\nvalues = [1, 2, 4, 8]"
_AGAIN = '[parameters.P]\nmode = "intra"\nupdate = 10'

# The rule of the stroke, the ranges of its parameters, what the mission file says of them, its last tick.
TRUTHS: dict[str, tuple[str, str, str, int]] = {
    "limit": ("p <= 0.8;", RANGES, "", 10),
    "outside": ("p >= 0.1; p <= 0.9;", RANGES, "", 10),
    "band": (_GUARDS.format(0.4, 2.0, "p >= 0.6;"), RANGES, "", 10),
    "rare": ("p <= 0.998;", RANGES, "", 10),
    "one per cent": (_GUARDS.format(0.9, 0.1, "p <= 0.9;"), RANGES, "", 10),
    "conjunction": (_GUARDS.format(0.6, 0.35, "r >= 2.0;"), RANGES, "", 10),
    "three": (_GUARDS.format(0.5, 0.5, "r <= 0.5;"), RANGES, "", 10),
    "exclusive or": ("bool u; bool v; u == (p > 0.5); v == (q > 0.5); u == v;", RANGES, "", 10),
    "greatest": ("float s; maxf(s, p, q); s <= 0.85;", RANGES, "", 10),
    "sum": ("p + q <= 1.5;", RANGES, "", 10),
    "difference": ("p - q <= 0.4;", RANGES, "", 10),
    "sum of three": ("p + q + r <= 2.3;", RANGES, "", 10),
    "size": ("float s; float t; s == p - q; absf(t, s); t <= 0.6;", RANGES, "", 10),
    "odd weight": ("1.37 * p + q <= 1.6;", RANGES, "", 10),
    "ratio": ("p <= 3.0 * q + 0.2;", RANGES, "", 10),
    "scales": (
        "p + 700.0 * q <= 1200.0;",
        "float P = [100.0 1000.0]; float Q = [0.0 1.0]; float R = [0.0 1.0];",
        "",
        10,
    ),
    "product": ("p * q <= 0.6;", RANGES, "", 10),
    "squares": ("p * p + q * q <= 1.0;", RANGES, "", 10),
    "out of a circle": ("(p - 0.5) * (p - 0.5) + (q - 0.4) * (q - 0.4) <= 0.2;", RANGES, "", 10),
    "in a circle": ("(p - 0.5) * (p - 0.5) + (q - 0.4) * (q - 0.4) >= 0.05;", RANGES, "", 10),
    "product and sum": ("p * q + r <= 1.4;", RANGES, "", 10),
    "two legs": (
        "float s; float t; p * s == 10.0; q * t == 8.0; s + t <= 30.0;",
        "float P = [0.5 2.0]; float Q = [0.4 1.5]; float R = [0.0 1.0];",
        "",
        10,
    ),
    "rounded": ("int k; float s; s == 10.0 * p + 4.0 * q; floor(k, s); k <= 10;", RANGES, "", 10),
    "whole numbers": ("p * q <= 200;", _WHOLE, "", 10),
    "choice": ("p * q <= 60.0;", "float P = [0.0 10.0]; float Q = [0.0 20.0]; float R = [0.0 1.0];", _CHOICE, 10),
    "two faults": ("p <= 0.9;\n    p * q <= 0.6;", RANGES, "", 10),
    "drawn again": ("p <= 0.95;", RANGES, _AGAIN, 60),
    "sum, drawn again": ("p + q <= 1.6;", RANGES, _AGAIN, 60),
    "product, drawn again": ("p * q <= 0.7;", RANGES, _AGAIN, 60),
    "switch": ("bool u; u == (p > 0.5); if (u == true) { q <= 9.0; } else { r <= 4.0; }", _SWITCH, "", 10),
    "switch and sum": ("bool u; u == (p > 0.5); if (u == true) { q + r <= 12.0; }", _SWITCH, "", 10),
}


def study(fresh: int) -> int:
    """Print how each condition does on fresh missions; the number of those that are neither right nor marked."""
    wrong = 0
    for name, (rule, ranges, more, final_tick) in TRUTHS.items():
        with TemporaryDirectory() as folder:
            given = campaign(Path(folder), rule, ranges=ranges, more=more, missions=400, final_tick=final_tick)
            results, agent = flown(given), given.models.agent
            fly, space = given.load(agent), Space(agent, results)
            missions = [fly_one(fly, Task(number, mission_seed(FRESH_SEED, number))) for number in range(fresh)]
            for bucket in group_failures(results):
                found = find_condition(bucket, results, agent, given.mission.check.seed, reflying(given))
                rows = [
                    (row, label)
                    for one in missions
                    if (row := space.row(one)) is not None and (label := label_of(one, bucket)) is not None
                ]
                wrong += _tell(name, found, rows)
    return wrong


def _tell(name: str, found: Condition | None, rows: list[tuple[Row, Ended]]) -> bool:
    """Print one condition with its figures; whether it claims too much."""
    if found is None:
        print(f"{name:16} nothing is claimed", flush=True)
        return False
    quality = measured_on(rows, found.conjunctions)
    is_right = min(quality.precision.value, quality.recall.value) >= LEAST
    mark = "right" if is_right else "partial" if found.is_partial else "WRONG"
    figures = f"precision {quality.precision.value:.3f}, recall {quality.recall.value:.3f}"
    print(f"{name:16} {mark:7} {figures}: {condition_text(found)}", flush=True)
    return not is_right and not found.is_partial


if __name__ == "__main__":
    sys.exit(study(int(sys.argv[1])) > 0)
