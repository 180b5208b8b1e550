"""Find the constraints that modelers wrote: in Python files by path, and in installed packages by entry point."""

import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from hashlib import sha256
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import ModuleType

from nddl_lang.lint.python_module import LIST
from nddl_lang.lint.settings import Settings
from nddl_lang.semantics.callables import ENTRY_POINTS, NATIVE_CALLABLES, Callables
from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.semantics.described import Description, DescriptionError, described
from nddl_lang.semantics.described import row_of as described_row
from runtime.user.constraint import Constraint
from runtime.user.fault import UserCodeError, failed
from runtime.user.limit import USUAL, WATCH, watched
from runtime.user.output import keep_output_apart
from runtime.user.written import has_test

NOT_LOADED = "cannot be loaded"


@dataclass(frozen=True, eq=False, slots=True)
class Library:
    """The constraints of a project in a fixed order; `texts` are those of all files behind them, by name."""

    constraints: tuple[Constraint, ...] = ()
    callables: Callables = NATIVE_CALLABLES
    texts: dict[str, str] = field(default_factory=dict)


NO_LIBRARY = Library()


@cache
def _installed() -> tuple[EntryPoint, ...]:
    """The entry points of installed packages: to look for them takes longer than to read a small model."""
    return tuple(entry_points(group=ENTRY_POINTS))


def load_library(
    root: Path, files: Sequence[str], packages: Iterable[EntryPoint] | None = None, seconds: float = USUAL
) -> Library:
    """Load the modules at `files`, relative to `root`, and those of installed packages; raises UserCodeError.

    Every process that loads the same files has the same library, whichever way it was started. From here on one call
    of their code may take `seconds`, loading a module included.
    """
    WATCH.seconds = seconds
    if packages is None:
        packages = _installed()
    found: list[tuple[str, Constraint]] = []
    texts: dict[str, str] = {}
    for name in dict.fromkeys(files):
        path = root / name
        module = load_module(path)
        own = _list_of(path.as_posix(), getattr(module, LIST, None))
        found += [(path.as_posix(), each) for each in own]
        _note_texts(texts, name, path, own)
    for point in sorted(packages, key=lambda each: (each.name, each.value)):
        place = f"entry point `{point.name}` ({point.value})"
        try:
            with watched(f"the {place}"):
                loaded = point.load()
        except BaseException as problem:
            if isinstance(problem, KeyboardInterrupt) and WATCH.was_pressed:
                raise
            raise failed(f"the {place}", problem, (), verb=NOT_LOADED) from problem
        own = _list_of(place, getattr(loaded, LIST, None) if isinstance(loaded, ModuleType) else loaded)
        found += [(place, each) for each in own]
        for each in own:
            module_file = getattr(sys.modules.get(type(each).__module__), "__file__", None)
            if module_file is not None:
                _note_texts(texts, f"{point.name}:{Path(module_file).name}", Path(module_file), [each])
    return _checked(found, texts) if found else NO_LIBRARY


def library_of(settings: Settings) -> Library:
    """The constraints that a project names in its settings, loaded once; raises UserCodeError as `load_library`."""
    return _library(tuple(each.path for each in settings.modules), settings.seconds or USUAL)


def seen_from_here(file: Path) -> Path:
    """A file as somebody in the working directory names it."""
    here = Path.cwd()
    return file.relative_to(here) if file.is_relative_to(here) else file


@cache
def _library(modules: tuple[Path, ...], seconds: float) -> Library:
    names = [seen_from_here(module).as_posix() for module in modules]
    return load_library(Path(), names, seconds=seconds)


def load_module(path: Path) -> ModuleType:
    """Run the Python file at `path` as a module of its own."""
    keep_output_apart()
    name = f"nddlc_user_{sha256(str(path.resolve()).encode()).hexdigest()[:16]}"
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module  # dataclasses and the like look themselves up there
    try:
        # Compiled afresh each time: what lies in a cache is told from the text by its time only.
        with watched("the module", (str(path),)):
            exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except BaseException as problem:
        if isinstance(problem, KeyboardInterrupt) and WATCH.was_pressed:
            raise
        del sys.modules[name]
        if isinstance(problem, OSError) and problem.filename == str(path):
            raise UserCodeError(f"cannot read the module `{path}`: {problem.strerror}") from None
        raise failed("the module", problem, (str(path),), verb=NOT_LOADED) from problem
    return module


def _list_of(place: str, found: object) -> list[Constraint]:
    """What a module or entry point offers: one constraint, or several."""
    if isinstance(found, Constraint):
        return [found]
    if isinstance(found, list | tuple) and found and all(isinstance(each, Constraint) for each in found):
        return list(found)
    if isinstance(found, type) and issubclass(found, Constraint):
        raise UserCodeError(f"{place}: `{found.__name__}` is a class; name an object of it, `{found.__name__}()`")
    if isinstance(found, list | tuple):
        for each in found:
            if isinstance(each, type):
                raise UserCodeError(f"{place}: `{LIST}` has the class `{each.__name__}`; write `{each.__name__}()`")
    raise UserCodeError(f"{place}: no constraints; end it with a list such as `{LIST} = [MyConstraint()]`")


def _note_texts(texts: dict[str, str], name: str, path: Path, constraints: Iterable[Constraint]) -> None:
    """Keep what the constraints rest on: their module, and the files that they say they read."""
    texts[name] = path.read_bytes().decode("utf-8", "surrogateescape")
    for each in constraints:
        for file in each.files:
            try:
                text = (path.parent / file).read_bytes().decode("utf-8", "surrogateescape")
            except OSError as problem:
                what = f"cannot read `{file}`, which `{each.name}` names among its files"
                raise UserCodeError(f"{path.as_posix()}: {what}: {problem.strerror}") from None
            texts[(Path(name).parent / file).as_posix()] = text


def _checked(found: list[tuple[str, Constraint]], texts: dict[str, str]) -> Library:
    try:
        callables = described(NATIVE_CALLABLES, [(place, _description(each)) for place, each in found])
    except DescriptionError as problem:
        raise UserCodeError(str(problem)) from None
    for place, each in found:
        row_of(place, each)
    return Library(tuple(each for _, each in found), callables, texts)


def row_of(place: str, constraint: Constraint) -> ConstraintRow:
    """What the language has to know of a constraint; raises UserCodeError where it is not well described."""
    try:
        row = described_row(place, _description(constraint))
    except DescriptionError as problem:
        raise UserCodeError(str(problem)) from None
    if type(constraint).propagate is Constraint.propagate and not has_test(constraint):
        raise UserCodeError(f"{place}: the constraint `{constraint.name}` has neither `propagate` nor `holds`")
    return row


def _description(each: Constraint) -> Description:
    kind = type(each).__name__
    return Description(kind, each.name, each.signature, each.meaning, each.result, each.forward_only, each.gives)
