"""Run a modeler's constraint in the engine; what goes wrong in it becomes one exception that names its line."""

import sys
from collections.abc import Sequence

from runtime.constraints.domains.store import Store
from runtime.constraints.engine import Engine
from runtime.constraints.propagators.external import External
from runtime.user.constraint import Constraint, Term
from runtime.user.fault import failed
from runtime.user.limit import WATCH, watched
from runtime.user.view import View, Words


class Written(External):
    """One constraint of a modeler, for all places of a plan that call it."""

    is_repeatable = True

    def __init__(self, constraint: Constraint, words: Words) -> None:
        self.constraint = constraint
        self.words = words
        WATCH.start()

    @property
    def name(self) -> str:
        """Its name in the model."""
        return self.constraint.name

    def told(self, s: Store | None, c: int) -> str:
        """What it is and where it is called, for complaints."""
        place = None if s is None else self.words.source_place(int(s.span[c]))
        return f"the constraint `{self.name}`{'' if place is None else f', called at {place},'}"

    @property
    def files(self) -> tuple[str, ...]:
        """The file in which it is written."""
        return files_of(self.constraint)

    def propagate(self, s: Store, c: int) -> bool:
        """Run the constraint; False on a conflict."""
        assert isinstance(s, Engine)
        view = View(s, c, self.words)
        call = (self, s, c)
        before = WATCH.call
        step = "propagate"
        try:
            WATCH.call = call
            if not answered(self.constraint.propagate(view)) or view.has_failed:
                return view.fail()
            if not has_test(self.constraint) or not all(view.is_single(i) for i in range(view.count)):
                return True
            step = "holds"
            return answered(self.constraint.holds([view.value(i) for i in range(view.count)])) or view.fail()
        except KeyboardInterrupt:
            raise
        except BaseException as problem:
            raise failed(
                f"`{step}` of {self.told(s, c)}", problem, self.files, line_of(self.constraint, step)
            ) from problem
        finally:
            if WATCH.call is not call:
                WATCH.astray(call)
            WATCH.call = before

    def terms(self, arguments: Sequence[str | float | int]) -> tuple[Term, ...] | None:
        """The same in built-in constraints, if the modeler says how."""
        what = f"`terms` of the constraint `{self.name}`"
        try:
            with watched(what, self.files):
                found = self.constraint.terms(arguments)
                return None if found is None else tuple((str(name), tuple(given)) for name, given in found)
        except KeyboardInterrupt:
            raise
        except BaseException as problem:
            raise failed(what, problem, self.files, line_of(self.constraint, "terms")) from problem


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


def line_of(constraint: Constraint, method: str) -> int:
    """The line in which a method begins."""
    code = getattr(getattr(type(constraint), method), "__code__", None)
    return 1 if code is None else int(code.co_firstlineno)
