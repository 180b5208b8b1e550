"""A place in, what the editor shows beside it out."""

from collections.abc import Iterable, Iterator
from typing import assert_never

from lsprotocol.types import Hover, MarkupContent, MarkupKind, Position

from lsp.describe import Describer
from lsp.diagnostics import Conversion
from lsp.known_domain import known_domain
from lsp.meaning import WORDS, Meaning, Word, meaning_at
from lsp.open_text import DocumentContext
from lsp.relation_demands import demanded
from lsp.rows import (
    constraint_text,
    demands,
    fenced,
    function_text,
    method_text,
    points_of,
    relation_head,
    relation_tail,
)
from nddl_lang.analysis import Analysis
from nddl_lang.semantics import domains
from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.semantics.functions import FunctionRow, MethodRow
from nddl_lang.semantics.relations import RelationRow
from nddl_lang.semantics.schema import (
    Class,
    Constructor,
    Enumeration,
    EnumValue,
    GlobalReference,
    Label,
    Predicate,
    TokenVariableReference,
    Type,
    Typedef,
    Variable,
)
from nddl_lang.syntax.nodes import CallConstraint, CallExpr, Relation
from nddl_lang.text.source import Source, Span


def hover_at(view: DocumentContext, position: Position, conversion: Conversion) -> Hover | None:
    """What to show at `position`; None where nothing has a meaning."""
    lines = view.document.lines
    meaning = meaning_at(view.snapshot.analysis, view.parse, lines.offset(position))
    if meaning is None:
        return None
    parts = [part for part in _describe(view.snapshot.analysis, meaning, conversion) if part]
    if not parts:
        return None
    content = MarkupContent(MarkupKind.Markdown, "\n\n".join(parts))
    return Hover(content, lines.range(meaning.begin, meaning.finish))


def _describe(analysis: Analysis, meaning: Meaning, conversion: Conversion) -> Iterable[str]:
    """The paragraphs about what stands at a place."""
    describer = Describer(analysis, lambda span: link(conversion, span))
    match meaning.thing:
        case Class() as owner:
            return describer.class_(owner)
        case Constructor() as constructor:
            return describer.constructor(constructor)
        case Predicate() as predicate:
            return describer.predicate(predicate)
        case Enumeration() as enum:
            return describer.enumeration(enum)
        case EnumValue() as value:
            return describer.enum_value(value)
        case Typedef() as typedef:
            return describer.typedef(typedef)
        case Type() as type_:
            return describer.basic(type_)
        case Variable() as variable:
            return [*describer.variable(variable), *_left(analysis, variable, meaning)]
        case TokenVariableReference() as variable:
            return [*describer.token_variable(variable), *_left(analysis, variable, meaning)]
        case Label() as label:
            return describer.label(label)
        case RelationRow() as row:
            return _relation(analysis, row, meaning)
        case ConstraintRow() as row:
            return constraint_text(row)
        case FunctionRow() as row:
            return [*function_text(row), *_drawn(analysis, describer, meaning)]
        case MethodRow() as row:
            return method_text(row)
        case Source(name=name):
            return [f"`{name}`"]
        case Word(text=text):
            return [fenced(text), WORDS.get(text, "")]
        case _:
            assert_never(meaning.thing)


def _left(analysis: Analysis, variable: Variable | TokenVariableReference, meaning: Meaning) -> Iterator[str]:
    """What the rule leaves of a domain at this place."""
    domain = known_domain(analysis, variable, meaning.around)
    if domain is not None:
        yield f"Left here by the comparisons of this rule: `{domains.text(domain)}`."


def _drawn(analysis: Analysis, describer: Describer, meaning: Meaning) -> Iterable[str]:
    """Of a call of `sampledParameter` the parameter that it draws."""
    call = meaning.around[0] if meaning.around else None
    reference = analysis.tables.sampled.get(call) if isinstance(call, CallExpr | CallConstraint) else None
    match reference:
        case GlobalReference(variable=variable):
            return describer.variable(variable)
        case EnumValue():
            return describer.enum_value(reference)
        case _:
            return ()


def _relation(analysis: Analysis, row: RelationRow, meaning: Meaning) -> Iterator[str]:
    """A relation: what it means, and what it demands of these very tokens."""
    yield from relation_head(row)
    node = meaning.around[0] if meaning.around else None
    if not row.distances:
        pass
    elif isinstance(node, Relation) and (pairs := list(demanded(analysis, row, node))):
        for title, lines in pairs:
            yield f"Here, for {title}:"
            yield fenced("\n".join(lines))
    else:
        durations = ("origin.duration", "target.duration")
        yield fenced("\n".join(demands(row, points_of("origin.", "target."), durations)))
    yield from relation_tail(row)


def link(conversion: Conversion, span: Span) -> str:
    """A place as a Markdown link."""
    uri = conversion.place(span.source)[0]
    name = uri.rpartition("/")[2] or uri
    return f"[{name}:{span.line}]({uri}#L{span.line})"
