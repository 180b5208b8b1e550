"""What causes say, as data without ids of the engine: terms over named variables, and violated resources."""

from dataclasses import dataclass

from runtime.plan.readout.names import VariableName

Argument = VariableName | str | float | int


@dataclass(frozen=True, slots=True)
class Term:
    """One constraint of a conflict, without ids of the engine.

    `name` is a row of the constraint table (`eq`, `mulEq`, `leq`, ...), `precedence` (arguments source, target,
    bound: target - source <= bound), or `bounds` (arguments variable, lower, upper: a base domain; `values` lists its
    members where they are names). Arguments are variables, numbers, or names of values. A `sampledParameter` term has
    the variable, the parameter name and the value drawn. A `memberOf` term has `a.b` of an object `a` that was open
    when it was needed, `a`, and what `b` is in each of the objects that `values` names.

    What a resource demands: `levelAtLeast`, `levelAtMost` (resource, first level, limit), `rateAtMost`, `totalAtMost`
    (resource, limits of consumption and production), `capacityFrom`, `levelFrom` (resource, from when, lower, upper);
    its uses: `consume`, `produce` (object, quantity, time) and `use` (object, quantity, start, end).
    """

    name: str
    arguments: tuple[Argument, ...]
    values: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ResourceTerm:
    """A resource, or timeline, certainly exceeded; fields as in `Violation`, `users` are tokens with amounts.

    `terms` say what it demands, and of which uses.
    """

    resource: str
    wrong: int
    at: int
    until: int
    amount: float
    limit: float
    room: float
    has_helper: bool
    in_any_order: bool
    users: tuple[tuple[str, float], ...]
    terms: tuple[Term, ...] = ()
