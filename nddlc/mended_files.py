"""Files that `nddlc lint` looks at in, each with what its fixes make of it out: models, missions, solvers' tables."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from nddl_lang.lint.check import Checker
from nddl_lang.lint.configuration import NAME, PROJECT
from nddl_lang.lint.mending import Mended, mend, text_to_mend
from nddl_lang.lint.settings import Settings
from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_over, real_path
from nddl_lang.text.source import Source
from nddlc.main import named

_Examine = Callable[[Source, Path], tuple[Diagnostic, ...]]


@dataclass(frozen=True, slots=True)
class MendedFile:
    """A file, its text, and what is left of it after its fixes: None where it is no UTF-8 text."""

    path: Path
    before: str
    mended: Mended | None


def mission_findings(source: Source, root: Path) -> tuple[Diagnostic, ...]:
    """All that is wrong with a solver's configuration, or with a mission file in the folder `root` and its models."""
    found: tuple[Diagnostic, ...]
    if _is_solver(source):
        found = named("checker.solver_file:examine_solver")(source, root)
    else:
        found = named("checker.models:examine")(source, root)
    return found


def mended_files(checker: Checker, path: Path, settings: Settings, *, unsafe: bool) -> Iterator[MendedFile]:
    """The file at `path` after its fixes, and behind a mission its models and the configurations of its solvers."""
    if path.suffix not in MISSION_SUFFIXES:
        yield _as_file(path, checker.mend(path, settings, unsafe=unsafe))
    elif path.name not in (NAME, PROJECT):
        quiet = settings.for_mending()
        # What cannot be read as a mission is mended first: that its models do not fit is seen only behind that.
        mission = _mended(path, [_only_read, mission_findings], quiet, unsafe=unsafe)
        yield mission
        for solver in _solvers(mission):
            yield _mended(solver, [mission_findings], quiet, unsafe=unsafe)
        for model in _models(mission):
            yield _mended(model, [_as_model_of(mission)], quiet, unsafe=unsafe)


def mended_parts(checker: Checker, *, unsafe: bool) -> Iterator[MendedFile]:
    """The files that the models `checker` has mended include, and no others, after their fixes."""
    for path, outcome in checker.mend_parts(unsafe=unsafe):
        yield _as_file(path, outcome)


def _as_file(path: Path, outcome: tuple[str, Mended] | None) -> MendedFile:
    return MendedFile(path, *outcome) if outcome is not None else MendedFile(path, "", None)


def _mended(path: Path, checks: list[_Examine], settings: Settings, *, unsafe: bool) -> MendedFile:
    """The file after what each check in turn finds to mend."""
    before = text_to_mend(path)
    if before is None:
        return MendedFile(path, "", None)
    done = Mended(before, 0, ())
    for examine in checks:

        def check(text: str, examine: _Examine = examine) -> tuple[Diagnostic, ...]:
            return tuple(settings.choose(examine(Source(str(path), text), path.parent)))

        after = mend(done.text, check, unsafe=unsafe)
        done = Mended(after.text, done.count + after.count, after.left)
    return MendedFile(path, before, done)


def _only_read(source: Source, root: Path) -> tuple[Diagnostic, ...]:
    """What is wrong with a mission file apart from its models."""
    if _is_solver(source):
        return mission_findings(source, root)
    found: tuple[Diagnostic, ...] = named("checker.mission:parse_mission")(source, root)[1]
    return found


def _solvers(mission: MendedFile) -> list[Path]:
    """The configurations of solvers that a mission names and that its findings speak of."""
    left = mission.mended.left if mission.mended is not None else ()
    sources = {each.span.source for each in left if each.fixes and _is_solver(each.span.source)}
    return sorted(Path(source.name) for source in sources if Path(source.name) != mission.path)


def _models(mission: MendedFile) -> list[Path]:
    """The models in the folder of a mission that its findings know a fix for."""
    left = mission.mended.left if mission.mended is not None else ()
    sources = {each.span.source for each in left if each.fixes and each.span.source.name.endswith(".nddl")}
    folder = real_path(mission.path.parent)
    return sorted(path for each in sources if real_path(path := Path(each.name)).is_relative_to(folder))


def _as_model_of(mission: MendedFile) -> _Examine:
    """What is wrong with a mission, where one of its models has another text."""
    assert mission.mended is not None
    source = Source(str(mission.path), mission.mended.text)

    def examine(model: Source, _root: Path) -> tuple[Diagnostic, ...]:
        open_text = read_over({real_path(Path(model.name)): model.text})
        found: tuple[Diagnostic, ...] = named("checker.models:examine")(source, mission.path.parent, open_text)
        return found

    return examine


def _is_solver(source: Source) -> bool:
    is_one: bool = named("runtime.solver.configuration.read_toml:is_solver_text")(Path(source.name).name, source.text)
    return is_one
