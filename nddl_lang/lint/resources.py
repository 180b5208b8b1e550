"""Find resources that begin out of their own bounds, and tokens that take or bring more than one can ever hold."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.lint.codes import BEGINS_OUTSIDE, OVER_CAPACITY
from nddl_lang.lint.part import Part
from nddl_lang.lint.whole import Whole, hull_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import INFINITY, Domain, GlobalReference, Interval, Label, Target, Variable
from nddl_lang.syntax.nodes import Instance, NewExpr, PathExpr, SuperCall
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span

_RESOURCES = frozenset({"Reusable", "CBReusable", "Reservoir", "Unary"})
_Limits = list[float | int | None]


@dataclass(frozen=True, slots=True)
class _Bounds:
    """The level of a resource as it is made: at first, and between which limits it has to stay."""

    first: float
    least: float
    most: float

    @property
    def capacity(self) -> float:
        """The most that one token can take or bring."""
        return self.most - self.least

    @property
    def are_kept_at_first(self) -> bool:
        """Whether the level lies within its limits before anything is taken or brought."""
        return self.least <= self.first <= self.most


def lint_resources(whole: Whole) -> Iterator[Diagnostic]:
    """Levels that are out of bounds from the start, and what one token moves beyond all bounds."""
    bounds = _bounds_of_resources(whole)
    for made, each in bounds.items():
        if not each.are_kept_at_first:
            yield _outside(made, each)
    bounds = {resource: each for resource, each in bounds.items() if each.least <= each.most}
    if not bounds:
        return
    for part in whole.parts:
        for instance in part.all(Instance):
            target = part.tables.targets.get(instance)
            if target is None or target.label is None:
                continue
            resource = _resource(whole, bounds, target)
            if resource is not None and bounds[resource].are_kept_at_first:
                yield from _over_capacity(whole, part, target.label, resource, bounds[resource].capacity)


def _outside(resource: Variable, bounds: _Bounds) -> Diagnostic:
    is_below = bounds.first < bounds.least
    limit = bounds.least if is_below else bounds.most
    what = "below its least" if is_below else "above its most"
    help_ = None
    if isinstance(resource.initialiser, NewExpr):
        order = {"Reservoir": "the level at first, the least, the most", "Reusable": "the capacity, the least"}
        if (names := order.get(resource.initialiser.class_name.name)) is not None:
            help_ = f"`{resource.initialiser.class_name.name}` takes {names}, in this order"
    place = resource.initialiser.span if resource.initialiser is not None else resource.span
    assert place is not None
    return BEGINS_OUTSIDE.at(
        place, help=help_, resource=resource.name, first=_text(bounds.first), what=what, limit=_text(limit)
    )


def _over_capacity(whole: Whole, part: Part, label: Label, resource: Variable, capacity: float) -> Iterator[Diagnostic]:
    brings = label.predicate.name == "produce"
    for demand, span in _demands(whole, part, label):
        if demand > capacity + domains.TOLERANCE:
            yield OVER_CAPACITY.at(
                span,
                notes=(Note("the resource is made here", resource.span),),
                name=label.name,
                moves="brings" if brings else "takes",
                demand=_text(demand),
                way="to" if brings else "of",
                resource=resource.name,
                has="has room for" if brings else "has",
                capacity=_text(capacity),
            )
            return


def _resource(whole: Whole, bounds: dict[Variable, _Bounds], target: Target) -> Variable | None:
    """The resource that a token is on; of several that it may be on, the largest, if all are known."""
    if isinstance(target.object, GlobalReference):
        return target.object.variable if target.object.variable in bounds else None
    class_name = target.predicate.class_name
    known = [
        variable
        for variable in bounds
        if whole.analysis.schema.is_subclass(variable.type.base, class_name)
        and isinstance(variable.initialiser, NewExpr)
    ]
    if not known or len(known) != len(whole.objects.get(class_name, ())):
        return None
    return max(known, key=lambda variable: bounds[variable].capacity)


def _text(value: float) -> str:
    return domains.text(Interval(value, value))


def _bounds_of_resources(whole: Whole) -> dict[Variable, _Bounds]:
    """What the script writes out of the levels of its resources, where they have limits."""
    found: dict[Variable, _Bounds] = {}
    for variable in whole.analysis.schema.globals.values():
        new = variable.initialiser
        if not isinstance(new, NewExpr) or _RESOURCES.isdisjoint(whole.ancestry(new.class_name.name)):
            continue
        bounds = _bounds(*_native(whole, new.class_name.name, [number(argument) for argument in new.arguments]))
        if bounds is not None and bounds.capacity < INFINITY:
            found[variable] = bounds
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


def _bounds(class_name: str, limits: _Limits) -> _Bounds | None:
    match class_name, limits:
        case ("Reusable" | "CBReusable", [float() | int() as capacity, float() | int() as least, *_]):
            return _Bounds(capacity, least, capacity)
        case "Reservoir", [float() | int() as first, float() | int() as least, float() | int() as most, *_]:
            return _Bounds(first, least, most)
        case "Reservoir", [_, float() | int() as least, float() | int() as most, *_]:
            return _Bounds(least, least, most)  # nobody knows the level at first: it is taken as kept
        case "Unary", []:
            return _Bounds(1.0, 0.0, 1.0)
        case _:
            return None


def _demands(whole: Whole, part: Part, label: Label) -> Iterator[tuple[float, Span]]:
    """What is certainly taken or brought by a token, and where the text says so."""
    given: list[tuple[Domain, Span]] = list(whole.given.get((label, "quantity"), ()))
    given += whole.inner_given(part).get((label, "quantity"), [])
    for domain, span in given:
        hull = hull_of(domain)
        if hull is not None and hull.lower < INFINITY:
            yield hull.lower, span
