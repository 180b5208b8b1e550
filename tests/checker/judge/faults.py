"""Engines and executives that are broken on purpose: functions of the uncompiled engine, replaced for one mission."""

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random
from types import FunctionType
from typing import Any

from runtime.constraints import engine as engine_module
from runtime.constraints.propagators import posting
from runtime.executive import chance, plan_reactor, view, workbench
from runtime.executive.stock import SHELVES
from runtime.plan import lifecycle
from runtime.plan.resources import resources
from runtime.plan.rules import guards
from runtime.plan.store import scopes
from runtime.plan.tags import BRANCH_ELSE, BRANCH_THEN, BRANCH_WAITING
from runtime.plan.tokens import archive, relations

Wrap = Callable[[Callable[..., Any]], Callable[..., Any]]


@dataclass(frozen=True, slots=True)
class Fault:
    """A function of a module, or of a class, and what takes its place."""

    kind: str
    name: str
    owner: Any
    function: str
    wrap: Wrap


class EndlessError(BaseException):
    """A broken engine that does not come to an end; no `except Exception` of it may stop this."""


def _give_up(*_: object) -> None:
    raise EndlessError


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raise `EndlessError` after so many seconds of computing."""
    before = signal.signal(signal.SIGVTALRM, _give_up)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


@contextmanager
def broken(fault: Fault, seconds: float = 3.0) -> Iterator[None]:
    """Put a fault in place, wherever the function was imported to, for some seconds of computing."""
    old = getattr(fault.owner, fault.function)
    new = fault.wrap(old)
    places = [(fault.owner, fault.function)]
    if isinstance(old, FunctionType) and not isinstance(fault.owner, type):
        for module in list(sys.modules.values()):
            if getattr(module, "__name__", "").startswith(("runtime", "checker")):
                places += [(module, name) for name, value in list(vars(module).items()) if value is old]
    for owner, name in places:
        setattr(owner, name, new)
    SHELVES.clear()  # a fault in what loads shows only where it is loaded
    try:
        with at_most(seconds):
            yield
    finally:
        for owner, name in places:
            setattr(owner, name, old)
        SHELVES.clear()  # nor may what the fault has loaded reach the next mission


def faults(dice: Random, spans: int) -> list[Fault]:
    """One fault of every kind, each at a place of the model, or at a moment, that the dice choose.

    `spans` is how many pieces of text the largest model has: a fault at one of them breaks one line of a model.
    """
    at = dice.randrange(spans)
    nth = dice.randrange(1, 12)
    by = dice.choice((-2, -1, 1, 2))
    found: list[Fault] = []

    def add(kind: str, name: str, owner: Any, function: str, wrap: Wrap) -> None:
        found.append(Fault(kind, f"{name} at {at}, {nth}, {by}", owner, function, wrap))

    def skip_line(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda self, c: True if self.span[c] == at else old(self, c)

    add("skipped propagation", "no constraint of a line", engine_module.Engine, "run", skip_line)

    def skip_some(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def run(self: Any, c: int) -> bool:
            calls[0] += 1
            return True if calls[0] % (7 * nth) == 0 else bool(old(self, c))

        return run

    add("skipped propagation", "now and then none", engine_module.Engine, "run", skip_some)

    def no_watch(old: Callable[..., Any]) -> Callable[..., Any]:
        def watch(s: Any, c: int, position: int, v: int, mask: int) -> None:
            old(s, c, position, v, 0 if s.span[c] == at and position == nth % 3 else mask)

        return watch

    add("lost wake-up", "deaf argument of a line", posting, "_watch", no_watch)

    def deaf(old: Callable[..., Any]) -> Callable[..., Any]:
        def watch(s: Any, c: int, position: int, v: int, mask: int) -> None:
            old(s, c, position, v, 0 if position == nth % 3 else mask)

        return watch

    add("lost wake-up", "deaf arguments", posting, "_watch", deaf)

    def loose(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda plan, scope, a, b, w, span: True if span == at else old(plan, scope, a, b, w, span)

    add("skipped propagation", "no edge of a line", scopes, "_edge", loose)

    def turned(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda plan, scope, a, b, w, span: old(plan, scope, *((b, a) if span == at else (a, b)), w, span)

    add("wrong bound side", "edges of a line turned round", scopes, "_edge", turned)

    def shifted(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda plan, scope, a, b, w, span: old(plan, scope, a, b, w + by if span == at else w, span)

    add("wrong bound side", "edges of a line shifted", scopes, "_edge", shifted)

    def every_edge(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]
        chosen: set[tuple[int, int, int]] = set()

        # An edge that was shifted once is shifted whenever it is posted again: another try must not pass by the fault.
        def edge(plan: Any, scope: int, a: int, b: int, w: int, span: int) -> bool:
            calls[0] += 1
            if calls[0] % (5 * nth) == 0:
                chosen.add((span, a, b))
            return bool(old(plan, scope, a, b, w + by if (span, a, b) in chosen else w, span))

        return edge

    add("wrong bound side", "an edge now and then shifted", scopes, "_edge", every_edge)

    def no_relation(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def relate(*arguments: Any) -> Any:
            calls[0] += 1
            return None if calls[0] % nth == 0 else old(*arguments)

        return relate

    add("skipped propagation", "no relation now and then", relations, "relate", no_relation)

    def other_branch(old: Callable[..., Any]) -> Callable[..., Any]:
        other = {BRANCH_THEN: BRANCH_ELSE, BRANCH_ELSE: BRANCH_THEN, BRANCH_WAITING: BRANCH_WAITING}
        return lambda plan, s: other[old(plan, s)]

    add("wrong order", "the other branch", guards, "choice", other_branch)
    add("lost wake-up", "no branch", guards, "choice", lambda old: lambda plan, s: BRANCH_WAITING)

    def dropped(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def notify(self: Any, observation: Any) -> None:
            calls[0] += 1
            if calls[0] != nth:
                old(self, observation)

        return notify

    add("dropped observation", "one never told", plan_reactor.PlanReactor, "notify", dropped)

    def unread(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def restrict(self: Any, t: int, arguments: Any, span: int) -> bool:
            calls[0] += 1
            return True if calls[0] % nth == 0 else bool(old(self, t, arguments, span))

        return restrict

    add("dropped observation", "arguments not read", workbench.Workbench, "restrict_parameters", unread)

    def hasty(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda self, t, tick: old(self, t, tick + nth)

    add("archived too early", "over before its end", view.PlanView, "is_over", hasty)
    add("archived too early", "nothing frozen", archive, "_keep_domain", lambda old: lambda plan, v, supports: None)
    add(
        "archived too early",
        "with what is needed",
        archive,
        "_removable",
        lambda old: lambda plan, tokens, tick: dict.fromkeys(tokens),
    )

    add("wrong order", "no order at all", workbench.Workbench, "place_after", lambda old: lambda *rest: True)

    def apart(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def equate(*arguments: Any) -> Any:
            calls[0] += 1
            return None if calls[0] % nth == 0 else old(*arguments)

        return equate

    add("skipped propagation", "twins apart", lifecycle, "equate", apart)

    def untied(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def between(*arguments: Any) -> Any:
            calls[0] += 1
            return True if calls[0] % nth == 0 else old(*arguments)

        return between

    add("skipped propagation", "times apart", lifecycle, "between", untied)

    def redrawn(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda parameter, seed, tick: old(parameter, seed + 1, tick)

    add("wrong draw", "of another seed", chance, "sample", redrawn)
    add("skipped propagation", "levels unwatched", resources.Resources, "check", lambda old: lambda *rest: True)

    def unassigned(old: Callable[..., Any]) -> Callable[..., Any]:
        return lambda plan, scope, v, source, span: True if span == at else old(plan, scope, v, source, span)

    add("skipped propagation", "no restriction of a line", scopes, "restrict", unassigned)

    def late(old: Callable[..., Any]) -> Callable[..., Any]:
        calls = [0]

        def fix(self: Any, v: int, value: float, span: int, t: int) -> bool:
            calls[0] += 1
            return bool(old(self, v, value + (abs(by) if calls[0] % (3 * nth) == 0 else 0), span, t))

        return fix

    add("wrong bound side", "fixed too late", workbench.Workbench, "fix", late)
    return found
