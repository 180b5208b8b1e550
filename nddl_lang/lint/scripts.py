"""Find statements of the script that cannot come true: tokens outside the horizon, merges, demands over capacity."""

from collections.abc import Iterator

from nddl_lang.lint.codes import IDLE_FACT, NEVER_PLANNED, NO_MERGE, OUTSIDE_HORIZON, OVER_CAPACITY, UNCLOSED
from nddl_lang.lint.part import Part
from nddl_lang.lint.whole import Whole, hull_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import (
    INFINITY,
    Domain,
    GlobalReference,
    Interval,
    Kind,
    Label,
    Target,
    TokenReference,
    Variable,
)
from nddl_lang.syntax.nodes import (
    Assignment,
    ClassDecl,
    GoalStatement,
    Instance,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    SuperCall,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span

_RESOURCES = frozenset({"Reusable", "CBReusable", "Reservoir", "Unary"})
_DEFAULT_HORIZON = Interval(0, 100)


def lint_script(whole: Whole) -> Iterator[Diagnostic]:
    """What the goals of a whole model say about times, objects and resources."""
    goals = [(part, part.node) for part in whole.statements(GoalStatement) if isinstance(part.node, GoalStatement)]
    yield from _horizon(whole, goals)
    yield from _merges(whole)
    yield from _facts(whole, goals)
    if goals and whole.is_whole and whole.is_own(goals[0][0].node.span):
        yield from _unclosed(whole, goals[0][0])


# ---- the horizon ----


def _horizon_of(whole: Whole) -> tuple[Interval, NewExpr] | None:
    """The planning horizon that the model itself sets, None where it sets none or several."""
    made = whole.objects.get("PlannerConfig", [])
    if len(made) != 1:
        return None
    arguments = made[0].arguments
    if not arguments:
        return _DEFAULT_HORIZON, made[0]
    bounds = [number(argument) for argument in arguments[:2]]
    if len(bounds) < 2 or bounds[0] is None or bounds[1] is None:
        return None
    return Interval(bounds[0], bounds[1]), made[0]


def _horizon(whole: Whole, goals: list[tuple[Part, GoalStatement]]) -> Iterator[Diagnostic]:
    found = _horizon_of(whole)
    if found is None:
        return
    horizon, config = found
    notes = (Note("the horizon is set here", config.span),)
    for part, node in goals:
        for instance in node.instances:
            label = part.label_of(instance)
            predicate = part.predicate_of(instance)
            if predicate is None or predicate.is_event or _is_active_from_start(whole, predicate.class_name):
                continue
            name = label.name if label is not None else instance.path.span.text
            if label is None or label not in whole.usage.labels:
                help_ = f"a token is planned once it must start before {horizon.upper}: bound its `start`"
                yield NEVER_PLANNED.at(instance.span, notes=notes, help=help_, name=name)
                continue
            start = hull_of(whole.assigned.get((label, "start")))
            end = hull_of(whole.assigned.get((label, "end")))
            if (start is not None and start.lower >= horizon.upper) or (end is not None and end.upper <= horizon.lower):
                yield OUTSIDE_HORIZON.at(instance.span, notes=notes, name=name, horizon=domains.set_text(horizon))


def _is_active_from_start(whole: Whole, class_name: str) -> bool:
    return any(
        whole.analysis.schema.classes[name].is_native and name not in ("Object", "Timeline")
        for name in whole.ancestry(class_name)
    )


# ---- merges ----


def _merges(whole: Whole) -> Iterator[Diagnostic]:
    for part in whole.statements(MethodCall):
        node = part.node
        if not isinstance(node, MethodCall) or node.method.name != "merge" or len(node.arguments) != 1:
            continue
        tokens = [part.reference(node.target), part.reference(node.arguments[0])]
        labels = [token.label for token in tokens if isinstance(token, TokenReference)]
        if len(labels) == 2:
            yield from _difference(whole, node, labels[0], labels[1])


def _difference(whole: Whole, node: MethodCall, one: Label, other: Label) -> Iterator[Diagnostic]:
    variables = ["start", "end", "duration", *(parameter.name for parameter in one.predicate.parameters)]
    for variable in variables:
        left, right = (whole.assigned.get((label, variable)) for label in (one, other))
        parameter = next((each for each in one.predicate.parameters if each.name == variable), None)
        kind = parameter.type.kind if parameter is not None else Kind.INT
        if left is not None and right is not None and domains.intersect(left, right, kind) is None:
            notes = tuple(
                Note(f"`{label.name}.{variable}` is given here", whole.given[label, variable][0][1])
                for label in (one, other)
            )
            yield NO_MERGE.at(node.span, notes=notes, name=one.name, other=other.name, variable=variable)
            return


# ---- facts, closing ----


def _facts(whole: Whole, goals: list[tuple[Part, GoalStatement]]) -> Iterator[Diagnostic]:
    if not whole.is_whole:
        return
    planned: set[Label] = set()
    for part in (*whole.statements(MethodCall), *whole.statements(Assignment)):
        node = part.node
        if isinstance(node, MethodCall) and node.method.name in ("activate", "merge", "constrain"):
            for path in (node.target, *node.arguments):
                reference = part.reference(path)
                if isinstance(reference, TokenReference):
                    planned.add(reference.label)
        elif isinstance(node, Assignment) and node.target.parts[-1].name == "state":
            label = getattr(part.reference(node.target), "label", None)
            if isinstance(label, Label):
                planned.add(label)
    for part, node in goals:
        if node.kind != "fact" or not whole.is_own(node.span):
            continue
        for instance in node.instances:
            label = part.label_of(instance)
            if label is None or label not in planned:
                how = f"`{label.name}.activate();`" if label is not None else "a name, and `activate()`"
                yield IDLE_FACT.at(instance.span, help=f"to put it into the plan, add {how}")


def _unclosed(whole: Whole, first: Part) -> Iterator[Diagnostic]:
    choices: list[Variable] = []
    for part in whole.statements(MethodCall):
        if isinstance(part.node, MethodCall) and part.node.method.name == "close":
            return
    for part in whole.parts:
        for declaration in part.all(VariableDecl):
            for declarator in declaration.declarators:
                variable = part.tables.declared.get(declarator.name)
                if isinstance(variable, Variable) and variable.type.kind is Kind.OBJECT and variable.span is not None:
                    is_given = declarator.initialiser is not None or isinstance(part.node, ClassDecl)
                    if not is_given or _is_parameter(part, declaration):
                        choices.append(variable)
    if choices:
        notes = (Note(f"`{choices[0].name}` waits for that", choices[0].span),)
        yield UNCLOSED.at(first.node.span, notes=notes, help="write `close();` after the last object is made")


def _is_parameter(part: Part, declaration: VariableDecl) -> bool:
    return any(declaration in predicate.body for predicate in part.all(PredicateDecl))


# ---- resources ----


_Limits = list[float | int | None]


def lint_capacity(whole: Whole) -> Iterator[Diagnostic]:
    """Uses of a resource that are larger than it can ever hold."""
    capacities = _capacities(whole)
    if not capacities:
        return
    for part in whole.parts:
        for instance in part.all(Instance):
            target = part.tables.targets.get(instance)
            if target is None or target.label is None:
                continue
            resource = _resource(whole, capacities, target)
            if resource is None:
                continue
            capacity = capacities[resource]
            for demand, span in _demands(whole, part, target.label):
                if demand > capacity + domains.TOLERANCE:
                    notes = (Note("the resource is made here", resource.span),)
                    yield OVER_CAPACITY.at(
                        span,
                        notes=notes,
                        name=target.label.name,
                        demand=_text(demand),
                        resource=resource.name,
                        capacity=_text(capacity),
                    )
                    break


def _resource(whole: Whole, capacities: dict[Variable, float], target: Target) -> Variable | None:
    """The resource that a token is on; of several that it may be on, the largest, if all are known."""
    if isinstance(target.object, GlobalReference):
        return target.object.variable if target.object.variable in capacities else None
    class_name = target.predicate.class_name
    known = [
        variable
        for variable in capacities
        if whole.analysis.schema.is_subclass(variable.type.base, class_name)
        and isinstance(variable.initialiser, NewExpr)
    ]
    if not known or len(known) != len(whole.objects.get(class_name, ())):
        return None
    return max(known, key=lambda variable: capacities[variable])


def _text(value: float) -> str:
    return domains.text(Interval(value, value))


def _capacities(whole: Whole) -> dict[Variable, float]:
    """The most that the resources of the script can hold above their least level."""
    found: dict[Variable, float] = {}
    for variable in whole.analysis.schema.globals.values():
        new = variable.initialiser
        if not isinstance(new, NewExpr) or _RESOURCES.isdisjoint(whole.ancestry(new.class_name.name)):
            continue
        capacity = _capacity(*_native(whole, new.class_name.name, [number(argument) for argument in new.arguments]))
        if capacity is not None and capacity < INFINITY:
            found[variable] = capacity
    return found


def _native(whole: Whole, class_name: str, values: _Limits) -> tuple[str, _Limits]:
    """The native class that an object is built on, and what the constructors on the way hand to it."""
    owner = whole.analysis.schema.classes.get(class_name)
    while owner is not None and not owner.is_native and owner.base is not None:
        fitting = [each for each in owner.constructors if len(each.parameters) == len(values)]
        given: _Limits = []
        if len(fitting) == 1 and fitting[0].node is not None:
            names = {parameter.name: value for parameter, value in zip(fitting[0].parameters, values, strict=True)}
            for statement in fitting[0].node.body:
                if isinstance(statement, SuperCall):
                    given = [
                        names.get(each.span.text) if isinstance(each, PathExpr) else number(each)
                        for each in statement.arguments
                    ]
        values = given
        owner = whole.analysis.schema.classes.get(owner.base)
    return (owner.name if owner is not None else class_name), values


def _capacity(class_name: str, limits: _Limits) -> float | None:
    match class_name, limits:
        case ("Reusable" | "CBReusable", [float() | int() as capacity, float() | int() as least, *_]):
            return capacity - least
        case "Reservoir", [_, float() | int() as least, float() | int() as most, *_]:
            return most - least
        case "Unary", []:
            return 1.0
        case _:
            return None


def _demands(whole: Whole, part: Part, label: Label) -> Iterator[tuple[float, Span]]:
    """What is certainly taken by a token, and where the text says so."""
    given: list[tuple[Domain, Span]] = list(whole.given.get((label, "quantity"), ()))
    given += whole.inner_given(part).get((label, "quantity"), [])
    for domain, span in given:
        hull = hull_of(domain)
        if hull is not None and hull.lower < INFINITY:
            yield hull.lower, span
