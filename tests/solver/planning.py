"""Plan a model given as text, for tests."""

from pathlib import Path

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.source import Source
from runtime.loading import Loaded, load
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.configuration.read import read_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import RESULT_NAMES

RESOURCES = """
[[filter]]
component = "HorizonFilter"
[[manager]]
component = "ResourceThreatManager"
default_priority = 2
order = "most,earliest,lower"
[[manager]]
component = "ThreatManager"
default_priority = 1
filter = [{ class = "Reusable" }]
[[manager]]
component = "OpenConditionManager"
default_priority = 1
[[manager]]
component = "UnboundVariableManager"
default_priority = 2
filter = [
  { component = "InfiniteDynamicFilter" },
  { variable = "start" }, { variable = "end" }, { variable = "duration" }, { variable = "time" },
]
"""


def resources_configuration() -> Configuration:
    """A configuration that mends resources too, after the order of tokens."""
    found, complaints = read_configuration(Source("resources.toml", RESOURCES))
    assert found is not None and not complaints
    return found


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
