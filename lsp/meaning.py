"""A place in a text in; what stands there, and what it means, out."""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from nddl_lang.analysis import Analysis
from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.semantics.functions import FUNCTIONS, METHODS, FunctionRow, MethodRow, Receiver
from nddl_lang.semantics.relations import RELATIONS, RelationRow
from nddl_lang.semantics.schema import (
    Class,
    ClassReference,
    Constructor,
    Enumeration,
    EnumValue,
    GlobalReference,
    Label,
    LocalReference,
    MemberReference,
    Predicate,
    Reference,
    TokenReference,
    TokenVariableReference,
    Type,
    Typedef,
    Variable,
)
from nddl_lang.semantics.types import BASIC_TYPES
from nddl_lang.syntax.nodes import (
    CallConstraint,
    CallExpr,
    Identifier,
    Include,
    Instance,
    MethodCall,
    NewExpr,
    PathExpr,
    Relation,
    RuleDecl,
    StringLiteral,
)
from nddl_lang.syntax.parser import Parse
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.walk import children
from nddl_lang.text.source import Source


@dataclass(frozen=True, slots=True)
class Word:
    """A word of the language itself."""

    text: str


Thing = (
    Class
    | Constructor
    | Predicate
    | Enumeration
    | EnumValue
    | Typedef
    | Type
    | Variable
    | TokenVariableReference
    | Label
    | RelationRow
    | ConstraintRow
    | FunctionRow
    | MethodRow
    | Source
    | Word
)


@dataclass(frozen=True, eq=False, slots=True)
class Meaning:
    """What stands from `begin` to `finish`; `around` are the nodes that it is part of, the nearest first."""

    thing: Thing
    begin: int
    finish: int
    around: tuple[Any, ...]


def meaning_at(analysis: Analysis, parse: Parse, offset: int) -> Meaning | None:
    """What stands at `offset`, or ends there; None where nothing has a meaning."""
    piece = piece_at(parse, offset)
    if piece is None:
        return None
    around = around_at(piece, offset)
    thing = _thing(analysis, around) if around else None
    if thing is not None:
        span = around[0].span
        return Meaning(thing, span.begin, span.finish, around[1:])
    lexeme = _lexeme_at(piece, offset)
    if lexeme is None:
        return None
    begin, finish, text = lexeme
    thing = _by_word(analysis, text)
    return Meaning(thing, begin, finish, around) if thing is not None else None


def piece_at(parse: Parse, offset: int) -> Piece | None:
    """The top-level statement, with the blanks before it, that `offset` stands in, or at the end of."""
    index = bisect_right(parse.pieces, offset, key=lambda piece: piece.anchor.offset) - 1
    if index < 0:
        return None
    if index > 0 and parse.pieces[index].anchor.offset == offset and _lexeme_at(parse.pieces[index], offset) is None:
        index -= 1
    return parse.pieces[index]


def around_at(piece: Piece, offset: int) -> tuple[Any, ...]:
    """The nodes that `offset` stands in, the innermost first."""
    at = offset - piece.anchor.offset
    found: list[Any] = []
    nodes: Iterator[Any] = iter(piece.statements)
    while (node := _containing(nodes, at)) is not None:
        found.append(node)
        nodes = children(node)
    return tuple(reversed(found))


def _containing(nodes: Iterator[Any], at: int) -> Any:
    touching = None
    for node in nodes:
        if node.span.start <= at < node.span.end:
            return node
        if at == node.span.end:
            touching = node
    return touching


def _lexeme_at(piece: Piece, offset: int) -> tuple[int, int, str] | None:
    """Begin, end and text of the lexeme that `offset` stands in, or at the end of."""
    base = piece.anchor.offset
    index = bisect_right(piece.starts, offset - base) - 1
    if index < 0 or offset - base > piece.ends[index]:
        return None
    if offset - base == piece.ends[index] and not _is_word(piece.texts[index]):
        return None
    return piece.starts[index] + base, piece.ends[index] + base, piece.texts[index]


def _is_word(text: str) -> bool:
    return text[-1:].isalnum() or text[-1:] in ("_", "$")


def _thing(analysis: Analysis, around: tuple[Any, ...]) -> Thing | None:
    """What the innermost node means."""
    node, *outer = around
    parent = outer[0] if outer else None
    match node, parent:
        case StringLiteral(), Include():
            return analysis.loaded.included.get(parent)
        case Identifier(name=name), Relation(relation=relation) if node is relation:
            return RELATIONS.get(name)
        case Identifier(name=name), CallConstraint(name=constraint) if node is constraint:
            rows = analysis.callables.constraints
            return FUNCTIONS[name] if name == "sampledParameter" else rows.get(name)
        case Identifier(name=name), CallExpr(function=function) if node is function:
            return analysis.callables.functions.get(name)
        case Identifier(), MethodCall(method=method) if node is method:
            return _method(analysis, parent)
        case Identifier(), NewExpr(class_name=class_name) if node is class_name and parent is not None:
            chosen = analysis.tables.constructors.get(parent)
            return chosen.constructor if chosen is not None else _named(analysis, node)
        case Identifier(), PathExpr():
            return _part(analysis, node, parent, outer[1] if len(outer) > 1 else None)
        case Identifier(), RuleDecl(predicate=predicate) if node is predicate and isinstance(parent, RuleDecl):
            return analysis.tables.predicates.get(parent)
        case Identifier(), _:
            return _named(analysis, node)
        case _:
            return None


def _named(analysis: Analysis, name: Identifier) -> Thing | None:
    tables = analysis.tables
    declared = tables.declared.get(name)
    if declared is not None:
        assert isinstance(
            declared, Class | Constructor | Predicate | Enumeration | EnumValue | Typedef | Variable | Label
        )
        return declared
    if (type_ := tables.type_names.get(name)) is not None:
        return _of_type(analysis, type_)
    if (reference := tables.references.get(name)) is not None:
        return _referred(analysis, reference)
    return _by_word(analysis, name.name)


def _part(analysis: Analysis, part: Identifier, path: PathExpr, owner: Any) -> Thing | None:
    """What one part of a path means."""
    if isinstance(owner, Instance) and owner.path is path and part is path.parts[-1]:
        target = analysis.tables.targets.get(owner)
        return target.predicate if target is not None else None
    reference = analysis.tables.references.get(part)
    if reference is None and len(path.parts) == 1:
        reference = analysis.tables.references.get(path)
    if reference is not None:
        return _referred(analysis, reference)
    whole = analysis.tables.references.get(path)
    if isinstance(whole, EnumValue):
        return whole if part is path.parts[-1] else analysis.schema.enums.get(whole.enum)
    return _by_word(analysis, part.name) if part is path.parts[0] else None


def _referred(analysis: Analysis, reference: Reference) -> Thing | None:
    """What a reference leads to."""
    match reference:
        case EnumValue() | TokenVariableReference():
            return reference
        case GlobalReference(variable=variable) | LocalReference(variable=variable):
            return variable
        case ClassReference(name=name):
            return analysis.schema.classes.get(name)
        case TokenReference(label=label):
            return label
        case MemberReference(members=members):
            return members[-1] if members else Word("this")


def _of_type(analysis: Analysis, type_: Type) -> Thing:
    schema = analysis.schema
    found = schema.typedefs.get(type_.name) or schema.enums.get(type_.name) or schema.classes.get(type_.name)
    return found if found is not None else type_


def _method(analysis: Analysis, call: MethodCall) -> Thing | None:
    name = call.method.name
    reference = analysis.tables.references.get(call.target)
    match reference:
        case None:
            order = list(Receiver) if call.target.parts else [Receiver.NOTHING]
        case ClassReference():
            order = [Receiver.CLASS]
        case TokenReference():
            order = [Receiver.TOKEN, Receiver.VARIABLE]
        case _:
            order = [Receiver.VARIABLE, Receiver.OBJECT]
    return next((METHODS[receiver, name] for receiver in order if (receiver, name) in METHODS), None)


def _by_word(analysis: Analysis, word: str) -> Thing | None:
    """What a word means by itself: where text was not understood, a good guess."""
    schema = analysis.schema
    return (
        schema.enum_values.get(word)
        or schema.globals.get(word)
        or schema.goals.get(word)
        or schema.classes.get(word)
        or schema.enums.get(word)
        or schema.typedefs.get(word)
        or RELATIONS.get(word)
        or BASIC_TYPES.get(word)
        or (Word(word) if word in WORDS else None)
        or (FUNCTIONS[word] if word == "sampledParameter" else None)
        or analysis.callables.constraints.get(word)
        or analysis.callables.functions.get(word)
    )


WORDS = {
    "action": "Declares an action of a class: a predicate whose rules may name conditions and effects.",
    "class": "Declares a class of objects: members, constructors and predicates.",
    "close": "From here on no further object joins, or no further value joins the domain.",
    "condition": "The token is a condition of the action.",
    "duration": "How many ticks a token lasts: `end == start + duration`, at least 1.",
    "effect": "The token is an effect of the action.",
    "else": "What holds where the guard is known to be false.",
    "end": "The tick at which a token ends; it no longer holds then.",
    "enforce": "Demands the constraint although it could be read as a test.",
    "enum": "Declares a type with the values that are listed.",
    "extends": "The class inherits members and predicates of its base.",
    "fact": "A token that is given as true; it is in the plan from the start.",
    "filter": "Has no effect.",
    "foreach": "Repeats its block for each object that the variable may be.",
    "goal": "A token that the plan must achieve.",
    "if": "Guards a part of a rule: it takes effect once the condition is known to be true.",
    "in": "Restricts a variable to a domain.",
    "inf": "A whole number without bound.",
    "inff": "A real number without bound.",
    "new": "Creates an object of a class.",
    "object": "The object that a token belongs to; on a timeline its tokens never overlap.",
    "predicate": "Declares what may hold of the objects of a class, with its parameters.",
    "rejectable": "A token that the plan may achieve or reject.",
    "start": "The tick at which a token begins to hold.",
    "state": "Whether the token is inactive, active, merged or rejected.",
    "super": "Calls a constructor of the base class.",
    "this": "In a rule or predicate the token itself, in a constructor the object.",
    "time": "The tick at which an event takes place.",
    "typedef": "Names a type with a restricted domain.",
    "#include": "Reads another file here, once.",
}
