"""Know the basic types, and say which values fit where and which can be compared."""

from collections.abc import Callable

from nddl_lang.semantics.schema import (
    ClassReference,
    EnumValue,
    GlobalReference,
    Kind,
    LocalReference,
    MemberReference,
    Reference,
    TokenReference,
    TokenVariableReference,
    Type,
)

INT = Type(Kind.INT, "int", "int")
FLOAT = Type(Kind.FLOAT, "float", "float")
BOOL = Type(Kind.BOOL, "bool", "bool")
STRING = Type(Kind.STRING, "string", "string")
_SYMBOL = Type(Kind.SYMBOL, "symbol", "symbol")
BASIC_TYPES: dict[str, Type] = {type_.name: type_ for type_ in (INT, FLOAT, BOOL, STRING, _SYMBOL)}

TOKEN_STATES = "TokenStates"
STATE = Type(Kind.ENUM, TOKEN_STATES, TOKEN_STATES)

NUMBERS = frozenset({Kind.INT, Kind.FLOAT})
COUNTABLE = frozenset({Kind.INT, Kind.FLOAT, Kind.BOOL})

IsSubclass = Callable[[str, str], bool]


def object_type(class_name: str) -> Type:
    """The type of the objects of a class."""
    return Type(Kind.OBJECT, class_name, class_name)


def enum_type(enum: str) -> Type:
    """The type of the values of an enum."""
    return Type(Kind.ENUM, enum, enum)


def reference_type(reference: Reference, own_class: str | None) -> Type | None:
    """The type of what a name refers to, None for a class; `own_class` is that of a constructor's own object."""
    if isinstance(reference, GlobalReference | LocalReference):
        return reference.variable.type
    if isinstance(reference, TokenVariableReference):
        return reference.type
    if isinstance(reference, EnumValue):
        return enum_type(reference.enum)
    if isinstance(reference, TokenReference):
        return STATE
    if isinstance(reference, MemberReference):
        if reference.members:
            return reference.members[-1].type
        return object_type(own_class) if own_class is not None else None
    assert isinstance(reference, ClassReference)
    return None


def fits(value: Type, target: Type, is_subclass: IsSubclass) -> bool:
    """Whether a variable of type `target` may hold what a variable of type `value` holds.

    A variable of an ancestor class may happen to hold the right object.
    """
    match target.kind:
        case Kind.INT:
            return value.kind is Kind.INT
        case Kind.FLOAT:
            return value.kind in NUMBERS
        case Kind.BOOL:
            return value.kind is Kind.BOOL
        case Kind.STRING:
            return value.kind in (Kind.STRING, Kind.SYMBOL)
        case Kind.SYMBOL:
            return value.kind in (Kind.STRING, Kind.SYMBOL, Kind.ENUM)
        case Kind.ENUM:
            return value.kind is Kind.SYMBOL or (value.kind is Kind.ENUM and value.base == target.base)
        case Kind.OBJECT:
            return value.kind is Kind.OBJECT and _related(value.base, target.base, is_subclass)


def _related(one: str, other: str, is_subclass: IsSubclass) -> bool:
    """Whether an object can belong to both classes."""
    return one == other or is_subclass(one, other) or is_subclass(other, one)


def comparable(one: Type, other: Type, is_subclass: IsSubclass) -> bool:
    """Whether values of the two types can be equal."""
    if one.kind in COUNTABLE:
        return other.kind in COUNTABLE
    return fits(one, other, is_subclass) or fits(other, one, is_subclass)


def always_differ(one: Type, other: Type) -> bool:
    """Whether values of two types that are not comparable can at least be told to differ: two enums, two classes."""
    return one.kind is other.kind and one.kind in (Kind.ENUM, Kind.OBJECT)


def phrase(type_: Type) -> str:
    """A type as it completes `x is ...`: an int, a Color, an object of class `A`."""
    if type_.kind is Kind.OBJECT:
        return f"an object of class `{type_.base}`"
    if type_.kind is Kind.ENUM and type_.base == TOKEN_STATES:
        return "the state of a token"
    article = "an" if type_.name[:1].lower() in "aeiou" else "a"
    return f"{article} `{type_.name}`"


def plain(type_: Type) -> Type:
    """The type without the restriction of a typedef."""
    if type_.restriction is None and type_.name == type_.base:
        return type_
    return Type(type_.kind, type_.base, type_.base)
