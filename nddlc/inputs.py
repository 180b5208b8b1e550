"""What subcommands that read models share: their options, files checked before any work, and when to colour."""

import os
import re
import stat
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import click

from nddl_lang.lint.configuration import find_configuration, read_configuration
from nddl_lang.lint.settings import Settings
from nddl_lang.mission_suffixes import MISSION_SUFFIXES, mission_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.roots import parts_of, roots_among
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import LARGEST, kind_of, real_path
from nddl_lang.text.render import render
from nddl_lang.text.write import write_whole
from nddlc.fitting import columns, fitted

Function = TypeVar("Function", bound=Callable[..., Any])

STORE = Path(".nddlc/runs.sqlite")  # where runs are kept unless another place is named

_NUMBER = re.compile(r"k?[0-9]+")
_MISSION = "`nddlc lint` looks at missions and configurations"
_NO_MODELS = {
    **dict.fromkeys(MISSION_SUFFIXES, _MISSION),
    **dict.fromkeys((".py", ".md", ".json", ".jsonl", ".sqlite", ".html"), "`nddlc --help` tells what reads others"),
}
_NAMED = (".nddl", *MISSION_SUFFIXES, ".json", ".jsonl")


class Unusable(click.ClickException):
    """A command line that cannot be carried out, with what to do about it."""

    exit_code = 2

    def __init__(self, message: str, advice: str | None = None) -> None:
        super().__init__(message)
        self.advice = advice

    def show(self, file: Any = None) -> None:
        """One line of complaint, one of advice."""
        click.echo(fitted(f"nddlc: {self.message}", columns()), err=True)
        if self.advice is not None:
            click.echo(fitted(f"  help: {self.advice}", columns()), err=True)


def mission_of_run(what: str) -> tuple[str, int | None]:
    """The name of a run and the number of a mission that `RUN#MISSION` names; `k3`, the third kept failure, is -3."""
    name, _, number = what.partition("#")
    if not (name or number):
        raise Unusable(f"`{what}` names no run", "write RUN#MISSION, such as latest#37, or RUN, such as latest")
    if number and _NUMBER.fullmatch(number) is None:
        raise Unusable(f"`{number}` is no number of a mission", "write RUN#MISSION, such as latest#37")
    if not number:
        return name, None
    return name, -int(number[1:]) if number.startswith("k") else int(number)


def model_files(command: Function) -> Function:
    """Let a command take model files and the directories of their includes."""
    return click.argument("files", nargs=-1, required=True, metavar="FILE...")(_reading(command))


def model_paths(command: Function) -> Function:
    """Like `model_files`, for a command that takes directories as well, and without any the project's."""
    return click.argument("files", nargs=-1, metavar="[FILE...]", callback=_named_or_project)(_reading(command))


def _reading(command: Function) -> Function:
    """The options of commands that read models."""
    command = click.option(
        "-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too."
    )(command)
    return click.option(
        "--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command."
    )(command)


def _named_or_project(_context: click.Context, _parameter: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    """The files that are named, else the folder of the settings that hold here, else this folder."""
    settings = None if names else find_configuration(Path())
    return names or ("." if settings is None else os.path.relpath(settings.parent, real_path(Path())),)


def models_in(names: tuple[str, ...], directories: tuple[str, ...]) -> list[Path]:
    """The files that are named, and those below the directories that are, without files that others there include."""
    found: dict[Path, None] = {}
    for name in names:
        if Path(name).is_dir():
            roots = roots_among(models_below(name), [Path(directory) for directory in directories])
            found.update(dict.fromkeys(roots))
        else:
            found.update(dict.fromkeys(readable((name,), directories)))
    return list(found)


def missions_below(names: tuple[str, ...]) -> list[Path]:
    """The mission files (.toml) below the directories that are named, but for those that are named themselves."""
    known = {real_path(Path(name)) for name in names}
    found: list[Path] = []
    for name in names:
        for path in sorted(Path(name).rglob("*.toml")) if Path(name).is_dir() else ():
            is_asked = _is_model(path, path.relative_to(name)) and path.is_file() and real_path(path) not in known
            if is_asked and mission_text(path) is not None:
                found.append(path)
    return found


def models_below(directory: str) -> list[Path]:
    """All models below a directory; complains where there is none."""
    next(Path(directory).iterdir(), None)  # where it cannot be read, nothing would be found, and nothing said
    below = [path for path in sorted(Path(directory).rglob("*.nddl")) if _is_model(path, path.relative_to(directory))]
    if not below:
        raise Unusable(f"there is no model (.nddl) in `{directory}`")
    return below


def parts_in(names: tuple[str, ...], models: list[Path], directories: tuple[str, ...]) -> frozenset[Path]:
    """The files that are known to be parts of these models alone, resolved.

    They are those below the directories that are named, and what no other file beside them includes.
    """
    below = {real_path(path) for name in names if Path(name).is_dir() for path in Path(name).rglob("*.nddl")}
    named = [Path(name) for name in names if not Path(name).is_dir()]
    alone = parts_of(models if named else [], [Path(directory) for directory in directories])
    return frozenset((below | alone) - {real_path(path) for path in models})


def _is_model(path: Path, below: Path) -> bool:
    """Whether a path found below a directory is to be read; nobody waits for a pipe that happens to lie there."""
    if any(part.startswith(".") for part in below.parts) or path.is_dir():
        return False
    if path.exists() and not path.is_file():
        click.echo(f"nddlc: left out `{path}`: it is {kind_of(path.stat().st_mode)}, not a file", err=True)
        return False
    return True


@cache
def _configuration(directory: Path) -> Settings:
    path = find_configuration(directory)
    if path is None:
        return Settings()
    settings, complaints = read_configuration(path)
    if complaints:
        click.echo("\n".join(render(each, colour=False) for each in complaints), err=True)
        raise Unusable(f"`{path}` cannot be used")
    return settings


def configured(path: Path) -> Settings:
    """The settings of the project that a file belongs to."""
    return _configuration(real_path(path).parent)


@dataclass(frozen=True, slots=True)
class ReadBy:
    """How a model is read: the folders of its includes, its dialect unless its first line says, its greatest size."""

    directories: tuple[str, ...]
    dialect: Dialect | None
    most: int


def read_by(ctx: click.Context, path: Path, directories: tuple[str, ...] = (), dialect: str | None = None) -> ReadBy:
    """What the command line says of a model, and its project where that is silent."""
    settings = configured(path)
    folders = (*directories, *map(str, settings.directories))
    return ReadBy(folders, chosen_dialect(ctx, dialect) or settings.dialect, settings.most_lexemes)


def write_text(path: Path, text: str, advice: str | None = None) -> None:
    """Put a text into a file; complains where that cannot be, with the advice."""
    try:
        write_whole(path, text)
    except OSError as problem:
        raise Unusable(f"cannot write `{path}`: {problem.strerror or problem}", advice) from None


def chosen_dialect(ctx: click.Context, given: str | None) -> Dialect | None:
    """The dialect that the command line asks for; None leaves the choice to the texts."""
    name = given or ctx.obj
    return None if name is None else Dialect(name)


def readable(files: tuple[str, ...], directories: tuple[str, ...]) -> list[Path]:
    """The files as paths; complains before any work of one that cannot be read."""
    for name in directories:
        if not Path(name).is_dir():
            raise Unusable(f"no directory `{name}` to look for includes in")
    return [_readable(name) for name in files]


def _readable(name: str) -> Path:
    path = Path(name)
    try:
        if path.is_dir():
            if not name:
                raise Unusable("an empty name names no file")
            raise Unusable(f"`{name}` is a directory", _in_directory(path))
        with path.open("rb", buffering=0) as file:
            _check_kind(name, file.fileno())
    except FileNotFoundError:
        raise Unusable(f"no file `{name}`", _alike(path)) from None
    except OSError as problem:
        raise Unusable(f"cannot read `{name}`: {problem.strerror or problem}") from None
    except ValueError as problem:  # a name that no file can have
        raise Unusable(f"cannot read `{name}`: {problem}") from None
    return path


def present(path: Path | None) -> None:
    """Complain of a file or folder that is not there, with the one that was probably meant."""
    if path is not None and not path.exists():
        raise Unusable(f"no file `{path}`", _alike(path))


def models_only(files: tuple[str, ...]) -> None:
    """Complain of what is no model by its name, for a command that reads nothing else."""
    for name in files:
        if Path(name).suffix.lower() in _NO_MODELS:
            raise Unusable(f"`{name}` is no model", f"models end in .nddl; {_NO_MODELS[Path(name).suffix.lower()]}")


def _in_directory(path: Path) -> str | None:
    """What to name instead of a directory."""
    missions = sorted(path.glob("*.toml"))
    if len(missions) == 1:
        return f"name a file in it: `{missions[0]}` is a mission, models end in .nddl"
    return f"name the files in it, as in `{path / '*.nddl'}`" if next(path.glob("*.nddl"), None) is not None else None


def _check_kind(name: str, file: int) -> None:
    """Complain of what is no text of a model for certain; nothing is read, as a pipe is read only once."""
    kind = os.fstat(file)
    if stat.S_ISBLK(kind.st_mode) or (stat.S_ISCHR(kind.st_mode) and not os.isatty(file) and name != os.devnull):
        raise Unusable(f"`{name}` is a device")
    if kind.st_size > LARGEST:
        raise Unusable(f"`{name}` is too large: {kind.st_size / 2**20:.0f} MiB, and {LARGEST / 2**20:.0f} are read")


def _alike(path: Path) -> str | None:
    """A file that may have been meant."""
    for candidate in (path.with_suffix(".nddl"), Path(f"{path}.nddl")):
        if candidate != path and candidate.is_file():
            return f"there is `{candidate}`"
    try:
        beside = [each for each in sorted(path.parent.iterdir()) if each.suffix in _NAMED]
    except OSError:
        return f"there is no directory `{path.parent}`"
    whole, stems = {each.name: each for each in beside}, {each.stem: each for each in beside}
    for name, known in ((path.stem, stems), (path.name, whole)):
        if (meant := nearest(name, known)) is not None:
            return f"did you mean `{known[meant]}`?"
    return None


def mission_here(given: str | None) -> str:
    """The file that is named; else `mission.toml` in this folder, or in the only folder below that has one."""
    if given is not None:
        return given
    here = Path("mission.toml")
    below = [here] if here.is_file() else sorted(Path().glob("*/mission.toml"))
    if len(below) == 1:
        return str(below[0])
    if not below:
        raise Unusable("there is no `mission.toml` here", "name a mission file, or begin a project: `nddlc new NAME`")
    raise Unusable(
        "several folders here have a `mission.toml`", "name one: " + ", ".join(f"`{each}`" for each in below)
    )
