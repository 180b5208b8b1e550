"""Run a modeler's constraint in the engine; what goes wrong in it becomes one exception that names its line."""

import math
import sys
from collections.abc import Sequence

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import KIND_BOOL, KIND_INT
from runtime.constraints.engine import Engine
from runtime.constraints.propagators.external import External
from runtime.user.constraint import Constraint, Term
from runtime.user.fault import failed
from runtime.user.limit import WATCH, watched
from runtime.user.view import MOST_LISTED, View, Words

_REHEARSED = 1009  # calls from one rehearsal to the next, beside the calls 1, 2, 4, 8, ...


class Written(External):
    """One constraint of a modeler, for all places of a plan that call it."""

    is_repeatable = True

    def __init__(self, constraint: Constraint, words: Words) -> None:
        self.constraint = constraint
        self.words = words
        self._calls = 0
        self._told: str | None = None  # what a rehearsal is told as
        WATCH.start()

    @property
    def name(self) -> str:
        """Its name in the model."""
        return self.constraint.name

    def told(self, s: Store | None, c: int) -> str:
        """What it is and where it is called, for complaints."""
        if self._told is not None:
            return self._told
        place = None if s is None else self.words.source_place(int(s.span[c]))
        return f"{self.title}{'' if place is None else f', called at {place},'}"

    @property
    def title(self) -> str:
        """What it is."""
        return f"the constraint `{self.name}`"

    @property
    def line(self) -> int:
        """Where it begins to reckon."""
        own = type(self.constraint).propagate is not Constraint.propagate
        return _line_of(self.constraint, "propagate" if own else "holds")

    @property
    def source(self) -> tuple[str, int]:
        """The file in which it is written, and the line that judges values; an empty name where there is no file."""
        compute = getattr(self.constraint, "compute", None)
        step = "holds" if has_test(self.constraint) else "propagate"
        code = getattr(compute, "__code__", None)
        line = _line_of(self.constraint, step) if code is None else int(code.co_firstlineno)
        return next(iter(reversed(self.files)), ""), line

    @property
    def files(self) -> tuple[str, ...]:
        """The file in which it is written."""
        return _files_of(self.constraint)

    def propagate(self, s: Store, c: int) -> bool:
        """Run the constraint; False on a conflict."""
        assert isinstance(s, Engine)
        self._calls += 1
        if self._calls & self._calls - 1 == 0 or self._calls % _REHEARSED == 0:
            self._rehearse(s, c)
        view = View(s, c, self.words)
        call = (self, s, c)
        step = "propagate"
        before = WATCH.begin(call)
        try:
            if not _answered(self.constraint.propagate(view)) or view.has_failed:
                return view.fail()
            if not has_test(self.constraint) or not all(view.is_single(i) for i in range(view.count)):
                return True
            step = "holds"
            return _answered(self.constraint.holds([view.value(i) for i in range(view.count)])) or view.fail()
        except BaseException as problem:
            if isinstance(problem, KeyboardInterrupt) and WATCH.was_pressed:
                raise
            raise failed(
                f"`{step}` of {self.told(s, c)}", problem, self.files, _line_of(self.constraint, step)
            ) from problem
        finally:
            WATCH.end(call, before)
            view.close()

    def _rehearse(self, s: Engine, c: int) -> None:
        """Run it twice over copies of its arguments: what answers by chance or by memory would answer differently."""
        told = self.told(s, c)
        answers = [_answer(s, c, Written(self.constraint, self.words), told) for _ in range(2)]
        if answers[0] != answers[1]:
            what = f"`propagate` of {told}"
            problem = ValueError(
                "it answers differently when it is asked again: its answer must follow from the view alone"
            )
            raise failed(what, problem, self.files, _line_of(self.constraint, "propagate"))

    def terms(self, arguments: Sequence[str | float | int]) -> tuple[Term, ...] | None:
        """The same in built-in constraints, if the modeler says how."""
        what = f"`terms` of the constraint `{self.name}`"
        try:
            with watched(what, self.files):
                found = self.constraint.terms(arguments)
                return None if found is None else tuple((str(name), tuple(given)) for name, given in found)
        except BaseException as problem:
            if isinstance(problem, KeyboardInterrupt) and WATCH.was_pressed:
                raise
            raise failed(what, problem, self.files, _line_of(self.constraint, "terms")) from problem


def _answer(s: Engine, c: int, written: Written, told: str) -> tuple[object, ...]:
    """What one run over copies of the arguments of constraint `c` leaves: whether it holds, and each domain."""
    written._told = told
    written._calls = 2  # neither a power of two nor a multiple with the next call: no rehearsal of a rehearsal
    engine = Engine()
    own: dict[int, int] = {}
    for v in s.arguments(c):
        if v not in own:
            own[v] = _copied(s, v, engine)
    variables = [own[v] for v in s.arguments(c)]
    holds = written.propagate(engine, engine.post_external(written, variables, -1, -1))
    left = [(engine.lower(v), engine.upper(v), _listed(engine, v)) for v in own.values()]
    return (holds, *left) if holds else (holds,)


def _copied(s: Engine, v: int, engine: Engine) -> int:
    """A variable of a fresh engine with the domain of `v`."""
    values = _listed(s, v)
    if values is not None and s.kind[v] != KIND_BOOL:
        return int(engine.new_values(s.kind[v], values, -1, -1))
    return int(engine.new_interval(s.kind[v], s.lower(v), s.upper(v), -1, -1))


def _listed(engine: Engine, v: int) -> list[float] | None:
    """All values of a domain; None where its bounds say them all, or they are too many for a list, or without end."""
    if not engine.is_finite(v) or engine.size(v) > MOST_LISTED:
        return None
    if engine.kind[v] == KIND_INT and engine.size(v) == engine.upper(v) - engine.lower(v) + 1:
        return None
    return engine.values_of(v)


def has_test(constraint: Constraint) -> bool:
    """Whether a constraint has a `holds` of its own."""
    return type(constraint).holds is not Constraint.holds


def _answered(answer: object) -> bool:
    """What a method said; a forgotten `return` must not pass for an answer."""
    if answer is None:
        raise TypeError("it returned None instead of True or False")
    if isinstance(answer, float) and math.isnan(answer):
        raise TypeError("it returned nan instead of True or False")
    return bool(answer)


def _files_of(constraint: Constraint) -> tuple[str, ...]:
    """The file in which a constraint is written."""
    places = [type(constraint).__module__, getattr(getattr(constraint, "compute", None), "__module__", None)]
    modules = [sys.modules.get(name) for name in places if name is not None and not name.startswith("runtime.user")]
    return tuple(str(module.__file__) for module in modules if module is not None and getattr(module, "__file__", None))


def _line_of(constraint: Constraint, method: str) -> int:
    """The line in which a method begins, or the function that it calls."""
    code = getattr(getattr(constraint, "compute", getattr(type(constraint), method)), "__code__", None)
    return 1 if code is None else int(code.co_firstlineno)
