"""Check method calls: the method exists for what it is called on, fits, and is possible in the state reached."""

from nddl_lang.semantics.arguments import check_count, check_types
from nddl_lang.semantics.codes import (
    CLOSED_TWICE,
    MERGE_INACTIVE,
    MERGE_OTHER,
    NOT_INACTIVE,
    NOT_REJECTABLE,
    ORDER_INACTIVE,
    UNKNOWN_METHOD,
    WRONG_RECEIVER,
)
from nddl_lang.semantics.expressions import type_of
from nddl_lang.semantics.functions import METHODS, MethodRow, Receiver
from nddl_lang.semantics.names import resolve, suggest_name
from nddl_lang.semantics.natives import builtin_names
from nddl_lang.semantics.schema import (
    ClassReference,
    EnumValue,
    Kind,
    Label,
    Reference,
    TokenReference,
    TokenVariableReference,
    Type,
)
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.script import check_domain, note_state
from nddl_lang.semantics.types import STATE, reference_type
from nddl_lang.semantics.values import check_value, domain_key
from nddl_lang.syntax.nodes import MethodCall, PathExpr
from nddl_lang.syntax.removal import removal
from nddl_lang.text.diagnostic import Edit, Fix, Note
from nddl_lang.text.source import Span

_STATE_WORDS = {"ACTIVE": "active", "INACTIVE": "inactive", "MERGED": "merged", "REJECTED": "rejected"}


def check_method(context: Context, node: MethodCall) -> None:
    """Check `target.method(...);` or `close();`."""
    scope = Scope(BlockKind.SCRIPT)
    if not node.target.parts:
        _close(context, None, node.span, "everything")
        return
    reference = resolve(context, scope, node.target)
    if reference is None:
        return
    row = _find_method(context, node, _receivers(reference))
    if row is None:
        return
    types = [type_of(context, scope, argument) for argument in node.arguments]
    if not check_count(context, row.name, row.signature, len(types), node.span, row.meaning):
        return
    check_types(context, row.name, row.signature, node.arguments, types)
    _check_effect(context, scope, node, row, reference)


def _receivers(reference: Reference) -> tuple[Receiver, ...]:
    match reference:
        case ClassReference():
            return (Receiver.CLASS,)
        case TokenReference():
            return (Receiver.TOKEN,)
        case EnumValue():
            return ()
        case _:
            type_ = reference_type(reference, None)
            is_object = type_ is not None and type_.kind is Kind.OBJECT
            return (Receiver.VARIABLE, Receiver.OBJECT) if is_object else (Receiver.VARIABLE,)


def _find_method(context: Context, node: MethodCall, receivers: tuple[Receiver, ...]) -> MethodRow | None:
    name = node.method.name
    for receiver in receivers:
        if (row := METHODS.get((receiver, name))) is not None:
            return row
    others = [receiver.value for receiver, method in METHODS if method == name and receiver is not Receiver.NOTHING]
    if others:
        found = receivers[-1].value if receivers else "an enum value"
        text = node.target.span.text
        wanted = " or ".join(others)
        context.complain(WRONG_RECEIVER.at(node.target.span, name=name, wanted=wanted, text=text, found=found))
    else:
        names = dict.fromkeys(method for receiver, method in METHODS if receiver in receivers)
        complaint = UNKNOWN_METHOD.at(node.method.span, name=name)
        stated = _stated(context, node)
        if stated is None:
            complaint = suggest_name(complaint, node.method, names)
        else:
            fix = Fix(f"write `{stated}`", (Edit(node.span, stated),), safe=False)
            help_ = f"`{name}` is a variable, and a statement says what it is: `{stated}`"
            complaint = UNKNOWN_METHOD.at(node.method.span, name=name, help=help_, fixes=(fix,))
        context.complain(complaint)
    return None


def _stated(context: Context, node: MethodCall) -> str | None:
    """`token.variable(value)` as the constraint that is meant; None where it is another call."""
    reference = context.tables.references.get(node.target)
    if not isinstance(reference, TokenReference) or len(node.arguments) != 1:
        return None
    predicate, name = reference.label.predicate, node.method.name
    if name not in builtin_names(predicate.is_event) and all(each.name != name for each in predicate.parameters):
        return None
    return f"{node.target.span.text}.{name} == {node.arguments[0].span.text};"


def _check_effect(context: Context, scope: Scope, node: MethodCall, row: MethodRow, reference: Reference) -> None:
    match row.receiver, reference:
        case Receiver.CLASS, ClassReference(name=name):
            _close(context, name, node.span, f"class `{name}`")
        case Receiver.TOKEN, TokenReference(label=label):
            _check_transaction(context, node, row, label)
        case Receiver.OBJECT, _ if row.name == "constrain":
            for argument in node.arguments:
                token = _token(context, argument)
                if token is not None and context.symbols.token_state(token.name) not in (None, "ACTIVE"):
                    text = node.target.span.text
                    context.complain(ORDER_INACTIVE.at(argument.span, name=token.name, object=text))
        case Receiver.VARIABLE, _:
            _check_decision(context, scope, node, row, reference)
        case _:
            pass


def _close(context: Context, class_name: str | None, span: Span, what: str) -> None:
    closed = context.symbols.closed_at(class_name if class_name is not None else "*")
    if closed is not None:
        fix = Fix("remove it", (removal(span),))
        context.complain(CLOSED_TWICE.at(span, notes=(Note("it is closed here", closed),), what=what, fixes=(fix,)))
    else:
        context.symbols.put_closed(class_name, span)


def _check_decision(context: Context, scope: Scope, node: MethodCall, row: MethodRow, reference: Reference) -> None:
    """`specify`, `reset` and `close` of a variable."""
    type_ = STATE if isinstance(reference, TokenReference) else reference_type(reference, None)
    if type_ is None:
        return
    if row.name == "specify":
        _check_specify(context, scope, node, type_, reference)
    elif row.name == "reset" and isinstance(reference, TokenVariableReference) and reference.name == "state":
        note_state(context, reference.label, None)
    elif row.name == "close":
        key = domain_key(context, node.target)
        if key is None:
            return
        if (closed := context.symbols.look("closed variable", key)) is not None:
            assert isinstance(closed, Span)
            notes = (Note("it is closed here", closed),)
            fix = Fix("remove it", (removal(node.span),))
            context.complain(CLOSED_TWICE.at(node.span, notes=notes, fixes=(fix,), what=f"`{node.target.span.text}`"))
        context.symbols.put("closed variable", key, node.span)


def _check_specify(context: Context, scope: Scope, node: MethodCall, type_: Type, reference: Reference) -> None:
    value = node.arguments[0]
    if check_value(context, scope, value, type_, node.target.span.text) is None:
        return
    left = check_domain(context, node.target, type_, value)
    if isinstance(reference, TokenVariableReference) and reference.name == "state":
        note_state(context, reference.label, left)


def _check_transaction(context: Context, node: MethodCall, row: MethodRow, label: Label) -> None:
    """`activate`, `merge`, `reject` and `cancel` of a token, as far as its state is known for certain."""
    symbols = context.symbols
    state = symbols.token_state(label.name)
    match row.name:
        case "activate":
            if state in ("MERGED", "REJECTED"):
                _complain_state(context, node, label, "activated", state)
            symbols.put_token_state(label.name, "ACTIVE")
        case "merge":
            if state in ("ACTIVE", "REJECTED", "MERGED"):
                _complain_state(context, node, label, "merged", state)
            else:
                _check_merge(context, node, label)
            symbols.put_token_state(label.name, "MERGED")
            symbols.put("merged", "*", True)
        case "reject":
            kind = symbols.token_kind(label.name)
            if kind != "rejectable":
                context.complain(NOT_REJECTABLE.at(node.span, name=label.name, kind=kind))
            elif state in ("ACTIVE", "REJECTED", "MERGED"):
                _complain_state(context, node, label, "rejected", state)
            symbols.put_token_state(label.name, "REJECTED")
        case "cancel":
            if state == "INACTIVE":
                _complain_state(context, node, label, "cancelled", state)
            symbols.put_token_state(label.name, "INACTIVE")
            if state != "MERGED":
                _forget_merged(context)
        case _:
            symbols.put_token_state(label.name, None)


def _forget_merged(context: Context) -> None:
    """A cancelled token lets go of the tokens that were merged into it; which they are is not kept."""
    symbols = context.symbols
    if symbols.look("merged", "*") is None:
        return
    symbols.put("merged", "*", None)
    for name in list(symbols.names("goal")):
        if symbols.token_state(name) == "MERGED":
            symbols.put_token_state(name, None)


def _complain_state(context: Context, node: MethodCall, label: Label, done: str, state: str) -> None:
    context.complain(NOT_INACTIVE.at(node.span, name=label.name, done=done, state=_STATE_WORDS[state]))


def _check_merge(context: Context, node: MethodCall, label: Label) -> None:
    argument = node.arguments[0]
    active = _token(context, argument)
    if active is None:
        return
    one, other = label.predicate, active.predicate
    if one.name != other.name or not context.symbols.is_subclass(other.class_name, one.class_name):
        notes = (Note(f"`{active.name}` is a token of `{other.full_name}`", active.span),)
        context.complain(MERGE_OTHER.at(argument.span, notes=notes, name=label.name, one=one.full_name))
    elif context.symbols.token_state(active.name) not in (None, "ACTIVE"):
        help_ = f"activate it first: `{active.name}.activate();`"
        context.complain(MERGE_INACTIVE.at(argument.span, help=help_, name=active.name))


def _token(context: Context, argument: object) -> Label | None:
    if not isinstance(argument, PathExpr):
        return None
    reference = context.tables.references.get(argument)
    return reference.label if isinstance(reference, TokenReference) else None
