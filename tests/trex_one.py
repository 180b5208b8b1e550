"""A checkout of trex-autonomy/trex in; which of its small agents leave the trace that T-REX 1 left, out.

`python -m tests.trex_one DIR`, or `make trex-one TREX1=DIR`. Nothing of the checkout is part of this project, and no
test needs it: the agents are flown in a scratch copy, in which what only its own C++ knows is taken out of the models.
An agent is `equal`, or differs by a decision that docs/compatibility.md tells, or is out, for what it needs of C++.
Ends with 1 where an agent turns out otherwise than expected here.
"""

import json
import re
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

Line = tuple[int, str, str, str]  # tick, kind, timeline, predicate
KINDS = {"observation": "NOTIFY", "request": "REQUEST", "recall": "RECALL"}
VALID = {"GamePlay": "OneDeliberatorOneAdapter", "Simulator": "Simulation"}  # where the trace has another name

# What the models ask of T-REX 1's own constraints, and of names that EUROPA has given up.
_REWRITES = (
    (r"\b(?:trex_behavior|absMaxOnCommit|neighborhood|assertCompleted|assertRejected)\([^;]*;", ""),
    (r"\bdefaultOnCommit\(duration,\s*([^)]*)\)\s*;", r"duration == \1;"),
    (r"\bdefaultOnCommit\([^;]*;", ""),
    (r"\btestLEQ\b", "testLeq"),
    (r"\btestLT\b", "testLessThan"),
    (r"\btestEQ\b", "testEq"),
    (r"\bisSucceded\([\w.]*\) == true;", ""),  # in a file that another agent shares
    (r"\baction\b", "act"),
    (r"\bclass Timeline \{\}", ""),
    (r"\benum TokenStates \{[^}]*\}", ""),
    (r"if\(object == pos\)\{[^}]*\}", ""),  # objects that are never equal: an error here (NDDL305)
)
_ADAPTERS = '''"""Reactors that publish what T-REX 1's adapters in C++ publish."""

from runtime.user.reactor import Reactor


class Ticks(Reactor):
    def tick(self, now):
        now.publish("c", "holds", value=min(now.tick, 4))
        now.wake(now.tick + 1)


class Players(Reactor):
    def tick(self, now):
        for player in ("player1", "player2") if now.tick == 0 else ():
            now.publish(player, "Wait")
            now.publish(f"{player}.hand", "Hides")
        for command in now.commands:
            if command.start[0] <= now.tick:
                now.publish(command.timeline, command.predicate, **command.arguments)
'''
_STAND_INS = {
    "RecallAdapter": ("Ticks", "11", ("c",)),
    "GamePlayAdapter": ("Players", "1", ("player1", "player2", "player1.hand", "player2.hand")),
}
_EARLY = {"Action.1": ("actions.incrementer",), "action.4": ("actions.incrementer", "actions.iterator")}

EQUAL = (
    "Action.1",
    "GamePlay",
    "Inconsistent",
    "OneStepAhead",
    "PersistedGoal",
    "Undefined.Derived",
    "action.4",
    "repair.1",
    "synch.0",
)
# Headings of docs/compatibility.md, "What T-REX 1 does otherwise".
BEGINS = "a goal begins as soon as it may"
FOLLOWS = "what can begin in the window is planned"
RUNS = "what runs is a fact"
BEFORE = "before the mission"
ONE_BY_ONE = "one request at a time"
NEWS = "what is asked for begins later"
GUARDS = "a guard waits until its variable is decided"
ENDS = "its last tick is the one before"
WAITS = "an action waits for nothing"
DIFFERENT = {  # and how many lines T-REX 1 has alone, and nddlc
    "Action.0": (ENDS, 1, 0),
    "Recall": (ONE_BY_ONE, 6, 2),
    "Simulator": (FOLLOWS, 14, 14),
    "SqueezeObserver": (FOLLOWS, 1, 8),
    "Undefined.SingleTimeline": (BEFORE, 0, 9),
    "action.2": (BEGINS, 4, 3),
    "action.3": (WAITS, 6, 17),
    "dispatch.0": (BEGINS, 1, 1),
    "dispatch.1": (BEGINS, 1, 1),
    "persistence.1": (RUNS, 7, 2),
    "repair.0": (NEWS, 1, 5),
    "repair.2": (GUARDS, 3, 1),
    "repair.3": (RUNS, 1, 0),
    "synch.4": (FOLLOWS, 1, 2),
    "test_monitor": (BEGINS, 1, 1),
}
# What cannot be flown, mostly for what it needs of C++.
OUT = {
    "LogReading": "SimAdapter, and the format of its log",
    "action_adapter.0": "ActionAdapter, and no trace",
    "bug.0": "defaultOnCommit",
    "dispatch.2": "dispatch_time, which the executive sets",
    "extensions.0": "isTimedOut and its kin",
    "extensions.1": "isTimedOut and its kin",
    "extensions.2": "isTimedOut and its kin",
    "persistence.0": "what can begin in the window is planned, and here that has no end",
    "synch.1": "defaultOnCommit",
    "synch.2": "defaultOnCommit",
    "synch.3": "isSucceded",
    "synchronize": "defaultOnCommit, neighborhood",
    "personal_robots/pr.0": "a solver's file that is not there",
}


def adapt(agents: Path) -> None:
    """Take out of a scratch copy what only T-REX 1 knows."""
    test = agents / "test"
    (test / "nddlc.toml").write_text('include = ["../base"]\n', encoding="utf-8")
    (test / "adapters.py").write_text(_ADAPTERS, encoding="utf-8")
    for file in agents.rglob("*.nddl"):
        text = file.read_text(encoding="utf-8", errors="replace")
        for pattern, instead in _REWRITES:
            text = re.sub(pattern, instead, text)
        file.write_text(text, encoding="utf-8")
    for file in test.glob("*.cfg"):
        text = file.read_text(encoding="utf-8", errors="replace")
        text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)  # some are no XML
        text = re.sub(r'<FlawHandler component="TestConditionHandler"[^>]*/>', "", text)
        for component, stand_in in _STAND_INS.items():
            text = re.sub(rf'<TeleoReactor[^>]*component="{component}"[^>]*/>', _python(*stand_in), text)
        file.write_text(text, encoding="utf-8")


def _python(name: str, lookahead: str, timelines: tuple[str, ...]) -> str:
    owned = "".join(f'<Internal name="{each}"/>' for each in timelines)
    return (
        f'<PythonReactor name="{name}" code="adapters.py:{name}" latency="0" lookahead="{lookahead}">'
        f"{owned}</PythonReactor>"
    )


def flown(test: Path, name: str) -> list[Line]:
    """The trace of an agent, as T-REX 1 writes it; empty where it cannot be flown."""
    file, trace = test / f"{name}.cfg", test / f"{name}.jsonl"
    found = re.search(r'finalTick="(\d+)"', file.read_text(encoding="utf-8"))
    assert found is not None, name
    if name in _EARLY:
        file = _with_early(file, _EARLY[name])
    _nddlc("run", file, "--trust", "--trace", trace)
    return list(_lines(trace, int(found[1]))) if trace.exists() else []


def _nddlc(command: str, file: Path, *options: object) -> None:
    told = [sys.executable, "-m", "nddlc", command, file.name, *map(str, options)]
    subprocess.run(told, cwd=file.parent, capture_output=True, check=False)


def _with_early(file: Path, timelines: tuple[str, ...]) -> Path:
    """The agent as a mission file that has some timelines begin what is planned as soon as it may."""
    converted = file.with_suffix(".toml")
    converted.unlink(missing_ok=True)
    _nddlc("convert", file, "--output", converted.name)
    text = converted.read_text(encoding="utf-8")
    line = f"early = {json.dumps(timelines)}\n"
    converted.write_text(text.replace("[[reactor]]\n", f"[[reactor]]\n{line}", 1), encoding="utf-8")
    return converted


def _lines(trace: Path, final_tick: int) -> Iterator[Line]:
    """What T-REX 1 would have written: it asks as a tick begins, not as the last one ends, and stops before its end."""
    for line in trace.read_text(encoding="utf-8").splitlines()[1:]:
        event = json.loads(line)
        tick = event["tick"] + (event["kind"] == "request")
        if event["kind"] in KINDS and event["reactor"] and tick < final_tick:
            yield tick, KINDS[event["kind"]], event["timeline"], event["predicate"]


def written(file: Path) -> list[Line]:
    """The trace that T-REX 1 left."""
    fields = [line.split() for line in file.read_text(encoding="utf-8").splitlines() if line.strip()]
    return [(int(tick), kind, timeline, full.rpartition(".")[2]) for tick, kind, timeline, full in fields]


def main() -> int:
    """Fly all agents; how many were equal, how many otherwise."""
    source = Path(sys.argv[1]) / "source" / "agent"
    counts: Counter[str] = Counter()
    surprises = 0
    with TemporaryDirectory() as folder:
        agents = Path(folder) / "agent"
        shutil.copytree(source, agents)
        adapt(agents)
        for name in sorted([*EQUAL, *DIFFERENT], key=str.lower):
            why, *expected = DIFFERENT.get(name) or ("", 0, 0)
            there = Counter(written(source / "test" / f"{VALID.get(name, name)}.valid"))
            here = Counter(flown(agents / "test", name))
            found = [(there - here).total(), (here - there).total()]
            what = "equal" if found == [0, 0] else "by decision" if name in DIFFERENT else "otherwise"
            counts[what] += 1
            surprises += found != expected
            told = "" if found == expected else f" (NOT AS EXPECTED: {expected})"
            print(f"{name:24} {what}{f', {found[0]} there, {found[1]} here: {why}' if any(found) else ''}{told}")
    for name, why in OUT.items():
        print(f"{name:24} out: {why}")
    print(", ".join(f"{counts[what]} {what}" for what in ("equal", "by decision", "otherwise")) + f", {len(OUT)} out")
    return int(surprises > 0)


if __name__ == "__main__":
    sys.exit(main())
