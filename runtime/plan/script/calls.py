"""Method calls of the script: transactions on tokens, variables, objects and classes."""

from collections.abc import Callable

from compiler.program import OBJECT, STATE, Call, Constant, TokenVariable
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Span
from runtime.constraints.domains.base_domain import is_base_growing, is_growing
from runtime.plan import lifecycle
from runtime.plan.script.codes import (
    CLOSED_ALREADY,
    NOT_ONE_OBJECT,
    NOT_ORDERED,
    NOT_REJECTABLE,
    OTHER_PREDICATE,
    OUTSIDE_DOMAIN,
    SEVERAL_VALUES,
    WRONG_OBJECT,
    WRONG_STATE,
)
from runtime.plan.script.objects import Objects
from runtime.plan.store.domain_texts import base_text
from runtime.plan.store.operands import operand
from runtime.plan.tags import (
    ACTIVE,
    FLAG_NATIVE,
    FLAG_REJECTABLE,
    INACTIVE,
    NONE,
    STATE_NAMES,
    STATE_SYMBOLS,
    SYMBOL_ACTIVE,
    SYMBOL_MERGED,
    SYMBOL_REJECTED,
)
from runtime.plan.tokens import retraction, timelines
from runtime.plan.tokens.predicate_hierarchy import is_kind_of

Action = Callable[[], Diagnostic | None]


def _is_activation(call: Call) -> bool:
    """Whether a call is `token.state.specify(ACTIVE)`."""
    if call.method != "specify" or not isinstance(call.variable, TokenVariable) or call.variable.variable != STATE:
        return False
    given = call.arguments[0]
    return isinstance(given, Constant) and given.domain.values == (STATE_SYMBOLS[SYMBOL_ACTIVE],)


class Calls:
    """The methods of the script."""

    def __init__(self, objects: Objects, labels: dict[int, str], scope: int) -> None:
        self.plan = objects.plan
        self.program = objects.program
        self.prototypes = objects.prototypes
        self.code = objects.code
        self.objects = objects
        self.labels = labels
        self.scope = scope

    def prepare(self, call: Call) -> Action:
        """What a call does when its turn comes."""
        span = self.code.span(call.span)
        if call.token is not None:
            return self._of_token(call, call.token, span)
        if _is_activation(call):
            assert isinstance(call.variable, TokenVariable)
            slot = call.variable.token
            return lambda: self.activate(self.token(slot), call.span, span)
        if call.variable is not None:
            kind, value = self.code.operand(call.variable)
            arguments = [self.code.operand(each) for each in call.arguments]
            tokens = [
                each.token for each in call.arguments if isinstance(each, TokenVariable) and each.variable == STATE
            ]
            return lambda: self._of_variable(call, kind, value, arguments, tokens, span)
        return lambda: self.of_class(call)

    def token(self, slot: int) -> int:
        """The token in a slot of the script."""
        rows = self.plan.rows
        return rows.cells[rows.scope_frame[self.scope] + rows.scope_slots[self.scope] + slot]

    def name(self, t: int) -> str:
        """What a token is called in messages."""
        return self.labels.get(t, self.program.predicates[self.plan.rows.predicate[t]].name)

    # ---- tokens ----

    def _of_token(self, call: Call, slot: int, span: int) -> Action:
        """A call on a token."""
        match call.method:
            case "activate":
                return lambda: self.activate(self.token(slot), call.span, span)
            case "merge":
                other = call.arguments[0]
                assert isinstance(other, TokenVariable)
                return lambda: self.merge(self.token(slot), self.token(other.token), call.span, span)
            case "reject":
                return lambda: self.reject(self.token(slot), call.span, span)
            case _:
                assert call.method == "cancel", f"no method {call.method} of tokens"
                return lambda: self.cancel(self.token(slot), call.span)

    def _wrong_state(self, t: int, wanted: int, symbol: int, action: str, span: Span) -> Diagnostic | None:
        """What is wrong if a token is in another state than an action needs."""
        status = self.plan.rows.status[t]
        if status != wanted:
            return WRONG_STATE.at(span, name=self.name(t), state=STATE_NAMES[status].lower(), action=action)
        if symbol >= 0 and not self.plan.engine.contains(self.plan.rows.var0[t] + STATE, symbol):
            return WRONG_STATE.at(span, name=self.name(t), state="so constrained", action=action)
        return None

    def activate(self, t: int, span: Span, number: int) -> Diagnostic | None:
        """Activate; once more is no mistake."""
        if self.plan.rows.status[t] == ACTIVE:
            return None
        if (wrong := self._wrong_state(t, INACTIVE, NONE, "activated", span)) is not None:
            return wrong
        lifecycle.activate(self.plan, t, number)
        return None

    def merge(self, t: int, other: int, span: Span, number: int) -> Diagnostic | None:
        """Merge into an active token of the same predicate."""
        rows = self.plan.rows
        wrong = self._wrong_state(t, INACTIVE, SYMBOL_MERGED, "merged", span)
        wrong = wrong or self._wrong_state(other, ACTIVE, NONE, "merged into", span)
        if wrong is not None:
            return wrong
        if not is_kind_of(self.plan, rows.predicate[other], rows.predicate[t]):
            one, another = (self.program.predicates[rows.predicate[each]].name for each in (t, other))
            return OTHER_PREDICATE.at(span, name=self.name(t), other=self.name(other), predicate=one, others=another)
        lifecycle.merge(self.plan, t, other, number)
        return None

    def reject(self, t: int, span: Span, number: int) -> Diagnostic | None:
        """Reject a rejectable token."""
        if not self.plan.rows.flags[t] & FLAG_REJECTABLE:
            return NOT_REJECTABLE.at(span, name=self.name(t))
        if (wrong := self._wrong_state(t, INACTIVE, SYMBOL_REJECTED, "rejected", span)) is not None:
            return wrong
        lifecycle.reject(self.plan, t, number)
        return None

    def cancel(self, t: int, span: Span) -> Diagnostic | None:
        """Undo what made a token active, merged or rejected."""
        if self.plan.rows.flags[t] & FLAG_NATIVE:
            return WRONG_STATE.at(span, name=self.name(t), state="a use of a resource", action="cancelled")
        retraction.cancel(self.plan, t)
        return None

    # ---- variables and objects ----

    def _of_variable(
        self, call: Call, kind: int, value: int, arguments: list[tuple[int, int]], tokens: list[int], span: int
    ) -> Diagnostic | None:
        """A call on a variable, or on the object that it holds."""
        v = operand(self.plan, self.scope, kind, value, span)
        name = call.name
        match call.method:
            case "specify":
                return self.specify(v, operand(self.plan, self.scope, *arguments[0], span), name, call.span, span)
            case "reset":
                retraction.reset(self.plan, v)
                return None
            case "close":
                if not is_growing(self.plan.engine, v):
                    return CLOSED_ALREADY.at(call.span, name=name)
                self.plan.engine.close(v)
                return None
        if not self.plan.engine.is_singleton(v):
            return NOT_ONE_OBJECT.at(call.span, name=name)
        o = int(self.plan.engine.lower(v))
        chosen = [self.token(slot) for slot in tokens]
        match call.method:
            case "constrain":
                return self._constrain(o, chosen, call.span, span)
            case "free":
                return self.free(o, chosen[0], chosen[-1], call.span, span)
            case _:
                assert call.method in ("set_capacity", "set_limit"), f"no method {call.method} of objects"
                bounds = [self.plan.engine.lower(operand(self.plan, self.scope, *each, span)) for each in arguments]
                uses = self.plan.resources
                change = uses.set_limit if call.method == "set_limit" else uses.set_capacity
                change(o, int(bounds[0]), bounds[1], bounds[-1])
        return None

    def specify(self, v: int, source: int, name: str, span: Span, number: int) -> Diagnostic | None:
        """Decide a variable for a value of its base domain."""
        engine = self.plan.engine
        if not engine.is_singleton(source):
            return SEVERAL_VALUES.at(span, name=name)
        value = engine.lower(source)
        values = engine.base_values(v)
        inside = engine.base_lower(v) <= value <= engine.base_upper(v)
        if values is not None and not is_base_growing(engine, v):
            inside = value in values
        if not inside:
            text = base_text(self.prototypes, engine, source, self.objects.names)
            return OUTSIDE_DOMAIN.at(span, value=text, name=name)
        if engine.decided[v] and not engine.contains(v, value):
            retraction.reset(self.plan, v)
        engine.decide(v, value, number, NONE)
        return None

    def _constrain(self, o: int, tokens: list[int], span: Span, number: int) -> Diagnostic | None:
        """Order two tokens on an object, or put one on it."""
        for t in tokens:
            if (wrong := self._wrong_state(t, ACTIVE, NONE, "put on an object", span)) is not None:
                return wrong
            if not self.plan.engine.contains(self.plan.rows.var0[t] + OBJECT, o):
                return WRONG_OBJECT.at(span, name=self.name(t), object=self.objects.names[o])
        if len(tokens) == 1:
            timelines.assign_object(self.plan, o, tokens[0], number)
        else:
            timelines.order(self.plan, o, tokens[0], tokens[1], number)
        return None

    def free(self, o: int, first: int, second: int, span: Span, number: int) -> Diagnostic | None:
        """Undo the order of two tokens, or that one was put on an object."""
        rows = self.plan.rows
        if first != second and not timelines.has_pair(rows, first, second):
            return NOT_ORDERED.at(span, name=self.name(first), other=self.name(second), object=self.objects.names[o])
        retraction.free(self.plan, first, second, number)
        return None

    # ---- classes ----

    def of_class(self, call: Call) -> Diagnostic | None:
        """`C.close()` and `close()`."""
        assert call.method == "close", f"no method {call.method} of classes"
        if call.class_name is None:
            for number in range(len(self.program.classes)):
                self.objects.close(number)
            return None
        number = self.prototypes.class_numbers[call.class_name]
        if self.prototypes.is_closed[number]:
            return CLOSED_ALREADY.at(call.span, name=call.class_name)
        self.objects.close(number)
        return None
