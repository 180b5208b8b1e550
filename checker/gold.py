"""The gold standard of a mission: what it published, asked and gave up when somebody accepted it (T-REX 3.4, F11)."""

import difflib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from nddl_lang.text.values import json_value
from runtime.executive.outcome import Event, EventKind, Outcome
from runtime.executive.rendering import event_text

_TOLD = (
    EventKind.OBSERVATION,
    EventKind.REQUEST,
    EventKind.RECALL,
    EventKind.REFUSE,
    EventKind.REJECT,
    EventKind.RELAX,
    EventKind.KILL,
    EventKind.ABORT,
    EventKind.END,
)
_PHASES = ("start", "synchronise", "repair", "observe", "deliberate", "dispatch", "end")


@dataclass(frozen=True, slots=True)
class Gold:
    """What was accepted, by whom, when, and of which models."""

    mission: str
    seed: int
    values: dict[str, float]
    models: str
    by: str
    at: str
    lines: tuple[str, ...]


def gold_path(mission: Path, seed: int) -> Path:
    """Where the gold standard of a mission and seed is kept: beside the mission file."""
    return mission.parent / "gold" / f"{mission.stem}-{seed}.txt"


def gold_lines(outcome: Outcome) -> tuple[str, ...]:
    """The canonical text: one line per event, within a tick by phase and timeline."""
    told = [event for event in outcome.events if event.kind in _TOLD]
    told.sort(key=lambda event: (event.tick, _PHASES.index(event.phase.value), event.timeline))
    return tuple(map(_line, told))


def _line(event: Event) -> str:
    parts = (str(event.tick), event.reactor or "-", event.kind.value, event.timeline or "-", event_text(event))
    return " ".join(part for part in parts if part)


def gold_text(gold: Gold) -> str:
    """The file of a gold standard: what was accepted in the first line, then the events."""
    head = {
        "mission": gold.mission,
        "seed": gold.seed,
        "values": gold.values,
        "models": gold.models,
        "by": gold.by,
        "at": gold.at,
    }
    return "\n".join([json.dumps(head, ensure_ascii=False), *gold.lines]) + "\n"


def read_gold(path: Path) -> Gold:
    """Read a gold standard; raises OSError, or ValueError where the file is none."""
    lines = path.read_text(encoding="utf-8").splitlines()
    head: dict[str, Any] = json_value(lines[0]) if lines else {}
    try:
        values = {str(name): float(value) for name, value in head["values"].items()}
        return Gold(
            str(head["mission"]), int(head["seed"]), values, head["models"], head["by"], head["at"], tuple(lines[1:])
        )
    except (KeyError, TypeError, AttributeError) as problem:
        raise ValueError("its first line does not say what was accepted") from problem


@dataclass(frozen=True, slots=True)
class Change:
    """What differs at one tick on one timeline (empty: of no timeline): lines as accepted, and as flown now."""

    tick: int
    timeline: str
    accepted: tuple[str, ...]
    flown: tuple[str, ...]


def differences(accepted: Sequence[str], flown: Sequence[str]) -> tuple[Change, ...]:
    """What differs, by tick and timeline."""
    found: dict[tuple[int, str], tuple[list[str], list[str]]] = {}
    matcher = difflib.SequenceMatcher(None, accepted, flown, autojunk=False)
    for kind, i, j, k, m in matcher.get_opcodes():
        if kind == "equal":
            continue
        for side, lines in ((0, accepted[i:j]), (1, flown[k:m])):
            for line in lines:
                tick, reactor, what, timeline, text = (line.split(" ", 4) + [""] * 5)[:5]
                name = "" if timeline == "-" else timeline
                whole = " ".join(part for part in (what, text, f"by {reactor}" if reactor != "-" else "") if part)
                found.setdefault((int(tick), name), ([], []))[side].append(whole)
    return tuple(Change(tick, name, tuple(a), tuple(b)) for (tick, name), (a, b) in sorted(found.items()))
