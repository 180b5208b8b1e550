"""Hold the roles of a mission file against those of its models: who owns a timeline, and what it falls back to.

The models say them by the members of `AgentTimeline`, which are read after their scripts have run.
"""

from collections.abc import Iterator, Mapping, Sequence

from checker.codes import NO_DEFAULT, OTHER_ROLE, UNLISTED
from checker.mission import Mission
from checker.named_objects import named_objects
from checker.planner_fit import vain_requests
from compiler.program import ClassCode, Constant, Program, SuperCode
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span
from runtime.executive.workbench import Workbench
from runtime.plan.database import PlanDatabase
from runtime.user.constraint import Constraint

_ROLES = {"internal": ("Internal", "Private"), "external": ("External", "Observe")}
_KEYS = {"Internal": "internal", "External": "external", "Observe": "external"}  # of what is to be listed


def find_role_misfits(
    mission: Mission, programs: Mapping[str, Program], constraints: Sequence[Constraint]
) -> Iterator[Diagnostic]:
    """Complain of timelines that a model and the mission file give different roles, and of defaults that are none."""
    benches: dict[str, Workbench | None] = {}
    told: set[tuple[str, int]] = set()
    for number, reactor in enumerate(mission.agent.reactors):
        if reactor.model not in benches:
            benches[reactor.model] = _loaded(programs[reactor.model], constraints)
        bench = benches[reactor.model]
        if bench is None:
            continue
        names = bench.database.objects.names
        for key, timelines in (("internal", reactor.internal), ("external", reactor.external)):
            for index, timeline in enumerate(timelines):
                mode = bench.mode(names.index(timeline)) if timeline in names else ""
                if mode and mode not in _ROLES[key]:
                    span = mission.text.value_span((*mission.text.reactor_path(number), key, index))
                    listed = "owned (`internal`)" if key == "internal" else "used (`external`)"
                    yield OTHER_ROLE.at(
                        span,
                        timeline=timeline,
                        listed=listed,
                        mode=mode,
                        model=reactor.model,
                        help=_move(timeline, mode),
                        notes=_declared(programs[reactor.model], timeline),
                    )
        modes = {timeline: bench.mode(names.index(timeline)) for timeline in reactor.external if timeline in names}
        yield from vain_requests(mission, number, programs[reactor.model], modes)
        written = (*reactor.internal, *reactor.external)
        meant = {each if each in names else nearest(each, names) for each in written}  # a misspelt one is told already
        named = named_objects(programs[reactor.model])
        for timeline in names:
            mode = bench.mode(names.index(timeline))
            if mode in _KEYS and timeline not in meant and timeline in named:
                key_path = (*mission.text.reactor_path(number), _KEYS[mode])
                is_there = key_path in mission.text.places
                span = mission.text.value_span(key_path) if is_there else mission.text.key_span(key_path[:2])
                yield UNLISTED.at(
                    span,
                    fixes=_listing(span, timeline) if is_there else (),
                    timeline=timeline,
                    mode=mode,
                    model=reactor.model,
                    help=_move(timeline, mode),
                    notes=_declared(programs[reactor.model], timeline),
                )
            strange = _strange_default(programs[reactor.model], bench, timeline) if mode else None
            if strange is not None and (place := (strange.span.source.name, strange.span.begin)) not in told:
                told.add(place)
                yield strange


def _loaded(program: Program, constraints: Sequence[Constraint]) -> Workbench | None:
    """The model with its script run; None where a fault stops it, which the executive tells of."""
    database = PlanDatabase(program, lambda name, token: None, tuple(constraints))
    return None if database.run_script() is not None else Workbench(database, "")


def _listing(span: Span, timeline: str) -> tuple[Fix, ...]:
    """The fix that adds a timeline to the list at `span`."""
    inside = span.text.rstrip()[1:-1].rstrip()
    if span.text[:1] != "[" or "#" in inside:
        return ()
    end = span.start + 1 + len(inside)
    text = f'"{timeline}"' if not inside.strip() else f' "{timeline}"' if inside[-1] == "," else f', "{timeline}"'
    return (Fix(f'add `"{timeline}"`', (Edit(Span(span.anchor, end, end), text),), safe=False),)


def _move(timeline: str, mode: str) -> str:
    key = _KEYS.get(mode)
    if key is None:
        return f"a timeline that is `{mode}` is not listed; else write Internal or External in the model"
    return f"list `{timeline}` under `{key}`, or change its mode in the model"


def _declared(program: Program, timeline: str) -> tuple[Note, ...]:
    """Where the model makes the object of a timeline."""
    names = [name for name, _ in program.globals]
    for each in program.script:
        index = getattr(each, "global_index", None)
        if index is not None and names[index] == timeline.partition(".")[0]:
            return (Note("made here", each.span),)
    return ()


def _strange_default(program: Program, bench: Workbench, timeline: str) -> Diagnostic | None:
    code = program.classes[bench.database.plan.object_class[bench.database.objects.names.index(timeline)]]
    default = bench.default_name(bench.database.objects.names.index(timeline))
    known = [one.name.rpartition(".")[2] for one in program.predicates if one.class_name == code.name]
    span = _written(program, code, default) or code.span
    if default in known or span is None:
        return None
    close = nearest(default, known)
    advice = f"did you mean `{close}`?" if close else f"predicates: {', '.join(known)}"
    notes = _declared(program, timeline)
    fixes: tuple[Fix, ...] = ()
    if close and span.text.count(f'"{default}"') == 1:
        start = span.start + span.text.index(f'"{default}"') + 1
        fixes = (Fix(f"write `{close}`", (Edit(Span(span.anchor, start, start + len(default)), close),), safe=False),)
    return NO_DEFAULT.at(
        span, timeline=timeline, predicate=default, class_name=code.name, help=advice, notes=notes, fixes=fixes
    )


def _written(program: Program, code: ClassCode, default: str) -> Span | None:
    """The call `super(...)` that hands the default on."""
    classes = {each.name: each for each in program.classes}
    current: ClassCode | None = code
    while current is not None:
        for constructor in current.constructors:
            for step in constructor.body:
                if isinstance(step, SuperCode) and any(
                    isinstance(one, Constant) and one.domain.values == (default,) for one in step.arguments
                ):
                    return step.span
        current = classes.get(current.base) if current.base is not None else None
    return None
