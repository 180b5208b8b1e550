"""The models of a mission, read if the Python that it asks for may be run (docs/security.md)."""

from collections.abc import Iterable
from pathlib import Path

from checker.mission import Mission
from checker.models import ModelSet, load_models
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span
from nddlc.trust import permit


def models_of(mission: Mission, *, is_trusted: bool, is_named: bool = True, is_linted: bool = False) -> ModelSet:
    """The models of a mission, read and checked; `is_named`: the command line names the mission, not another file.

    `is_linted`: what lint warns of is found out, too.
    """
    if not is_trusted:
        root = real_path(Path(mission.agent.root))
        here = real_path(Path.cwd())
        permit(_python_of(mission), root, is_named or root.is_relative_to(here))
    return load_models(mission, is_linted=is_linted)


def _python_of(mission: Mission) -> Iterable[tuple[Path, Span]]:
    """The Python files that a mission asks for, each with its place."""
    agent, text = mission.agent, mission.text
    root = Path(agent.root)
    for index, file in enumerate(agent.constraints):
        yield root / file, text.value_span(("constraints", "modules", index))
    places = [place for place in text.places if place[:1] == ("reactor",) and place[2:] == ("code",)]
    for place, reactor in zip(sorted(places, key=lambda each: int(each[1])), agent.coded, strict=True):
        if reactor.file:
            yield root / reactor.file, text.value_span(place)
