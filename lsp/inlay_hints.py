"""Inlay hints: a part of a text in; what its words leave unsaid, to be shown between them, out."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from lsprotocol.types import InlayHint, InlayHintKind, Range

from lsp.open_text import DocumentContext
from lsp.relation_demands import demanded
from lsp.uses import constants
from nddl_lang.semantics import domains
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.semantics.schema import Constructor, GlobalReference, Variable
from nddl_lang.syntax.nodes import (
    Expr,
    FloatLiteral,
    Instance,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    Relation,
    RuleDecl,
    UnaryExpr,
    VariableDecl,
)
from nddl_lang.syntax.walk import descendants


@dataclass(frozen=True, slots=True)
class HintSettings:
    """Which hints the user wants."""

    relations: bool = True
    domains: bool = True
    tokens: bool = True
    constants: bool = True
    arguments: bool = True


def inlay_hints(view: DocumentContext, place: Range, settings: HintSettings) -> list[InlayHint]:
    """The hints inside `place`."""
    lines = view.document.lines
    begin, finish = lines.offset(place.start), lines.offset(place.end)
    found: list[_Hint] = []
    given = constants(view.snapshot.analysis) if settings.constants else {}
    for piece in view.parse.pieces:
        if piece.anchor.offset + piece.length <= begin or piece.anchor.offset >= finish:
            continue
        for statement in piece.statements:
            in_rule = given if isinstance(statement, RuleDecl) else None
            for node in descendants(statement):
                found += _hints(view, node, settings, in_rule)
    found.sort(key=lambda each: each[0])
    return [
        InlayHint(
            lines.position(offset),
            text,
            InlayHintKind.Parameter if is_name else InlayHintKind.Type,
            padding_left=not is_name,
            padding_right=is_name,
        )
        for offset, text, is_name in found
        if begin <= offset <= finish
    ]


_Hint = tuple[int, str, bool]


def _hints(
    view: DocumentContext, node: object, settings: HintSettings, given: Mapping[Variable, Expr] | None
) -> Iterator[_Hint]:
    """Where in the text, what to show, and whether it names what follows; in a rule also what is `given` to names."""
    analysis = view.snapshot.analysis
    match node:
        case Relation() if settings.relations and (row := RELATIONS.get(node.relation.name)) is not None:
            texts = [line for _, lines in demanded(analysis, row, node) for line in lines]
            if texts:
                yield node.span.finish, "// " + ", ".join(texts), False
        case Instance(name=None, path=path) if settings.tokens and len(path.parts) == 1:
            if (target := analysis.tables.targets.get(node)) is not None:
                yield path.span.begin, f"{target.predicate.class_name}.", True
        case VariableDecl(declarators=declarators) if settings.domains:
            for declarator in declarators:
                variable = analysis.tables.locals.get(declarator)
                if isinstance(variable, Variable) and variable.type.name != variable.type.base:
                    if variable.type.restriction is not None and declarator.initialiser is None:
                        yield declarator.name.span.finish, f"∈ {domains.text(variable.type.restriction)}", False
        case PathExpr() if settings.constants and given is not None:
            match analysis.tables.references.get(node):
                case GlobalReference(variable=variable) if (
                    value := _constant(variable.initialiser or given.get(variable))
                ) is not None:
                    yield node.span.finish, f"= {value}", False
        case NewExpr(arguments=arguments) if settings.arguments:
            chosen = analysis.tables.constructors.get(node)
            if chosen is not None:
                yield from _arguments(chosen.constructor, [argument.span.begin for argument in arguments])
        case _:
            pass


def _arguments(constructor: Constructor, begins: list[int]) -> Iterator[_Hint]:
    for begin, parameter in zip(begins, constructor.parameters, strict=False):
        yield begin, f"{parameter.name}:", True


def _constant(value: Expr | None) -> str | None:
    """The number or range that a global variable is given."""
    match value:
        case IntLiteral() | FloatLiteral() | IntervalExpr() | UnaryExpr():
            return value.span.text
        case _:
            return None
