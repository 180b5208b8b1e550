"""Plan a model given as text, for tests."""

from pathlib import Path

from nddl_lang.syntax.dialect import Dialect
from nddlc.loading import Loaded, load
from runtime.solver.codes import RESULT_NAMES
from runtime.solver.configuration import Configuration, default_configuration
from runtime.solver.search import Solver


def loaded(folder: Path, text: str) -> Loaded:
    """The model after its script has run."""
    path = folder / "model.nddl"
    path.write_text(text)
    found = load(path, (), Dialect("nddl3"))
    assert found.database is not None and not found.is_refused, [each.message for each in found.diagnostics]
    return found


def solver_for(
    folder: Path,
    text: str,
    *,
    europa: bool = False,
    horizon: tuple[int, int] = (0, 100),
    how: Configuration | None = None,
) -> Solver:
    """A solver that has not begun."""
    database = loaded(folder, text).database
    assert database is not None
    return Solver(database, how or default_configuration(), horizon[0], horizon[1], europa)


def verdict(folder: Path, text: str, *, europa: bool = False, most: int = 20000) -> str:
    """What the search says."""
    return RESULT_NAMES[solver_for(folder, text, europa=europa).solve(most, 2**60)]
