"""A place where a value is typed in; which types fit there, and how well a name fits, out."""

from bisect import bisect_right
from collections.abc import Iterable

from lsprotocol.types import CompletionItem, CompletionItemKind

from lsp.completion_place import Place
from lsp.signatures import call_around
from nddl_lang.semantics.functions import METHODS, ResultKind
from nddl_lang.semantics.schema import Constructor, Kind, Type
from nddl_lang.semantics.signature import ArgumentKind, Signature
from nddl_lang.syntax.piece import Piece

_NUMBERS = frozenset(("int", "float"))
_COMPARISONS = frozenset(("==", "!=", "<", "<=", ">", ">=", "="))
_ARITHMETIC = frozenset("+-*/")
_TOKEN = "a token"
_OF_KIND = {
    ArgumentKind.NUMBER: _NUMBERS,
    ArgumentKind.TIME: frozenset(("int",)),
    ArgumentKind.BOOL: frozenset(("bool",)),
    ArgumentKind.STRING: frozenset(("string",)),
    ArgumentKind.TOKEN: frozenset((_TOKEN,)),
    ArgumentKind.RESOURCE: frozenset(("CBReusable",)),
}
_OF_RESULT = {ResultKind.INT: "int", ResultKind.FLOAT: "float", ResultKind.BOOL: "bool", ResultKind.WIDEST: "float"}
_OF_WORD = {"true": "bool", "false": "bool", "inf": "int", "inff": "float"}


def expected_types(place: Place, piece: Piece | None, offset: int) -> frozenset[str]:
    """The types that a value at `offset` may have by what it is compared with or given to; empty if any."""
    if piece is None:
        return frozenset()
    at = offset - piece.anchor.offset
    last = bisect_right(piece.ends, at) - 1
    while last >= 0 and piece.ends[last] == at and (piece.texts[last][-1:].isalnum() or piece.texts[last][-1:] in "_$"):
        last -= 1
    if last < 0:
        return frozenset()
    if piece.texts[last] in "(,":
        return _of_argument(place, piece, offset)
    if piece.texts[last] in ("[", "{", "in"):
        last -= 1
    number = _NUMBERS if piece.texts[last] in _ARITHMETIC else frozenset[str]()
    while last > 0 and piece.texts[last] not in _COMPARISONS and piece.texts[last] not in "(){};,":
        last -= 1
    if last > 0 and piece.texts[last] in _COMPARISONS:
        path = _path_before(piece, last)
        type_ = _declared(place, piece, last) or (place.type_of(path) if path else None)
        if type_ is not None:
            return number & _fitting(place, type_) or _fitting(place, type_)
        if piece.texts[last - 1] == ")" or piece.kinds[last - 1] in ("INT", "FLOAT"):
            return _NUMBERS
    return number


def rank(place: Place, expected: frozenset[str], item: CompletionItem) -> int:
    """0 of what has an expected type, 2 of what has another one, 1 of what may lead to one."""
    types = set(_types_of(place, item))
    if not expected or not types:
        return 1
    return 0 if types & expected else 2


def rank_of_class(place: Place, expected: frozenset[str], item: CompletionItem) -> int:
    """0 of a class whose objects have an expected type, 1 of another one."""
    return 0 if expected.intersection(place.schema.ancestry(item.label)) else 1


def _types_of(place: Place, item: CompletionItem) -> Iterable[str]:
    """The types of what an item names, and those that an object of it also is."""
    name, schema = item.label, place.schema
    match item.kind:
        case CompletionItemKind.EnumMember:
            value = schema.enum_values.get(name)
            return (value.enum,) if value is not None else ()
        case CompletionItemKind.Variable | CompletionItemKind.Field:
            type_ = place.type_of([name])
            if type_ is None:
                return (_TOKEN,) if place.token(name) is not None else ()
            return schema.ancestry(type_.base) if type_.kind is Kind.OBJECT else (type_.base,)
        case CompletionItemKind.Function:
            row = place.analysis.callables.functions.get(name)
            found = _OF_RESULT.get(row.result) if row is not None else None
            return (found,) if found is not None else ()
        case CompletionItemKind.Keyword:
            return (_OF_WORD[name],) if name in _OF_WORD else ()
        case _:
            return ()


def _fitting(place: Place, type_: Type) -> frozenset[str]:
    """The types of values that can be compared with one of `type_`."""
    return _NUMBERS if type_.base in _NUMBERS else frozenset((type_.base,))


def _path_before(piece: Piece, at: int) -> list[str]:
    """The path that ends right before the lexeme `at`."""
    path: list[str] = []
    index = at - 1
    while index >= 0 and piece.kinds[index] in ("IDENT", "this"):
        path.insert(0, piece.texts[index])
        if index < 2 or piece.texts[index - 1] != ".":
            break
        index -= 2
    return path


def _declared(place: Place, piece: Piece, at: int) -> Type | None:
    """The type before the name before the lexeme `at`: `Speed now = `."""
    if at < 2 or piece.kinds[at - 1] != "IDENT" or piece.kinds[at - 2] not in ("IDENT", "BASETYPE"):
        return None
    return _named(place, piece.texts[at - 2])


def _named(place: Place, name: str) -> Type | None:
    schema = place.schema
    if (typedef := schema.typedefs.get(name)) is not None:
        return typedef.type
    if name in schema.enums:
        return Type(Kind.ENUM, name, name)
    if name in schema.classes:
        return Type(Kind.OBJECT, name, name)
    return Type(Kind(name), name, name) if name in ("int", "float", "bool", "string") else None


def _of_argument(place: Place, piece: Piece, offset: int) -> frozenset[str]:
    """The types of the argument at `offset` of the call around it."""
    call = call_around(piece, offset)
    if call is None:
        return frozenset()
    name, at, count = call
    before = piece.texts[at - 1] if at else ""
    schema, callables = place.schema, place.analysis.callables
    if before == "new" and name in schema.classes:
        return _of_constructors(place, schema.classes[name].constructors, count)
    if name == "super" and place.owner in schema.classes:
        base = schema.classes.get(schema.classes[place.owner].base or "")
        return _of_constructors(place, base.constructors if base is not None else (), count)
    if before == ".":
        path = _path_before(piece, at - 1)
        type_ = place.type_of(path) if path else None
        if name == "specify" and type_ is not None:
            return _fitting(place, type_)
        rows = [row for (_, method), row in METHODS.items() if method == name]
        return _of_signature(place, rows[0].signature, count) if len(rows) == 1 else frozenset()
    row = callables.constraints.get(name) or callables.functions.get(name)
    found = _of_signature(place, row.signature, count) if row is not None else frozenset[str]()
    if row is not None and not found and count > 0:  # the same as the others
        first = _path_before(piece, piece.texts.index(",", at))
        type_ = place.type_of(first) if first else None
        return _fitting(place, type_) if type_ is not None else found
    return found


def _of_constructors(place: Place, constructors: Iterable[Constructor], count: int) -> frozenset[str]:
    types = [each.parameters[count].type for each in constructors if count < len(each.parameters)]
    found: set[str] = set()
    for type_ in types:
        found |= {"int"} if type_.base == "int" else _fitting(place, type_)
    return frozenset(found)


def _of_signature(place: Place, signature: Signature, count: int) -> frozenset[str]:
    argument = signature.argument(count)
    if argument is None:
        return frozenset()
    if argument.kind is ArgumentKind.OBJECT:
        return frozenset(place.schema.classes)
    if argument.kind is ArgumentKind.PARAMETER:
        return _NUMBERS | frozenset(place.schema.enums)
    return _OF_KIND.get(argument.kind, frozenset())
