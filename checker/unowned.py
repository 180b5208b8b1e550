"""Timelines that no reactor owns: complaints of their users in; where a model tells the owner, one at its line out."""

from collections.abc import Sequence
from pathlib import Path

from checker.codes import NO_OWNER, NO_TIMELINE
from checker.declared_roles import declared_objects
from checker.mission_table import MissionText
from checker.respelt import rewritten
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span
from runtime.executive.configuration import ReactorConfiguration

_Modes = dict[str, str]  # of the objects of a model


def tell_unowned(text: MissionText, reactors: Sequence[ReactorConfiguration], root: Path) -> None:
    """Complain of timelines without an owner: where one model alone has it `Internal`, at its reactor only."""
    waiting = text.unowned if not text.may_declare else []
    models = {one.model: declared_objects(root / one.model) for one in reactors if one.model} if waiting else {}
    told: set[str] = set()
    for timeline, complaint in waiting:
        owners = [
            (number, one)
            for number, one in enumerate(reactors)
            if models.get(one.model, {}).get(timeline) == "Internal"
        ]
        if len(owners) != 1:
            text.diagnostics.append(complaint)
        elif timeline not in told:
            told.add(timeline)
            number, owner = owners[0]
            missing = {each for each, _ in text.unowned if models[owner.model].get(each) == "Internal"}
            text.diagnostics.append(_at_owner(text, number, owner, models[owner.model], timeline, len(missing) == 1))


def _at_owner(
    text: MissionText, number: int, owner: ReactorConfiguration, modes: _Modes, timeline: str, is_only: bool
) -> Diagnostic:
    """What is wrong at the owner: it lists the timeline under another name, which its model does not have, or not."""
    path = (*text.reactor_path(number), "internal")
    strange = [(index, name) for index, name in enumerate(owner.internal) if name not in modes]
    meant = [each for each in strange if nearest(each[1], [timeline]) is not None]
    if not meant and len(strange) == 1 and is_only:
        meant = strange
    if meant:
        index, name = meant[0]
        span = text.value_span((*path, index))
        help_ = f"did you mean `{timeline}`, which is `Internal` there?"
        return rewritten(NO_TIMELINE.at(span, model=owner.model, timeline=name, help=help_), name, timeline)
    is_there = path in text.places
    span = text.value_span(path) if is_there else text.key_span(path[:2])
    help_ = f"`{timeline}` is `Internal` in `{owner.model}`: list it under `internal` of `{owner.name}`"
    complaint = NO_OWNER.at(span, timeline=timeline, help=help_)
    if not is_there or not span.text.rstrip().endswith("]"):
        return complaint
    written = f', "{timeline}"' if owner.internal and not span.text.rstrip("] \t\n").endswith(",") else f'"{timeline}"'
    last = span.start + len(span.text.rstrip()[:-1].rstrip())
    fix = Fix(f'add `"{timeline}"`', (Edit(Span(span.anchor, last, last), written),), safe=False)
    return Diagnostic(
        complaint.code, complaint.severity, span, complaint.message, complaint.notes, complaint.help, (fix,)
    )
