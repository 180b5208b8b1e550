"""Measure explanations on faults that were written down before they were flown: where does the changed line stand?

    python -m tests.checker.fault_study [-v] [--only N,N] [--missions 8] [--flights 40] MODEL...

A MODEL is a folder with a mission, such as those of `unseen`, and either a file with faults (`hand.toml` or, as that of
`fault_scheme`, `faults.toml`; the file itself stands for its folder) or a folder `variants` in which each folder holds
the files that one fault changed. A line that is gone counts as found by a cause in its rule, or
in its function where it is Python. Flights are kept in
build/, so that only what is new is flown.
"""

import ast
import shutil
import tomllib
from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

from checker.batch.engine import ROOT
from checker.batch.result import MissionResult
from checker.buckets import group_failures
from checker.counterfactual.effort import MOST_FLIGHTS, Bounds
from checker.counterfactual.ranking import NO_CAUSES, Causes, RankedLine
from checker.counterfactual.search import CauseSearch, Suspended, sites_in
from checker.faults import faults_of
from checker.mission import Mission, read_mission
from checker.models import ModelSet, load_models
from checker.oracle import Verdict, judge_losses
from checker.pinned import overlay_of, pinned
from checker.sampling.seeds import mission_seed
from checker.statistics import exact_interval
from checker.yardstick import TOP
from nddl_lang.text.read import real_path
from tests.checker.flown_before import RememberingFlyer

_OUT = ROOT / "build/faults"
_FLIGHTS = ROOT / "build/fault_flights.sqlite"
_SECONDS, _ONE_FLIGHT = 60.0, 20.0
_FAULTS = ("hand.toml", "faults.toml")
_OTHER = ("*.toml", "variants", "*.md", "nddlc-report", ".nddlc")
_ENDS = ("silent", "refused", "error")


@dataclass(frozen=True, slots=True)
class Fault:
    """The texts that it changes, by file."""

    kind: str
    texts: dict[str, str]


@dataclass(frozen=True, slots=True)
class Finding:
    """What became of a fault; `rank` is 0 where no cause is at a changed line. A `gone` line has left nothing."""

    number: int
    kind: str
    lines: tuple[str, ...]
    fate: str
    rank: int = 0
    is_gone: bool = False
    failed: int = 0
    flown: int = 0
    faults: int = 0
    causes: Causes = NO_CAUSES


def faults_in(folder: Path, file: Path | None = None) -> Iterator[Fault]:
    """The faults of a model, from a file of them or from the files that each has changed."""
    if file is None and (folder / "variants").is_dir():
        for variant in sorted((folder / "variants").iterdir()):
            texts = {path.relative_to(variant).as_posix(): path.read_text() for path in variant.rglob("*.*")}
            known = {name: text for name, text in texts.items() if (folder / name).is_file()}
            yield Fault(variant.name, {name: one for name, one in known.items() if (folder / name).read_text() != one})
        return
    file = file or next(folder / name for name in _FAULTS if (folder / name).is_file())
    for fault in tomllib.loads(file.read_text())["fault"]:
        yield Fault(fault["kind"], _edited(folder, fault.get("edit", [fault])))


def _edited(folder: Path, edits: Sequence[dict[str, str | int]]) -> dict[str, str]:
    """The texts of files after edits, each of the text as it was before all of them."""
    found: dict[str, list[tuple[int, int, str]]] = {}
    for edit in edits:
        text, old = (folder / str(edit["file"])).read_text(), str(edit["old"])
        above = "".join(text.splitlines(keepends=True)[: int(edit.get("line", 1)) - 1])
        begin = text.index(old, len(above))
        found.setdefault(str(edit["file"]), []).append((begin, begin + len(old), str(edit["new"])))
    texts = {}
    for name, changes in found.items():
        text = (folder / name).read_text()
        for begin, end, new in sorted(changes, reverse=True):
            text = text[:begin] + new + text[end:]
        texts[name] = text
    return texts


def laid_out(folder: Path, fault: Fault, place: Path) -> Path:
    """The files of a model with a fault, at a place of their own."""
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(folder, place, ignore=shutil.ignore_patterns(*_FAULTS, "variants", "nddlc-report"))
    for name, text in fault.texts.items():
        (place / name).write_text(text)
    return place


def changed_lines(before: str, after: str) -> tuple[set[int], set[int]]:
    """The lines of `after` that are new or others, and those behind which lines are gone."""
    old, new = ([line.split("//")[0].rstrip() for line in text.splitlines()] for text in (before, after))
    changed, gone = set[int](), set[int]()
    for tag, _, _, first, last in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if tag != "equal":
            lines = [number for number in range(first + 1, last + 1) if new[number - 1].strip()]
            changed |= set(lines)
            gone |= set() if lines else {max(first, 1)}
    return changed, gone


def study(folder: Path, fault: Fault, number: int, missions: int, flights: int) -> Finding:
    """Lay a fault out, fly it, and look for its lines among the causes."""
    place = laid_out(folder, fault, _OUT / folder.resolve().name / f"{number:03}")
    changed, gone = set[tuple[str, int]](), set[tuple[str, int]]()
    for name, text in fault.texts.items():
        new, lost = changed_lines((folder / name).read_text(), text)
        changed |= {(name, line) for line in new}
        gone |= {(name, line) for line in lost}
    lines = tuple(f"{name}:{line}" for name, line in sorted(changed or gone))
    found = Finding(number, fault.kind, lines, "refused", is_gone=not changed)
    mission, _ = read_mission(place / "mission.toml")
    models = load_models(mission, is_linted=True) if mission is not None else None
    if mission is None or models is None or models.has_errors:
        return found
    if not changed:
        changed = {(name, line) for name, lost in gone for line in _rule_of(models, place / name, lost)}
        changed = {(name, line) for name, line in changed}
    seeds = _passing(folder, missions)
    if isinstance(seeds, str):
        return replace(found, fate=seeds)
    results, causes, faults = explained(mission, models, seeds, flights)
    failed = [one for one in results if one.verdict is Verdict.FAIL]
    found = replace(found, failed=len(failed), flown=len(results), faults=faults, causes=causes)
    if any(one.verdict is Verdict.ERROR for one in results):
        return replace(found, fate="error")
    names = {(name, line) for name, line in changed}
    rank = next((k for k, one in enumerate(causes.ranked, 1) if (one.place.file, one.place.line) in names), 0)
    return replace(found, fate=_code(failed) if failed else "silent", rank=rank)


def _code(failed: Sequence[MissionResult]) -> str:
    return max((one.judgement.code for one in failed), key=[one.judgement.code for one in failed].count)


def _rule_of(models: ModelSet, file: Path, line: int) -> list[int]:
    """The lines of the rule that a line which is gone was a part of."""
    name = str(real_path(file))
    if file.suffix == ".py":
        found = (one for one in ast.walk(ast.parse(file.read_text())) if isinstance(one, ast.FunctionDef))
        around = [(one.lineno, one.end_lineno or one.lineno) for one in found]
        around = [one for one in around if one[0] <= line <= one[1]]
        first, last = min(around, key=lambda one: one[1] - one[0], default=(line, line))
        return list(range(first, last + 1))
    scopes = {site.scope for site in sites_in(models.agent) if site.file == name}
    around = [scope for scope in scopes if scope[0] <= line <= scope[1]]
    first, last = min(around, key=lambda one: one[1] - one[0], default=(line, line))
    return list(range(first, last + 1))


def _passing(folder: Path, missions: int) -> list[tuple[int, int]] | str:
    """Missions that pass without a fault, each with its number and seed."""
    mission, _ = read_mission(folder / "mission.toml")
    models = load_models(mission, is_linted=True) if mission is not None else None
    if mission is None or models is None or models.has_errors:
        return "no mission without a fault"
    seeds = [(number, mission_seed(mission.check.seed, number)) for number in range(1, missions + 1)]
    with _flyer(mission, models) as flyer:
        found = [one for one in seeds if _judged(mission, flyer.fly(models.agent, *one)).verdict is Verdict.PASS]
    return found or "no mission passes without a fault"


def explained(
    mission: Mission, models: ModelSet, seeds: Sequence[tuple[int, int]], flights: int
) -> tuple[list[MissionResult], Causes, int]:
    """The missions flown, the causes of the fault that most of them show, and the number of faults."""
    with _flyer(mission, models) as flyer:
        keeps = bool(mission.check.limits)
        results = [_judged(mission, flyer.fly(models.agent, *one, keeps_trace=keeps)) for one in seeds]
        programs = [models.programs[each.model] for each in models.agent.reactors]
        world = Suspended(
            models.agent, programs, mission.check.limits, flyer, overlay_of(models), mission, models.findings
        )
        flown = [one for one in results if one.verdict is not Verdict.ERROR]
        faults = faults_of(group_failures(tuple(flown)), flown, CauseSearch(world, Bounds(flights, _SECONDS)))
    return results, faults[0][1] if faults else NO_CAUSES, len(faults)


def _flyer(mission: Mission, models: ModelSet) -> RememberingFlyer:
    texts = repr(sorted(models.texts.items()))
    limit = min(mission.check.time_limit, _ONE_FLIGHT)
    return RememberingFlyer(pinned(models), models.agent, limit, texts, _FLIGHTS)


def _judged(mission: Mission, result: MissionResult) -> MissionResult:
    return replace(result, judgement=judge_losses(result.judgement, result.losses, mission.check.limits))


def _cause_text(cause: RankedLine) -> str:
    change = f"`{cause.change.old.strip()}` -> `{cause.change.new.strip()}`" if cause.change is not None else ""
    return f"{cause.place.file}:{cause.place.line} {cause.claim} {cause.helped}/{cause.missions} {change}"


def share(count: int, total: int) -> str:
    """A count with the exact interval of its share."""
    low, high = exact_interval(count, total, 0.95)
    return f"{count} of {total} ({count / max(total, 1):.0%}; {low:.0%} to {high:.0%})"


def tell(found: Sequence[Finding]) -> str:
    """The totals of findings."""
    failing = [one for one in found if one.fate not in _ENDS and not one.fate.startswith("no mission")]
    told = []
    for is_gone, what in ((False, "changed lines"), (True, "lines that are gone, by their rule")):
        group = [one for one in failing if one.is_gone is is_gone]
        first, top = sum(one.rank == 1 for one in group), sum(1 <= one.rank <= TOP for one in group)
        told.append(f"{what}: first {share(first, len(group))}, in the top {TOP} {share(top, len(group))}")
    rest = ", ".join(f"{sum(one.fate == fate for one in found)} {fate}" for fate in _ENDS)
    return "\n".join([*told, f"{len(found)} faults, {len(failing)} fail, {rest}"])


def main() -> None:
    """Print one line for each fault, and totals."""
    parser = ArgumentParser(prog="fault_study")
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--missions", type=int, default=8)
    parser.add_argument("--flights", type=int, default=MOST_FLIGHTS)
    parser.add_argument("--only", default="")
    parser.add_argument("-v", action="store_true", dest="is_wordy")
    chosen = parser.parse_args()
    wanted = {int(one) for one in chosen.only.split(",") if one}
    everything: list[Finding] = []
    for model in chosen.models:
        folder, file = (model.parent, model) if model.suffix == ".toml" else (model, None)
        found = []
        for number, fault in enumerate(faults_in(folder, file), 1):
            if wanted and number not in wanted:
                continue
            one = study(folder, fault, number, chosen.missions, chosen.flights)
            found.append(one)
            print(
                f"{folder.name} {number} {one.kind}: {' '.join(one.lines)}: {one.fate}, {one.failed} of {one.flown}, "
                f"rank {one.rank} of {len(one.causes.ranked)}, {one.causes.flights} trials, {one.faults} faults",
                flush=True,
            )
            for cause in one.causes.ranked[: TOP + 1] if chosen.is_wordy and one.rank != 1 else ():
                print(f"    {_cause_text(cause)}")
        print(f"{folder.name}:\n{tell(found)}", flush=True)
        everything += found
    if len(chosen.models) > 1:
        print(f"together:\n{tell(everything)}")


if __name__ == "__main__":
    main()
