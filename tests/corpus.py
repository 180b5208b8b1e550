"""Checkouts of the public corpus in; which of its models load, which plans are found, and in how many steps, out.

`python -m tests.corpus DIR`, or `make corpus CORPUS=DIR`: DIR holds checkouts of nasa/europa and fredpy/trex2-agent
under any names. Nothing of them is part of this project, and no test needs them. What the figures mean stands in
docs/compatibility.md. Ends with 1 after a crash, a hang, a verdict or a number of steps that is not expected.
"""

import sys
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing import Pipe, Process
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TypeVar

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.read import read_source
from runtime.loading import load
from runtime.solver.configuration.limits import Limits, model_limits
from runtime.solver.configuration.read import read_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import RESULT_NAMES

Answer = TypeVar("Answer")
TIMEOUT = 20.0  # seconds for one model
EUROPA_FOLDERS = ("src/PLASMA/NDDL/base", "src/PLASMA/Resource/component/NDDL", "src/PLASMA/NDDL/test/nddl")
TREX_FOLDERS = ("extra/europa/cfg", "extra/third_party/lsts/cfg", "extra/third_party/lsts/cfg/auv")
TESTS = "src/PLASMA/System/test"
DEFAULT = "DefaultPlannerConfig.xml"

# What EUROPA makes of the models whose plans its own tests store: steps, decisions in force at the end.
STORED: dict[tuple[str, str], tuple[int, int]] = {
    ("DynamicObjTest", DEFAULT): (7, 6),
    ("HTX.1", "HTX.1.solverConfig.xml"): (3, 1),
    ("HTX.3", "HTX.3.solverConfig.xml"): (5, 1),
    ("Mini-crew-init", "MiniCrewSolverConfig.xml"): (8, 4),
    ("Rover-transaction-reservoir", DEFAULT): (83, 63),
    ("backtrack-test", DEFAULT): (6, 5),
    ("basic-model-transaction", DEFAULT): (407, 407),
    ("basic-types", DEFAULT): (6, 6),
    ("better-res", DEFAULT): (55, 54),
    ("better-res-reservoir", DEFAULT): (59, 58),
    ("constrain-transaction", DEFAULT): (0, 0),
    ("constraint-to-temporal", DEFAULT): (4, 4),
    ("force-object-distribution", DEFAULT): (16, 16),
    ("foreach-transaction", DEFAULT): (50, 1),
    ("gnats_2572_interval-tx", DEFAULT): (26, 26),
    ("gnats_2837-tx", DEFAULT): (26, 26),
    ("gnats_3161", DEFAULT): (3, 2),
    ("k9-initial", DEFAULT): (0, 0),
    ("k9-transaction", DEFAULT): (21, 20),
    ("k9.backtrack.moderate-transaction", DEFAULT): (110, 108),
    ("k9.backtrack.moderate-transaction-reservoir", DEFAULT): (172, 170),
    ("merge-with-open-domain", DEFAULT): (3, 3),
    ("monkey1monkey-transaction", DEFAULT): (152, 42),
    ("path-filter-transaction", DEFAULT): (3, 3),
    ("rejection", DEFAULT): (2, 1),
    ("resource-backtrack-test", DEFAULT): (7, 5),
    ("resource-backtrack-test-reservoir", DEFAULT): (7, 5),
    ("reusable-test-transaction", "ReusableTestConfig.xml"): (6, 5),
    ("rules.0.tx", DEFAULT): (2, 2),
    ("subtype-extension.tx", DEFAULT): (29, 29),
    ("unary-resource-test-transaction", "ReusableTestConfig.xml"): (8, 8),
}
EXAMPLES: dict[str, tuple[int, int]] = {
    "BlocksWorld": (195, 131),
    "Light": (5, 5),
    "Rover": (39, 37),
    "Shopping": (41, 41),
    "UBO": (167, 167),
}
# Others that EUROPA loads and that say how long to plan; their verdicts.
OTHERS: dict[tuple[str, str], str] = {
    ("CAPER", DEFAULT): "plan",
    ("EOS-backtrack-test", DEFAULT): "plan",
    ("EOS-backtrack-test-reservoir", DEFAULT): "plan",
    ("HTX.1.solver", "HTX.1.solverConfig.xml"): "plan",
    ("HTX.2", DEFAULT): "timeout",
    ("HTX.3.solver", "HTX.3.solverConfig.xml"): "plan",
    ("backtr", DEFAULT): "plan",
    ("compat_token_cache", DEFAULT): "plan",
    ("monkey1monkey", DEFAULT): "plan",
    ("parent-predicate", DEFAULT): "plan",
    ("parent-predicate-reservoir", DEFAULT): "plan",
    ("smallerInconsistency-initial-state", DEFAULT): "plan",
}
# Where nddlc differs on purpose; docs/compatibility.md says why.
OTHER_STEPS = ("BlocksWorld", "constraint-to-temporal")
OTHER_VERDICT = {"backtr": "exhausted"}


@dataclass(frozen=True, slots=True)
class Problem:
    """A model to be planned, and what EUROPA makes of it."""

    name: str
    model: Path
    configuration: Path
    limits: Limits | None  # None: the model says
    verdict: str
    steps: tuple[int, int] | None  # None: not stored


def problems(europa: Path) -> Iterator[Problem]:
    """Everything that EUROPA's tests and examples plan."""
    for name, steps in EXAMPLES.items():
        folder = europa / "examples" / name
        limits = Limits(0, 1000 if name == "BlocksWorld" else 100, 1000, 1000)
        model = folder / f"{name}-initial-state.nddl"
        yield Problem(name, model, folder / "PlannerConfig.xml", limits, "plan", steps)
    tests = europa / TESTS
    for (name, configuration), steps in STORED.items():
        yield Problem(name, tests / f"{name}.nddl", tests / configuration, None, "plan", steps)
    for (name, configuration), verdict in OTHERS.items():
        yield Problem(name, tests / f"{name}.nddl", tests / configuration, None, verdict, None)


def load_one(path: Path, folders: tuple[str, ...], dialect: str) -> tuple[str, str]:
    """How a load ends, and the first complaint."""
    loaded = load(path, (str(path.parent), *folders), Dialect(dialect))
    errors = [each for each in loaded.diagnostics if each.severity is Severity.ERROR]
    if errors:
        return "refused", f"{errors[0].code.id}: {errors[0].message}"
    assert loaded.database is not None
    return "loads", "" if loaded.database.is_consistent else "inconsistent"


def plan_one(problem: Problem, folders: tuple[str, ...], strategy: str) -> tuple[str, int, int]:
    """How a search ends, its steps, and the decisions in force."""
    loaded = load(problem.model, (str(problem.model.parent), *folders), Dialect.NDDL3)
    if loaded.database is None or loaded.is_refused:
        return "refused", 0, 0
    configuration, _ = read_configuration(read_source(str(problem.configuration)))
    limits = problem.limits or model_limits(loaded.database)
    if configuration is None or limits is None:
        return "unclear", 0, 0
    solver = Solver(loaded.database, configuration, limits.start, limits.end, strategy == "europa")
    result = solver.solve(limits.steps, limits.depth)
    return RESULT_NAMES[result], solver.steps, solver.depth


def serve(end: Connection) -> None:
    """Work off jobs that come through `end`."""
    while (job := end.recv()) is not None:
        function, arguments = job
        try:
            end.send((None, function(*arguments)))
        except Exception:
            end.send((traceback.format_exc(), None))


class Worker:
    """A process that may crash or hang without harm."""

    def __init__(self) -> None:
        self.start()

    def start(self) -> None:
        """Begin anew."""
        self.end, other = Pipe()
        self.process = Process(target=serve, args=(other,), daemon=True)
        self.process.start()
        other.close()

    def ask(self, function: Callable[..., Answer], *arguments: object) -> tuple[str | None, Answer | None]:
        """What went wrong, and the answer."""
        self.end.send((function, arguments))
        try:
            if self.end.poll(TIMEOUT):
                complaint, answer = self.end.recv()
                return complaint, answer
            complaint = f"not done after {TIMEOUT:.0f} s"
        except EOFError:
            complaint = "the process died"
        self.process.kill()
        self.start()
        return complaint, None


def checkout(top: Path, mark: str) -> Path | None:
    """The checkout below `top` that has the folder `mark`."""
    return next((each for each in sorted(top.iterdir()) if (each / mark).is_dir()), None)


def try_loading(worker: Worker, root: Path, folders: tuple[str, ...]) -> int:
    """Load every model in both dialects; how many went wrong."""
    wrong = 0
    counts: Counter[tuple[str, str]] = Counter()
    for path in sorted(root.rglob("*.nddl")):
        row = []
        for dialect in ("nddl3", "nddlc"):
            complaint, answer = worker.ask(load_one, path, folders, dialect)
            outcome, why = answer or ("WRONG", complaint or "")
            wrong += answer is None
            counts[dialect, outcome] += 1
            row.append(f"{outcome} {why}".strip())
        told = row[0] if row[0] == row[1] else f"{row[0]} / in nddlc: {row[1]}"
        if told != "loads":
            print(f"{path.relative_to(root)}: {told}")
    for (dialect, outcome), count in sorted(counts.items()):
        print(f"{root.name}, {dialect}: {count} {outcome}")
    return wrong


def try_planning(worker: Worker, europa: Path, folders: tuple[str, ...]) -> int:
    """Plan with both strategies; how many went otherwise than expected."""
    wrong = equal = stored = 0
    for problem in problems(europa):
        rows = []
        for strategy in ("europa", "nddlc"):
            complaint, answer = worker.ask(plan_one, problem, folders, strategy)
            rows.append(answer or (complaint or "", 0, 0))
        (verdict, *steps), (other, *learned) = rows
        wanted = OTHER_VERDICT.get(problem.name, problem.verdict)
        is_wrong = verdict != wanted or other not in (wanted, "plan")
        if problem.steps is not None:
            stored += 1
            equal += tuple(steps) == problem.steps
            is_wrong = is_wrong or (tuple(steps) != problem.steps and problem.name not in OTHER_STEPS)
        wrong += is_wrong
        print(
            f"{problem.name}: EUROPA {problem.verdict} {problem.steps or ''}, europa {verdict} {tuple(steps)}, ", end=""
        )
        print(f"nddlc {other} {tuple(learned)}{' WRONG' if is_wrong else ''}")
    print(f"{equal} of {stored} stored plans in as many steps as EUROPA")
    return wrong


def main(top: Path) -> int:
    """The exit status."""
    europa = checkout(top, "src/PLASMA")
    trex = checkout(top, TREX_FOLDERS[0])
    if europa is None or trex is None:
        print(f"no checkouts of nasa/europa and fredpy/trex2-agent in {top}", file=sys.stderr)
        return 2
    folders = tuple(str(europa / each) for each in EUROPA_FOLDERS)
    more = tuple(str(trex / each) for each in TREX_FOLDERS)
    worker = Worker()
    wrong = try_loading(worker, europa, folders) + try_loading(worker, trex, (*more, *folders))
    wrong += try_planning(worker, europa, folders)
    return int(wrong > 0)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m tests.corpus DIR")
    sys.exit(main(Path(sys.argv[1])))
