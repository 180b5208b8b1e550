"""Figures that a mission file asks for: the table [figures] in, timelines and arguments by their part in them out."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from checker.codes import NO_ARGUMENT, NO_OWNER, NO_PREDICATE
from checker.mission_table import MissionText, Table
from checker.named_objects import named_objects
from checker.respelt import respelt
from compiler.program import PredicateCode, Program
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from runtime.executive.configuration import AgentConfiguration

_CELL = 5.0  # metres of depth


@dataclass(frozen=True, slots=True)
class Figures:
    """Where a vehicle is, and what colours and marks its path; an empty name leaves that out.

    The path is drawn `during` the time in which that timeline does not hold its first predicate.
    """

    path: str
    position: tuple[str, ...]  # arguments: east, north, depth
    during: str = ""
    feature: str = ""
    probability: str = ""  # an argument of `feature`; 0 where a token has none
    samples: str = ""
    firing: str = ""  # a predicate of `samples`
    phases: str = ""
    targets: str = ""
    cell: float = _CELL


def read_figures(table: Table, owned: tuple[str, ...]) -> Figures | None:
    """The table [figures], None where it is not written."""
    if not table.values:
        return None
    position = table.strings("position") or ("x", "y", "z")
    if len(position) != 3:
        table.complain_of_value("position", list(position), "three arguments: east, north, depth")
    feature, probability = _pair(table, "feature", "argument")
    samples, firing = _pair(table, "samples", "predicate")
    found = Figures(
        table.string("path"), position, table.string("during", ""), feature, probability, samples, firing,
        table.string("phases", ""), table.string("targets", ""), table.number("cell", _CELL, 0.001),
    )  # fmt: skip
    for key in ("path", "during", "feature", "samples", "phases", "targets"):
        timeline = getattr(found, key)
        if timeline and timeline not in owned:
            close = nearest(timeline, owned)
            advice = f"did you mean `{close}`?" if close else "owned timelines: " + ", ".join(owned)
            span = table.text.value_span((*table.path, key))
            complaint = NO_OWNER.at(span, timeline=timeline, help=advice)
            table.text.unowned.append((timeline, respelt(complaint, timeline, owned)))
    table.close()
    return found


def _pair(table: Table, key: str, what: str) -> tuple[str, str]:
    """A timeline and what of it, written with a dot between them."""
    text = table.string(key, "")
    timeline, dot, name = text.partition(".")
    if text and not (timeline and dot and name):
        table.complain_of_value(key, f"`{text}`", f"a timeline and its {what}, such as `timeline.{what}`")
        return "", ""
    return timeline, name


def figure_misfits(
    figures: Figures, text: MissionText, agent: AgentConfiguration, programs: Mapping[str, Program]
) -> Iterator[Diagnostic]:
    """Complain of arguments and predicates that the models do not have."""
    wanted = [("position", figures.path, name) for name in figures.position]
    wanted += [("feature", figures.feature, figures.probability)] if figures.feature else []
    for key, timeline, name in wanted:
        predicates = _predicates_of(timeline, agent, programs)
        known = dict.fromkeys(one.name for each in predicates for one in each.parameters)
        if predicates and name not in known:
            span = text.value_span(("figures", key))
            close = nearest(name, known)
            advice = f"did you mean `{close}`?" if close else f"arguments: {', '.join(known) or 'none'}"
            yield NO_ARGUMENT.at(span, predicate=timeline, name=name, help=advice)
    predicates = _predicates_of(figures.samples, agent, programs)
    known = dict.fromkeys(one.name.rpartition(".")[2] for one in predicates)
    if predicates and figures.firing not in known:
        close = nearest(figures.firing, known)
        advice = f"did you mean `{close}`?" if close else f"predicates: {', '.join(known)}"
        span = text.value_span(("figures", "samples"))
        yield NO_PREDICATE.at(span, class_name=figures.samples, predicate=figures.firing, help=advice)


def _predicates_of(
    timeline: str, agent: AgentConfiguration, programs: Mapping[str, Program]
) -> Sequence[PredicateCode]:
    """The predicates that may hold on a timeline, as the first model that lists it says; none where no model does."""
    listed = [one for one in agent.reactors if timeline in (*one.internal, *one.external)]
    program = next((programs[one.model] for one in listed if one.model in programs), None)
    if program is None:
        return ()
    objects = named_objects(program)
    return [one for one in program.predicates if one.class_name == objects.get(timeline)]
