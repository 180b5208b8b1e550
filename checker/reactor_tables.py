"""Read the reactors of a mission file: `[[reactor]]` tables in, their configurations out, owners and users compared."""

from pathlib import Path

from checker.codes import CYCLE, NO_OWNER, TWICE, UNKNOWN_CHOICE
from checker.declared_roles import declared_roles
from checker.mission_table import Table
from checker.named_files import look_at, look_at_class
from checker.played_log import look_at_log
from checker.respelt import respelt
from nddl_lang.text.diagnostic import Note
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span
from runtime.executive.configuration import CodeConfiguration, ReactorConfiguration, Value
from runtime.user.log_player import LogPlayer


def _read_code(table: Table) -> CodeConfiguration:
    """A reactor written in Python: `code = "file.py:Class"`, with its settings."""
    file, _, class_name = table.string("code").rpartition(":")
    settings = table.table("settings", "[reactor.settings]")
    given = tuple((key, _setting(settings, key)) for key in settings.values)
    return CodeConfiguration(
        name=table.string("name"),
        file=file,
        class_name=class_name,
        latency=table.whole("latency", 0, 0),
        internal=table.strings("internal", "external"),
        external=table.strings("external", "internal"),
        settings=given,
        lookahead=table.whole("lookahead", 0, 0),
    )


def _setting(table: Table, key: str) -> Value:
    value = table.values[key]
    if isinstance(value, bool | int | float | str):
        return value
    table.complain_of_type(key, "a number, a text in quotes, or true or false")
    return 0


def _read_model(table: Table, root: Path) -> ReactorConfiguration:
    """A reactor with a model; where the file lists no timelines, they have the roles that the model declares."""
    default = ReactorConfiguration("", "")
    model = table.string("model")
    is_told = any(table.has(key) for key in ("internal", "external", "observe"))
    roles = {} if is_told or not model else declared_roles(root / model)
    internal, external = table.strings("internal", "external"), table.strings("external", "internal")
    return ReactorConfiguration(
        name=table.string("name"),
        model=model,
        latency=table.whole("latency", default.latency, 0),
        lookahead=table.whole("lookahead", default.lookahead, 0),
        internal=roles.get("internal") or internal,
        external=roles.get("external") or external,
        solver=table.string("solver", "") or None,
        early=table.strings("early"),
        late=table.strings("late"),
        observe=roles.get("observe") or table.strings("observe"),
        max_steps=table.whole("max_steps", 0, 0) or None,
        max_depth=table.whole("max_depth", 0, 0) or None,
    )


def read_reactors(
    tables: list[Table], root: Path
) -> tuple[tuple[ReactorConfiguration, ...], tuple[CodeConfiguration, ...]]:
    """Read the reactors with a model and those in Python; complaints go to the text of the tables."""
    reactors: list[ReactorConfiguration | CodeConfiguration] = []
    owners: dict[str, tuple[str, Span]] = {}
    names: dict[str, Span] = {}
    twins: set[str] = set()  # who uses one of these does not say whom
    for table in tables:
        is_code = table.has("code") or (table.means("code") and not table.means("model"))
        reactor: ReactorConfiguration | CodeConfiguration = _read_code(table) if is_code else _read_model(table, root)
        table.close()
        reactors.append(reactor)
        files = (
            (("code", reactor.file),)
            if isinstance(reactor, CodeConfiguration)
            else (("model", reactor.model), ("solver", reactor.solver))
        )
        for key, file in files:
            is_there = not file or look_at(table.text, (*table.path, key), root, file)
            if isinstance(reactor, CodeConfiguration) and reactor.class_name and is_there:
                look_at_class(table.text, (*table.path, key), root, reactor.file, reactor.class_name)
        if isinstance(reactor, CodeConfiguration) and not reactor.file and reactor.class_name == LogPlayer.__name__:
            look_at_log(table.text, table.path, root, dict(reactor.settings))
        span = table.text.value_span((*table.path, "name"))
        if reactor.name in names:
            _complain_of_twin(table, span, "the reactor", reactor.name, names[reactor.name])
        names.setdefault(reactor.name, span)
        if isinstance(reactor, ReactorConfiguration):
            _look_at_names(table, reactor)
        for index, timeline in enumerate(reactor.internal):
            span = table.text.value_span((*table.path, "internal", index))
            if timeline in owners:
                _complain_of_twin(table, span, "an owner of the timeline", timeline, owners[timeline][1])
                twins.add(timeline)
            owners.setdefault(timeline, (reactor.name, span))
    are_told = _are_owners_told(tables)
    for table, reactor in zip(tables, reactors, strict=True):
        for index, timeline in enumerate(reactor.external):
            if timeline not in owners and are_told:
                span = table.text.value_span((*table.path, "external", index))
                complaint = NO_OWNER.at(span, timeline=timeline, help=suggest_owned(timeline, [*owners]))
                table.text.unowned.append((timeline, respelt(complaint, timeline, owners)))
            elif timeline in reactor.internal and timeline not in twins:
                span = table.text.value_span((*table.path, "external", index))
                help_ = f"`{reactor.name}` owns it: remove it from `internal` or from `external`"
                table.text.diagnostics.append(TWICE.at(span, what="the timeline", name=timeline, help=help_))
                twins.add(timeline)
    cycle = _find_cycle(reactors, {timeline: name for timeline, (name, _) in owners.items() if timeline not in twins})
    if cycle:
        span = tables[0].text.key_span(tables[0].path)
        tables[0].text.diagnostics.append(CYCLE.at(span, cycle=" → ".join(cycle)))
    return (
        tuple(one for one in reactors if isinstance(one, ReactorConfiguration)),
        tuple(one for one in reactors if isinstance(one, CodeConfiguration)),
    )


def _look_at_names(table: Table, reactor: ReactorConfiguration) -> None:
    """Complain of timelines that a reactor treats in some way and does not own, or does not use."""
    for key, known in (("early", reactor.internal), ("late", reactor.internal), ("observe", reactor.external)):
        for index, timeline in enumerate(getattr(reactor, key)):
            if timeline not in known:
                span = table.text.value_span((*table.path, key, index))
                choices = ", ".join(known) or "nothing"
                table.text.diagnostics.append(UNKNOWN_CHOICE.at(span, key=key, found=timeline, choices=choices))


def _are_owners_told(tables: list[Table]) -> bool:
    """Whether every reactor's `internal` can be read, so that a timeline which stands in none has no owner."""
    return all(isinstance(table.values.get("internal", []), list) for table in tables)


def _find_cycle(reactors: list[ReactorConfiguration | CodeConfiguration], owners: dict[str, str]) -> list[str]:
    """The names of reactors on a cycle of use, the first repeated at the end; empty where there is none."""
    uses = {one.name: [owners[name] for name in one.external if name in owners] for one in reactors}
    waiting = {name: set(used) for name, used in uses.items()}
    while free := [name for name, used in waiting.items() if not used]:
        waiting = {name: used for name, used in waiting.items() if name not in free}
        for used in waiting.values():
            used.difference_update(free)
    trail = [next(iter(waiting))] if waiting else []
    while trail:
        following = next(name for name in uses[trail[-1]] if name in waiting)
        if following in trail:
            return [*trail[trail.index(following) :], following]
        trail.append(following)
    return []


def _complain_of_twin(table: Table, span: Span, what: str, name: str, first: Span) -> None:
    note = Note("first here", first)
    table.text.diagnostics.append(TWICE.at(span, what=what, name=name, notes=(note,)))


def suggest_owned(name: str, known: list[str]) -> str | None:
    """Help where nobody owns the timeline `name`: the closest one that is owned, else all of them."""
    close = nearest(name, known)
    if close:
        return f"did you mean `{close}`?"
    return "owned timelines: " + ", ".join(known) if known else None
