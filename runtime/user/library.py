"""Find the constraints that modelers wrote: in Python files by path, and in installed packages by entry point."""

import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from hashlib import sha256
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import ModuleType

from nddl_lang.lint.settings import Settings
from nddl_lang.semantics.callables import ENTRY_POINTS, NATIVE_CALLABLES, Callables, owner_of
from nddl_lang.semantics.constraints import ConstraintRow, Origin
from nddl_lang.semantics.functions import FunctionRow, ResultKind
from nddl_lang.semantics.signature import Argument, ArgumentKind, Signature, signature
from runtime.user.constraint import Constraint
from runtime.user.fault import UserCodeError, failed
from runtime.user.limit import USUAL, WATCH, watched
from runtime.user.written import has_test

LIST = "CONSTRAINTS"
NOT_LOADED = "cannot be loaded"
KINDS = (
    ArgumentKind.NUMBER,
    ArgumentKind.BOOL,
    ArgumentKind.STRING,
    ArgumentKind.OBJECT,
    ArgumentKind.ANY,
    ArgumentKind.SAME,
)
RESULTS = {"float": ResultKind.FLOAT, "int": ResultKind.INT, "bool": ResultKind.BOOL}


@dataclass(frozen=True, eq=False, slots=True)
class Library:
    """The constraints of a project in a fixed order; `texts` are those of all files behind them, by name."""

    constraints: tuple[Constraint, ...] = ()
    callables: Callables = NATIVE_CALLABLES
    texts: dict[str, str] = field(default_factory=dict)


NO_LIBRARY = Library()


def load_library(
    root: Path, files: Sequence[str], packages: Iterable[EntryPoint] | None = None, seconds: float = USUAL
) -> Library:
    """Load the modules at `files`, relative to `root`, and those of installed packages; raises UserCodeError.

    Every process that loads the same files has the same library, whichever way it was started. From here on one call
    of their code may take `seconds`, loading a module included.
    """
    WATCH.seconds = seconds
    if packages is None:
        packages = entry_points(group=ENTRY_POINTS)
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
        except KeyboardInterrupt:
            raise
        except BaseException as problem:
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
    return _library(settings.modules, settings.seconds or USUAL)


@cache
def _library(modules: tuple[Path, ...], seconds: float) -> Library:
    here = Path.cwd()
    names = [module.relative_to(here) if module.is_relative_to(here) else module for module in modules]
    return load_library(Path(), [name.as_posix() for name in names], seconds=seconds)


def load_module(path: Path) -> ModuleType:
    """Run the Python file at `path` as a module of its own."""
    name = f"nddlc_user_{sha256(str(path.resolve()).encode()).hexdigest()[:16]}"
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module  # dataclasses and the like look themselves up there
    try:
        # Compiled afresh each time: what lies in a cache is told from the text by its time only.
        with watched("the module", (str(path),)):
            exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except KeyboardInterrupt:
        raise
    except BaseException as problem:
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
    owners: dict[str, str] = {}
    rows: list[ConstraintRow] = []
    functions: list[FunctionRow] = []
    for place, constraint in found:
        name = constraint.name
        if (owner := owner_of(name)) is not None:
            raise UserCodeError(f"{place}: a constraint cannot be called `{name}`: that is {owner}")
        if name in owners:
            raise UserCodeError(f"{place}: there is a constraint `{name}` already, in {owners[name]}")
        owners[name] = place
        row = row_of(place, constraint)
        rows.append(row)
        if constraint.gives is not None:
            functions.append(_function(place, constraint, row))
    return Library(tuple(each for _, each in found), NATIVE_CALLABLES.extended(rows, functions), texts)


def row_of(place: str, constraint: Constraint) -> ConstraintRow:
    """What the language has to know of a constraint; raises UserCodeError where it is not well described."""
    name = constraint.name

    def complain(what: str) -> UserCodeError:
        return UserCodeError(f"{place}: the constraint `{name}` {what}")

    if not (isinstance(name, str) and name.isidentifier() and name.isascii()):
        kind = type(constraint).__name__
        raise UserCodeError(f"{place}: `{kind}` needs a `name` that can be written in a model, not {name!r}")
    if not constraint.meaning:
        raise complain("needs a sentence for its `meaning`")
    try:
        described = signature(constraint.signature)
    except KeyError:
        kinds = ", ".join(kind.name.lower() for kind in KINDS)
        raise complain(f'needs a `signature` such as "x:number y:number"; kinds are {kinds}') from None
    places = _places(described)
    if strange := next((each for each in places if each.kind not in KINDS), None):
        raise complain(f"cannot have an argument of the kind {strange.kind.name.lower()} (`{strange.name}`)")
    if not places:
        raise complain("has no arguments")
    if constraint.result is not None and not -1 <= constraint.result < len(places):
        raise complain(f"has no argument {constraint.result} for a `result`")
    if type(constraint).propagate is Constraint.propagate and not has_test(constraint):
        raise complain("has neither `propagate` nor `holds`")
    return ConstraintRow(
        name,
        described,
        constraint.result,
        constraint.meaning,
        Origin.USER,
        forward_only=constraint.forward_only,
        since=None,
    )


def _places(described: Signature) -> list[Argument]:
    rest = [] if described.rest is None else [described.rest]
    return [*described.required, *described.optional, *rest]


def _function(place: str, constraint: Constraint, row: ConstraintRow) -> FunctionRow:
    result = RESULTS.get(str(constraint.gives))
    if result is None or not row.signature.required:
        what = f'gives {constraint.gives!r}; a function gives "float", "int" or "bool", as its first argument'
        raise UserCodeError(f"{place}: the constraint `{constraint.name}` {what}")
    inputs = Signature(row.signature.required[1:], row.signature.optional, row.signature.rest)
    return FunctionRow(
        constraint.name, inputs, result, constraint.name, constraint.meaning, Origin.USER, overlooks_rest=False
    )
