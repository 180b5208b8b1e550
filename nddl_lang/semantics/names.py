"""Tie every path to what it names; tell the user where nothing of that name is known.

The order of look-up: enum values, local variables, the own token's variables (in a constructor the members), tokens,
globals, classes. Before a dot a token comes first: `x.y` is the token's variable even where a parameter is called x.
"""

import re
from collections.abc import Iterable, Sequence

from nddl_lang.semantics.class_as_value import complain_class
from nddl_lang.semantics.codes import (
    DECLARED_BELOW,
    MISPLACED_THIS,
    NAME_OF_OTHER_BLOCK,
    NOT_AN_OBJECT,
    UNKNOWN_ENUM_VALUE,
    UNKNOWN_MEMBER,
    UNKNOWN_NAME,
    UNKNOWN_TOKEN_VARIABLE,
)
from nddl_lang.semantics.declared_twice import tell_reused
from nddl_lang.semantics.natives import builtin_names, builtin_type, other_name
from nddl_lang.semantics.owned_names import declared_note, others_with, owned_by_others, owned_names
from nddl_lang.semantics.schema import (
    ClassReference,
    EnumValue,
    GlobalReference,
    Kind,
    Label,
    LocalReference,
    MemberReference,
    Reference,
    TokenReference,
    TokenVariableReference,
)
from nddl_lang.semantics.scope import BlockKind, Context, Scope, is_told
from nddl_lang.semantics.types import reference_type
from nddl_lang.syntax.nodes import BinaryExpr, Expr, Identifier, PathExpr
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.nearest import begun, nearest
from nddl_lang.text.source import Span

TOKEN_OF_SCRIPT = "`{name}` is a token of the script; rules and predicates see only tokens of their own"

MOST_NAMED = 8  # names that a help lists
_VALUE_TABLES = ("global", "goal", "value")
COMPARISONS = frozenset(("==", "!=", "<", "<=", ">", ">="))
_LITERALS = ("true", "false", "inf", "inff")
_HYPHEN = re.compile(r"-([A-Za-z_$][\w$]*)", re.ASCII)
_TRUTHS = {"yes": "true", "no": "false", "on": "true", "off": "false"}


def resolve(
    context: Context, scope: Scope, path: PathExpr, *, type_name: str | None = None, compared: str | None = None
) -> Reference | None:
    """What `path` names, noted in the tables; None, after a complaint, where it names nothing.

    `type_name` is the type that a name would be declared with, where that is plain; `compared` is the name on the other
    side of a comparison, which is never what was meant.
    """
    parts = path.parts
    if len(parts) == 1:
        reference = find(context, scope, parts[0].name)
        if reference is None:
            complain_unknown(context, scope, parts[0], type_name=type_name, compared=compared)
    else:
        reference = resolve_dotted(context, scope, parts, compared)
    if reference is not None:
        context.tables.references[path] = reference
        context.tables.references[parts[-1]] = reference
    return reference


def resolve_value(context: Context, scope: Scope, path: PathExpr, compared: str | None = None) -> Reference | None:
    """Like `resolve`, for a place where a class is no answer."""
    reference = resolve(context, scope, path, compared=compared)
    if isinstance(reference, ClassReference):
        complain_class(context, scope, path.parts)
        return None
    return reference


def name_beside(binary: BinaryExpr, side: Expr) -> str | None:
    """The name on one side of a comparison: nobody means to compare it with itself."""
    return side.span.text if binary.op in COMPARISONS and isinstance(side, PathExpr) else None


def _last_of(compared: str | None, parts: Sequence[Identifier]) -> str | None:
    """The last name of the other side, where that differs from these in nothing else: it is not meant here."""
    before, _, last = (compared or "").rpartition(".")
    return last if before == ".".join(part.name for part in parts[:-1]) else None


def find(context: Context, scope: Scope, name: str) -> Reference | None:
    """What a bare name means."""
    symbols = context.symbols
    reference: Reference | None = symbols.find_value(name) or scope.find_local(name) or scope.find_own(name)
    if reference is not None:
        return reference
    if scope.kind is BlockKind.CONSTRUCTOR and scope.own_class is not None:
        if name == "this":
            return MemberReference(None, ())
        if (member := symbols.find_member(scope.own_class, name)) is not None:
            return MemberReference(None, (member,))
    if (label := scope.find_label(name) or find_script_token(context, scope, name)) is not None:
        return TokenReference(label)
    if (variable := symbols.find_global(name)) is not None:
        return GlobalReference(variable)
    return ClassReference(name) if symbols.find_class(name) is not None else None


def find_script_token(context: Context, scope: Scope, name: str) -> Label | None:
    """The token of the script with that name, where it can be seen: rules are about tokens that are not made yet."""
    return context.symbols.find_goal(name) if scope.kind is BlockKind.SCRIPT else None


def resolve_dotted(
    context: Context, scope: Scope, parts: Sequence[Identifier], compared: str | None = None
) -> Reference | None:
    """What `a.b.c` names; None, after a complaint, where it names nothing. It is not meant to be `compared`."""
    symbols, (head, *rest) = context.symbols, parts
    but = _last_of(compared, parts)
    others = others_with(context, scope, rest[0].name, compared) if len(rest) == 1 else []
    label = scope.find_label(head.name)
    start: Reference | None
    if label is None:
        start = scope.find_local(head.name) or scope.find_own(head.name)
        if start is None and (goal := find_script_token(context, scope, head.name)) is not None:
            label = goal
    if label is not None:
        context.tables.references[head] = TokenReference(label)
        if tell_reused(context, scope, label, rest[0].name):
            return None
        start = _find_token_variable(context, label, parts, but if len(rest) == 1 else None, others)
        if start is None:
            return None
        head = rest.pop(0)
    elif start is None and len(rest) == 1 and (enum := symbols.find_enum(head.name)) is not None:
        return _qualified_value(context, enum.name, rest[0])
    elif start is None:
        start = find(context, scope, head.name)
    match start:
        case None:
            complain_unknown(context, scope, head)
            return None
        case ClassReference():
            context.tables.references[head] = start
            complain_class(context, scope, parts)
            return None
    context.tables.references[head] = start
    return follow(context, scope, start, head, rest, but, others)


def _qualified_value(context: Context, enum: str, name: Identifier) -> EnumValue | None:
    value = context.symbols.find_value(name.name)
    if value is not None and value.enum == enum:
        return value
    found = context.symbols.find_enum(enum)
    if found is not None and not context.symbols.is_doubtful(name.name):
        complaint = UNKNOWN_ENUM_VALUE.at(name.span, name=name.name, enum=enum)
        context.complain(suggest_name(complaint, name, found.values))
    return None


def follow(
    context: Context,
    scope: Scope,
    start: Reference,
    head: Identifier,
    rest: list[Identifier],
    but: str | None = None,
    others: Sequence[str] = (),
) -> Reference | None:
    """The member `rest` of the object that `start` (written `head`) refers to; a complaint where there is none.

    The last of them is not meant to be `but`; `others` have it.
    """
    reference = start
    for part in rest:
        type_ = reference_type(reference, scope.own_class)
        if type_ is None:
            return None
        if type_.kind is not Kind.OBJECT:
            what = f"of type `{type_.name}`" if not isinstance(reference, EnumValue) else "an enum value"
            context.complain(NOT_AN_OBJECT.at(head.span.to(part.span), name=head.name, type=what, member=part.name))
            return None
        member = context.symbols.find_member(type_.base, part.name)
        if member is None:
            complain_unknown_member(context, type_.base, part, but if part is rest[-1] else None, head, others)
            return None
        if isinstance(reference, MemberReference):
            reference = MemberReference(reference.base, (*reference.members, member))
        else:
            assert isinstance(reference, GlobalReference | LocalReference | TokenVariableReference)
            reference = MemberReference(reference, (member,))
        context.tables.references[part] = reference
        head = part
    return reference


def _find_token_variable(
    context: Context, label: Label, parts: Sequence[Identifier], but: str | None, others: Sequence[str]
) -> TokenVariableReference | None:
    """The variable of a token; a complaint where it has none, which is not meant to be `but`; `others` have one."""
    head, name = parts[:2]
    predicate = label.predicate
    type_ = builtin_type(name.name, predicate)
    if type_ is None:
        type_ = next((p.type for p in predicate.parameters if p.name == name.name), None)
    if type_ is not None:
        variable = TokenVariableReference(label, name.name, type_)
        context.tables.references[name] = variable
        return variable
    if not context.symbols.is_partial(predicate.class_name) and not context.symbols.is_doubtful(name.name):
        complaint = UNKNOWN_TOKEN_VARIABLE.at(
            name.span, notes=declared_note(predicate), predicate=predicate.full_name, name=name.name
        )
        if predicate.is_event and name.name in ("start", "end"):
            fix = Fix("write `time`", (Edit(name.span, "time"),))
            complaint = _with(complaint, "an event has one `time`, in place of `start` and `end`", (fix,))
        elif others:
            complaint = owned_by_others(complaint, head.span.to(name.span), others)
        else:
            names = [parameter.name for parameter in predicate.parameters if parameter.name != but]
            only = names[0] if len(names) == 1 and but is None else None
            complaint = suggest_name(
                complaint,
                name,
                [*names, *(each for each in builtin_names(predicate.is_event) if each != but)],
                last=other_name(name.name, predicate) or only,
            )
            if complaint.help is None and 0 < len(names) <= MOST_NAMED:
                named = f"its {listed('parameter', names)}"
                members = _members(context, predicate.class_name)
                is_short = 0 < len(members) <= MOST_NAMED
                complaint = _with(
                    complaint, f"{named}; `object.{'`, `object.'.join(members)}`" if is_short else named, ()
                )
        context.complain(complaint)
    return None


def complain_unknown_member(
    context: Context,
    class_name: str,
    name: Identifier,
    but: str | None = None,
    head: Identifier | None = None,
    others: Sequence[str] = (),
) -> None:
    """Say that a class has no such member; `but` is not what was meant, `others` than `head` have one."""
    symbols = context.symbols
    if symbols.is_partial(class_name) or symbols.is_doubtful(name.name):
        return
    owner = symbols.find_class(class_name)
    span = owner.span if owner is not None else None
    notes = (Note(f"`{class_name}` is declared here", span),) if span is not None else ()
    complaint = UNKNOWN_MEMBER.at(name.span, notes=notes, owner=class_name, name=name.name)
    if owner is not None and not owner.is_defined:
        complaint = _with(complaint, f"`{class_name}` is only announced so far; define it above this place", ())
    members = [each for each in _members(context, class_name) if each != but]
    if others and head is not None:
        context.complain(owned_by_others(complaint, head.span.to(name.span), others))
        return
    complaint = suggest_name(complaint, name, members)
    if complaint.help is None and 0 < len(members) <= MOST_NAMED:
        complaint = _with(complaint, f"its {listed('member', members)}", ())
    context.complain(complaint)


def listed(what: str, names: list[str]) -> str:
    """A help lists names so: `parameters are `a`, `b``, or `member is `c``."""
    named = ", ".join(f"`{name}`" for name in names)
    return f"{what}s are {named}" if len(names) > 1 else f"{what} is {named}"


def _members(context: Context, class_name: str) -> list[str]:
    """The members of a class, its own first, inherited ones too."""
    return [member for ancestor in context.symbols.ancestry(class_name) for member in ancestor.members]


def complain_unknown(
    context: Context,
    scope: Scope,
    name: Identifier,
    tables: tuple[str, ...] = (),
    type_name: str | None = None,
    *,
    is_target: bool = False,
    compared: str | None = None,
) -> None:
    """Say that nothing of that name is known, once per statement, unless an earlier mistake may be the reason.

    What may have been meant is looked for among values, and in `tables` too; of what is assigned to, among members.
    """
    symbols, word = context.symbols, name.name
    if is_told(context, scope, word):
        return
    context.reported.add(word)
    if word == "this":
        context.complain(MISPLACED_THIS.at(name.span, place=scope.kind.value))
    elif (parted := _parted_name(context, scope, name)) is not None:
        meant, span = parted
        context.reported.add(meant.rpartition("_")[2])
        fix = Fix(f"write `{meant}`", (Edit(span, meant),), safe=False)
        context.complain(_with(UNKNOWN_NAME.at(name.span, name=word), f"did you mean `{meant}`?", (fix,)))
    elif (lost := scope.lost_at(word)) is not None:
        note = Note(f"`{word}` is declared in a block that ends before this place", lost)
        context.complain(NAME_OF_OTHER_BLOCK.at(name.span, notes=(note,), name=word))
    elif _is_own_member(context, scope, word):
        fix = Fix(f"write `object.{word}`", (Edit(name.span, f"object.{word}"),))
        help_ = f"`{word}` is a member of class `{scope.own_class}`; in a rule or predicate write `object.{word}`"
        context.complain(_with(UNKNOWN_NAME.at(name.span, name=word), help_, (fix,)))
    elif symbols.find_goal(word) is not None and scope.kind is not BlockKind.SCRIPT:
        context.complain(_with(UNKNOWN_NAME.at(name.span, name=word), TOKEN_OF_SCRIPT.format(name=word), ()))
    elif (path := scope.unnamed(word)) is not None:
        scope.doubt(word)
        after = Span(path.span.anchor, path.span.end, path.span.end)
        fix = Fix(f"name the token `{word}`", (Edit(after, f" {word}"),), safe=False)
        note = Note("a token is asked for here, without a name", path.span)
        complaint = UNKNOWN_NAME.at(name.span, name=word, notes=(note,))
        context.complain(_with(complaint, f"name the token: `{path.span.text} {word}`", (fix,)))
    elif (below := scope.declared_below(word) or symbols.declared_below(word)) is not None:
        note = Note(f"`{word}` is declared here; statements run in order", below)
        context.complain(DECLARED_BELOW.at(name.span, notes=(note,), name=word))
    else:
        own = builtin_names(scope.own.predicate.is_event) if scope.own is not None else ()
        values = [each for each in _VALUE_TABLES if each != "goal" or scope.kind is BlockKind.SCRIPT]
        constructed = scope.own_class if scope.kind is BlockKind.CONSTRUCTOR else None
        members = _members(context, constructed) if constructed is not None else ()
        candidates = (
            [*members]
            if is_target
            else [*scope.visible(), *own, *members, *symbols.names(*values, *tables), *_LITERALS]
        )
        meant, help_ = None, None
        if constructed is not None and _is_predicate(context, constructed, word):
            meant = f'"{word}"'
            help_ = f"a predicate is named in quotes: `{meant}`"
        elif owned := owned_names(context, scope, word):
            meant = owned[0] if len(owned) == 1 else None
            help_ = f"say of what: {' or '.join(f'`{each}`' for each in owned)}"
        elif word == "self" and (scope.own is not None or constructed is not None):
            meant = "this"
        complaint = UNKNOWN_NAME.at(name.span, name=word, help=help_)
        last = other_name(word, scope.own.predicate) if scope.own is not None else None
        last = last or _TRUTHS.get(word.casefold())
        candidates = [each for each in candidates if each != compared]
        complaint = suggest_name(complaint, name, candidates, meant, last if last != compared else None)
        if is_target and complaint.help is None:
            complaint = _with(complaint, f"declare `{word}` as a member of class `{constructed}`", ())
        if type_name is not None:
            before = Span(name.span.anchor, name.span.start, name.span.start)
            fix = Fix(f"declare `{type_name} {word}`", (Edit(before, f"{type_name} "),), safe=False)
            complaint = _with(complaint, complaint.help or fix.title, (*complaint.fixes, fix))
        context.complain(complaint)


def _parted_name(context: Context, scope: Scope, name: Identifier) -> tuple[str, Span] | None:
    """The known name that `A-B`, which begins with `name`, was meant to be, `A_B`, and where it stands."""
    rest = _HYPHEN.match(name.span.source.text, name.span.finish)
    meant = "" if rest is None else f"{name.name}_{rest[1]}"
    if rest is None or find(context, scope, meant) is None:
        return None
    return meant, Span(name.span.anchor, name.span.start, name.span.end + len(rest[0]))


def _is_predicate(context: Context, class_name: str, name: str) -> bool:
    """Whether tokens of a class may be of that predicate."""
    return any(name in owner.predicates for owner in context.symbols.ancestry(class_name))


def _is_own_member(context: Context, scope: Scope, name: str) -> bool:
    if scope.own_class is None or scope.kind not in (BlockKind.RULE, BlockKind.PREDICATE):
        return False
    return context.symbols.find_member(scope.own_class, name) is not None


def suggest_name(
    complaint: Diagnostic,
    name: Identifier,
    candidates: Iterable[str],
    meant: str | None = None,
    last: str | None = None,
) -> Diagnostic:
    """The complaint with what was meant as help, else with the nearest of the candidates, if one is near, or `last`."""
    candidates = [*candidates]
    known = meant or nearest(name.name, candidates) or begun(name.name, candidates) or last
    if known is None:
        return complaint
    fix = Fix(f"write `{known}`", (Edit(name.span, known),), safe=False)
    return _with(complaint, complaint.help or f"did you mean `{known}`?", (*complaint.fixes, fix))


def _with(complaint: Diagnostic, help_: str, fixes: tuple[Fix, ...]) -> Diagnostic:
    return Diagnostic(
        complaint.code, complaint.severity, complaint.span, complaint.message, complaint.notes, help_, fixes
    )
