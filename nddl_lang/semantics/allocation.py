"""Choose the constructor that a `new` or `super(...)` calls; tell the user where none fits."""

from collections.abc import Sequence
from itertools import combinations

from nddl_lang.semantics.arguments import MOST_REORDERED, ordinal, reordered, told_places
from nddl_lang.semantics.codes import CLASS_IS_CLOSED, NO_BASE_CONSTRUCTOR, NO_CONSTRUCTOR, UNKNOWN_NAME
from nddl_lang.semantics.expressions import type_of
from nddl_lang.semantics.names import find
from nddl_lang.semantics.schema import Chosen, Class, Constructor, Kind, Type, Variable
from nddl_lang.semantics.scope import BlockKind, Context, Deferred, Scope, is_told
from nddl_lang.semantics.symbol_table import SymbolTable
from nddl_lang.semantics.typenames import find_defined_class
from nddl_lang.semantics.types import fits, object_type, phrase
from nddl_lang.semantics.values import check_restriction
from nddl_lang.syntax.nodes import Assignment, Expr, NewExpr, PathExpr, StringLiteral
from nddl_lang.syntax.removal import removal
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span


def check_allocation(context: Context, scope: Scope, new: NewExpr) -> Class | None:
    """Check `new C(...)` and choose its constructor; the class, None after a complaint."""
    _tell_unquoted(context, scope, new)
    types = argument_types(context, scope, new.arguments)
    context.tables.types[new] = object_type(new.class_name.name)
    known = context.symbols.find_class(new.class_name.name)
    if scope.kind is not BlockKind.SCRIPT and (known is None or not known.is_defined):
        context.deferred.append(Deferred(new, tuple(types)))
        return None
    owner = find_defined_class(context, new.class_name)
    if owner is None:
        context.symbols.put_faulty("new")
        return None
    is_sound = _choose_for(context, owner, new, types)
    if is_sound and scope.kind is BlockKind.SCRIPT:
        closed = context.symbols.closed_at(owner.name)
        if closed is not None:
            context.complain(_joins_late(new.span, closed, owner.name))
    if scope.kind in (BlockKind.SCRIPT, BlockKind.RULE):
        for name in _made_with(context.symbols, owner.name):
            context.symbols.put_object(name)
    return owner if is_sound else None


def _joins_late(new: Span, closed: Span, name: str) -> Diagnostic:
    """The complaint of an object that is made behind `close()`, which moves behind it where that is written alike."""
    text, rest = closed.text, new.source.text[new.finish :].lstrip()
    fixes: tuple[Fix, ...] = ()
    if closed.source is new.source and text.endswith(";") and rest.startswith(";"):
        behind = new.end + len(new.source.text) - new.finish - len(rest) + 1
        edits = (removal(closed), Edit(Span(new.anchor, behind, behind), f"\n{text}"))
        fixes = (Fix(f"write `{text}` behind it", edits, safe=False),)
    help_ = f"`{text}` stands behind the last object that is made"
    notes = (Note("it is closed here", closed),)
    return CLASS_IS_CLOSED.at(new, notes=notes, name=name, help=help_, fixes=fixes)


def _tell_unquoted(context: Context, scope: Scope, new: NewExpr) -> None:
    """Complain of an unknown name where each constructor takes a text."""
    owner = context.symbols.find_class(new.class_name.name)
    fitting = [] if owner is None else [one for one in owner.constructors if len(one.parameters) == len(new.arguments)]
    for index, argument in enumerate(new.arguments if fitting else ()):
        if not isinstance(argument, PathExpr) or len(argument.parts) > 1:
            continue
        name = argument.parts[0].name
        is_text = all(one.parameters[index].type.kind is Kind.STRING for one in fitting)
        if is_text and not is_told(context, scope, name) and find(context, scope, name) is None:
            context.reported.add(name)
            fix = Fix(f'write `"{name}"`', (Edit(argument.span, f'"{name}"'),), safe=False)
            help_ = f'a text stands in quotes: `"{name}"`'
            context.complain(UNKNOWN_NAME.at(argument.span, name=name, help=help_, fixes=(fix,)))


def check_deferred(context: Context, deferred: Deferred) -> None:
    """Choose the constructor of a `new` whose class was not defined above it, now that the script is read."""
    context.tables.constructors.pop(deferred.new, None)
    owner = find_defined_class(context, deferred.new.class_name)
    if owner is not None:
        _choose_for(context, owner, deferred.new, deferred.types)


def _choose_for(context: Context, owner: Class, new: NewExpr, types: Sequence[Type | None]) -> bool:
    constructor = choose(context, owner, new.arguments, types, new.span)
    if constructor is None:
        return False
    context.tables.constructors[new] = Chosen(constructor)
    lacking = _lacking_base(context.symbols, constructor)
    if lacking is not None:
        notes = constructor_notes(lacking)
        context.complain(NO_BASE_CONSTRUCTOR.at(new.span, notes=notes, name=owner.name, base=lacking.name))
    return True


def argument_types(context: Context, scope: Scope, arguments: Sequence[Expr]) -> list[Type | None]:
    """The types of the arguments; nested allocations are checked."""
    types = [type_of(context, scope, argument) for argument in arguments]
    for argument in arguments:
        if isinstance(argument, NewExpr):
            check_allocation(context, scope, argument)
    return types


def choose(
    context: Context, owner: Class, arguments: Sequence[Expr], types: Sequence[Type | None], span: Span
) -> Constructor | None:
    """The constructor of `owner` that needs the fewest conversions, the first of several; a complaint if none fits."""
    best: Constructor | None = None
    least = 0
    for constructor in owner.constructors:
        cost = _conversions(context.symbols, constructor.parameters, types)
        if cost is not None and (best is None or cost < least):
            best, least = constructor, cost
    if best is None:
        if not context.symbols.is_partial(owner.name):
            described = ", ".join("?" if type_ is None else type_.name for type_ in types)
            text = f"that takes `({described})`" if types else "without arguments"
            notes = constructor_notes(owner)
            help_, fixes = _unquoted(context.symbols, owner, arguments)
            if not fixes:
                fixes = _reordered(context.symbols, owner, arguments, types)
                help_ = _misfit(context.symbols, owner, arguments, types)
            complaint = NO_CONSTRUCTOR.at(span, notes=notes, help=help_, fixes=fixes, name=owner.name, arguments=text)
            context.complain(complaint)
        return None
    for argument, parameter in zip(arguments, best.parameters, strict=True):
        check_restriction(context, argument, parameter.type, parameter.name)
    return best


def _unquoted(symbols: SymbolTable, owner: Class, arguments: Sequence[Expr]) -> tuple[str | None, tuple[Fix, ...]]:
    """What to do about a text where a constructor takes a value of an enumeration that has that name."""
    for constructor in owner.constructors:
        for argument, parameter in zip(arguments, constructor.parameters, strict=False):
            if not isinstance(argument, StringLiteral) or parameter.type.kind is not Kind.ENUM:
                continue
            text = argument.value
            enum = symbols.find_enum(parameter.type.base)
            if enum is not None and text in enum.values:
                fix = Fix(f"write `{text}`", (Edit(argument.span, text),), safe=False)
                return f"`{text}` is a value of `{parameter.type.name}`: it stands without quotes", (fix,)
    return None, ()


def _reordered(
    symbols: SymbolTable, owner: Class, arguments: Sequence[Expr], types: Sequence[Type | None]
) -> tuple[Fix, ...]:
    """The arguments in the other order that a constructor takes, where one moves fewest of them."""
    if None in types:
        return ()
    return reordered(arguments, lambda order: takes(symbols, owner, [types[at] for at in order]))


def _misfit(symbols: SymbolTable, owner: Class, arguments: Sequence[Expr], types: Sequence[Type | None]) -> str | None:
    """Which argument is missing, one too many or of another type, where it is plain which constructor is meant."""
    far = [abs(len(one.parameters) - len(types)) for one in owner.constructors]
    meant = [one for one, distance in zip(owner.constructors, far, strict=True) if distance == min(far)]
    if len(meant) != 1 or not meant[0].parameters or max(len(types), len(meant[0].parameters)) > MOST_REORDERED:
        return None
    parameters = meant[0].parameters
    if len(types) == len(parameters):
        return "; ".join(
            f"the {ordinal(at)}, `{argument.span.text}`, is {phrase(type_)}; `{_declared(parameter)}` is wanted"
            for at, (argument, type_, parameter) in enumerate(zip(arguments, types, parameters, strict=True))
            if type_ is not None and _conversion(symbols, type_, parameter.type) is None
        )
    is_short = len(types) < len(parameters)
    costs: dict[tuple[int, ...], int] = {}
    for places in combinations(range(max(len(types), len(parameters))), min(len(types), len(parameters))):
        given = types if is_short else [types[at] for at in places]
        wanted = [parameters[at] for at in places] if is_short else parameters
        cost = _conversions(symbols, wanted, given)
        if cost is not None:
            costs[places] = cost
    cheapest = [kept for kept, cost in costs.items() if cost == min(costs.values())]
    first = tuple(range(min(len(types), len(parameters))))
    # Where several fit alike, arguments are read in order: what is missing or too many are the last ones.
    kept = cheapest[0] if len(cheapest) == 1 else first
    if kept not in costs:
        return None
    if is_short and len(cheapest) > 1 and len(owner.constructors) > 1:
        wanted_all = ", ".join(map(_declared, parameters))
        return f"{len(types)} of {len(parameters)} are given: `{owner.name}({wanted_all})`"
    others = [at for at in range(max(len(types), len(parameters))) if at not in kept]
    texts = [_declared(parameters[at]) if is_short else arguments[at].span.text for at in others]
    return told_places(others, texts, "missing" if is_short else "too many")


def _declared(parameter: Variable) -> str:
    return f"{parameter.type.name} {parameter.name}"


def takes(symbols: SymbolTable, owner: Class, types: Sequence[Type | None]) -> bool:
    """Whether a constructor of the class takes arguments of these types."""
    return any(_conversions(symbols, constructor.parameters, types) is not None for constructor in owner.constructors)


def constructor_notes(owner: Class) -> tuple[Note, ...]:
    """A note per constructor of a class."""
    return tuple(Note(f"there is `{signature_text(item)}`", item.span) for item in owner.constructors)


def signature_text(constructor: Constructor) -> str:
    """A constructor with its formal parameters, as declared."""
    parameters = ", ".join(map(_declared, constructor.parameters))
    return f"{constructor.class_name}({parameters})"


def has_empty_constructor(owner: Class) -> bool:
    """Whether the class has a constructor without arguments."""
    return any(not constructor.parameters for constructor in owner.constructors)


def _conversions(symbols: SymbolTable, parameters: Sequence[Variable], types: Sequence[Type | None]) -> int | None:
    """How many conversions arguments of these types need; None where they do not fit."""
    if len(parameters) != len(types):
        return None
    cost = 0
    for type_, parameter in zip(types, parameters, strict=True):
        step = 0 if type_ is None else _conversion(symbols, type_, parameter.type)
        if step is None:
            return None
        cost += step
    return cost


def _conversion(symbols: SymbolTable, found: Type, target: Type) -> int | None:
    if not fits(found, target, symbols.is_subclass):
        return None
    if target.kind is not Kind.OBJECT:
        return int(found.kind is not target.kind)
    return _distance(symbols, found.base, target.base) if symbols.is_subclass(found.base, target.base) else None


def _distance(symbols: SymbolTable, name: str, ancestor: str) -> int:
    for steps, owner in enumerate(symbols.ancestry(name)):
        if owner.name == ancestor:
            return steps
    return 0


def _lacking_base(symbols: SymbolTable, constructor: Constructor) -> Class | None:
    """The ancestor without empty constructor that an implicit constructor would have to call."""
    if constructor.node is not None or symbols.is_partial(constructor.class_name):
        return None
    while True:
        owner = symbols.find_class(constructor.class_name)
        if owner is None or owner.is_native or owner.base is None:
            return None
        base = symbols.find_class(owner.base)
        if base is None:
            return None
        empty = next((item for item in base.constructors if not item.parameters), None)
        if empty is None:
            return base
        if empty.node is not None:
            return None
        constructor = empty


def _made_with(symbols: SymbolTable, class_name: str) -> list[str]:
    """The classes whose objects may come into being with one of `class_name`: those its constructors allocate."""
    made: list[str] = []
    pending = [class_name]
    while pending:
        name = pending.pop()
        if name in made:
            continue
        made.append(name)
        for owner in symbols.ancestry(name):
            for constructor in owner.constructors:
                if constructor.node is None:
                    continue
                pending += [
                    statement.value.class_name.name
                    for statement in constructor.node.body
                    if isinstance(statement, Assignment) and isinstance(statement.value, NewExpr)
                ]
    return made
