"""The text of a solver's configuration in; all that is wrong with it, also for the missions beside it, out."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from checker.mission import Mission, parse_mission
from checker.models import load_models
from nddl_lang.mission_suffixes import mission_text
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_text, real_path
from nddl_lang.text.source import Source
from runtime.solver.configuration.read import read_configuration


def examine_solver(source: Source, root: Path) -> tuple[Diagnostic, ...]:
    """What is wrong with the configuration `source` by itself, and by all missions in the folder `root` that name it.

    Missions that name constraints in Python are left out, for these would be run.
    """
    configuration, found = read_configuration(source)
    if configuration is None:
        return found
    here = real_path(Path(source.name))

    def open_text(path: Path) -> str | None:
        return source.text if real_path(path) == here else read_text(path)

    of_missions: list[dict[tuple[int, str], Diagnostic]] = []
    for mission in _missions_with(here, root):
        with suppress(OSError):  # a model that cannot be read is the mission's fault
            told = load_models(mission, open_text).diagnostics
            ours = (each for each in told if real_path(Path(each.span.source.name)) == here)
            of_missions.append({(each.span.begin, each.message): each for each in ours})
    known = {(each.span.begin, each.message) for each in found}
    agreed = set(of_missions[0]).intersection(*of_missions) - known if of_missions else set()
    return (*found, *(of_missions[0][each] for each in sorted(agreed)))


def _missions_with(solver: Path, root: Path) -> Iterator[Mission]:
    """The missions in a folder whose reactors plan with that file, as far as they can be read."""
    for path in sorted(root.glob("*.toml")):
        text = None
        with suppress(OSError):
            text = mission_text(path)
        if text is None or solver.name not in text:
            continue
        mission, _ = parse_mission(Source(str(path), text), root)
        if mission is None or mission.agent.constraints:
            continue
        if any(each.solver is not None and real_path(root / each.solver) == solver for each in mission.agent.reactors):
            yield mission
