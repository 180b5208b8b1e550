"""A mission file in, its sites out: the times that it asks of goals, each a little wider, or not asked at all."""

import re
from collections.abc import Iterator
from pathlib import Path

from checker.mission import Mission, parse_mission
from checker.mutation.edits import EditKind, EditSite, SmallEdit, changed_number, edited
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Source, Span
from runtime.executive.configuration import GoalConfiguration

_TIMES = ("start", "end", "duration")
_NUMBER = re.compile(r"(?<![\w.])-?\d+(\.\d+)?(?![\w.])")


def goal_sites(mission: Mission) -> list[EditSite]:
    """The entries of a TOML file that bound times of goals; edits after which it is no mission are left out."""
    text, file = mission.text, str(mission_file(mission))
    if file.endswith(".xml"):
        return []
    found = []
    for path in (("goal", number, key) for number in range(len(mission.agent.goals)) for key in _TIMES):
        if path not in text.places:
            continue
        entry = text.entry_span(path)
        edits = [SmallEdit(EditKind.DROPPED_CONSTRAINT, file, entry.begin, entry.finish, entry.text, "", entry.line)]
        edits += _widened(text.value_span(path), file)
        usable = tuple(edit for edit in edits if goals_with(mission, edit) is not None)
        lines = (entry.line, entry.source.locate(entry.finish - 1)[0])
        site = EditSite(file, lines[0], entry.column, lines[1], "", lines, entry.text, usable, begin=entry.begin)
        found.append(site)
    return found


def goals_with(mission: Mission, edit: SmallEdit) -> tuple[GoalConfiguration, ...] | None:
    """The goals of a mission file after an edit; None where it is no mission any more."""
    source = Source(mission.source.name, edited(mission.source.text, edit))
    changed, _ = parse_mission(source, Path(mission.agent.root))
    return None if changed is None else changed.agent.goals


def mission_file(mission: Mission) -> Path:
    """The real path of a mission file."""
    return real_path(Path(mission.agent.root) / Path(mission.source.name).name)


def _widened(value: Span, file: str) -> Iterator[SmallEdit]:
    """A lower bound made smaller, an upper one greater; where one number stands for both, either way."""
    is_pair = value.text.startswith("[")
    numbers = list(_NUMBER.finditer(value.text))
    for place in numbers:
        is_lower = is_pair and "," not in value.text[: place.start()]
        begin = value.begin + place.start()
        line = value.source.locate(begin)[0]
        for kind, new in changed_number(place.group()):
            if not is_pair or (float(new) < float(place.group())) == is_lower:
                yield SmallEdit(kind, file, begin, value.begin + place.end(), place.group(), new, line)
