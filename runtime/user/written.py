"""Run a modeler's constraint in the engine; what goes wrong in it becomes one exception that names its line."""

import sys
from collections.abc import Sequence

from runtime.constraints.engine import Engine
from runtime.constraints.external import External
from runtime.constraints.store import Store
from runtime.user.constraint import Constraint, Term
from runtime.user.fault import failed
from runtime.user.view import View, Words


class Written(External):
    """One constraint of a modeler, for all places of a plan that call it."""

    is_repeatable = True

    def __init__(self, constraint: Constraint, words: Words) -> None:
        self.constraint = constraint
        self.words = words

    @property
    def name(self) -> str:
        """Its name in the model."""
        return self.constraint.name

    def propagate(self, s: Store, c: int) -> bool:
        """Run the constraint; False on a conflict."""
        assert isinstance(s, Engine)
        view = View(s, c, self.words)
        step = "propagate"
        try:
            if not answered(self.constraint.propagate(view)) or view.has_failed:
                return view.fail()
            if not has_test(self.constraint) or not all(view.is_single(i) for i in range(view.count)):
                return True
            step = "holds"
            return answered(self.constraint.holds([view.value(i) for i in range(view.count)])) or view.fail()
        except (Exception, SystemExit) as problem:
            raise failed(
                f"`{step}` of the constraint `{self.name}` failed", problem, files_of(self.constraint)
            ) from problem

    def terms(self, arguments: Sequence[str | float | int]) -> tuple[Term, ...] | None:
        """The same in built-in constraints, if the modeler says how."""
        try:
            found = self.constraint.terms(arguments)
            return None if found is None else tuple((str(name), tuple(given)) for name, given in found)
        except (Exception, SystemExit) as problem:
            raise failed(
                f"`terms` of the constraint `{self.name}` failed", problem, files_of(self.constraint)
            ) from problem


def has_test(constraint: Constraint) -> bool:
    """Whether a constraint has a `holds` of its own."""
    return type(constraint).holds is not Constraint.holds


def answered(answer: object) -> bool:
    """What a method said; a forgotten `return` must not pass for an answer."""
    if answer is None:
        raise TypeError("it returned None instead of True or False")
    return bool(answer)


def files_of(constraint: Constraint) -> tuple[str, ...]:
    """The file in which a constraint is written."""
    places = [type(constraint).__module__, getattr(getattr(constraint, "compute", None), "__module__", None)]
    modules = [sys.modules.get(name) for name in places if name is not None and not name.startswith("runtime.user")]
    return tuple(str(module.__file__) for module in modules if module is not None and getattr(module, "__file__", None))
