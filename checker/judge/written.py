"""What constraints of the project mean to the judge: functions are computed again, others asked whether they hold."""

from collections.abc import Sequence

from checker.judge.meanings import Meaning, equal
from checker.judge.values import is_open
from runtime.executive.record import Value
from runtime.user.constraint import Constraint, Function


def meanings_of(constraints: Sequence[Constraint]) -> dict[str, Meaning]:
    """The meaning of each constraint that can be asked; `propagate` alone tells a judge nothing."""
    found: dict[str, Meaning] = {}
    for constraint in constraints:
        if isinstance(constraint, Function):
            found[constraint.name] = _function(constraint)
        elif type(constraint).holds is not Constraint.holds:
            found[constraint.name] = _relation(constraint)
    return found


def _function(constraint: Function) -> Meaning:
    def check(result: Value, *inputs: Value) -> bool | None:
        if any(is_open(each) for each in (result, *inputs)):
            return None
        value = constraint.compute(*inputs)
        return False if value is None else equal(result, value)

    return check


def _relation(constraint: Constraint) -> Meaning:
    def check(*values: Value) -> bool | None:
        return None if any(is_open(each) for each in values) else bool(constraint.holds(values))  # type: ignore[arg-type]

    return check
