"""A complaint about a name that nothing declares in; declarations of it, as titles and edits, out."""

from collections.abc import Iterator
from dataclasses import dataclass

from lsprotocol.types import TextEdit, WorkspaceEdit

from lsp.diagnostics import Conversion
from lsp.meaning import around_at, piece_at
from lsp.open_text import DocumentContext
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.codes import DECLARED_BELOW, UNKNOWN_NAME, UNKNOWN_TOKEN_VARIABLE, WRONG_COUNT
from nddl_lang.semantics.natives import builtin_names
from nddl_lang.semantics.schema import Kind, Predicate, Type
from nddl_lang.semantics.signature import ArgumentKind
from nddl_lang.semantics.types import comparable, reference_type
from nddl_lang.syntax.nodes import (
    Assignment,
    BinaryExpr,
    CallConstraint,
    ClassDecl,
    ConstructorDecl,
    Expr,
    Instance,
    MethodCall,
    PathExpr,
    PredicateDecl,
    RuleDecl,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.syntax.words import RESERVED
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Span

_Offer = tuple[str, WorkspaceEdit]
_MOST_ARGUMENTS = 3  # of the variables that may be meant


@dataclass(frozen=True, slots=True)
class _Complaint:
    """A complaint with what stands around its place, from the inside out."""

    view: DocumentContext
    conversion: Conversion
    span: Span
    around: tuple[object, ...]

    @property
    def analysis(self) -> Analysis:
        return self.view.snapshot.analysis

    @property
    def name(self) -> str:
        return self.span.text

    def inserted(self, span: Span, at: int, text: str) -> WorkspaceEdit:
        """The edit that puts `text` at the offset `at` of the file of `span`."""
        uri, lines = self.conversion.place(span.source)
        return WorkspaceEdit({uri: [TextEdit(lines.range(at, at), text)]})


def declarations(view: DocumentContext, diagnostic: Diagnostic, conversion: Conversion) -> Iterator[_Offer]:
    """What may be declared, or moved up, so that a complaint goes away."""
    piece = piece_at(view.parse, diagnostic.span.begin)
    around = tuple(around_at(piece, diagnostic.span.begin)) if piece is not None else ()
    complaint = _Complaint(view, conversion, diagnostic.span, around)
    if diagnostic.code is DECLARED_BELOW:
        yield from _moved_up(complaint, diagnostic)
    elif diagnostic.code is WRONG_COUNT:
        yield from _last_argument(complaint)
    elif complaint.name.isidentifier() and complaint.name not in RESERVED:
        if diagnostic.code is UNKNOWN_TOKEN_VARIABLE:
            places = [note.span for note in diagnostic.notes if note.span is not None]
            predicates = complaint.analysis.tables.declared.values()
            owner = next((each for each in predicates if isinstance(each, Predicate) and each.span in places), None)
            yield from _parameter(complaint, owner, _type_beside(complaint))
        elif diagnostic.code is UNKNOWN_NAME:
            yield from _token(complaint) if _owned(complaint) is not None else _named(complaint)


def _owned(complaint: _Complaint) -> str | None:
    """The variable that is looked for in what the name stands for, as in `name.start`."""
    path = next((node for node in complaint.around if isinstance(node, PathExpr)), None)
    if path is None or len(path.parts) < 2 or path.parts[0].span.begin != complaint.span.begin:
        return None
    return path.parts[1].name


def _token(complaint: _Complaint) -> Iterator[_Offer]:
    """The name for a token of the same rule that has none yet, and has the variable that is looked for."""
    rule = next((node for node in complaint.around if isinstance(node, RuleDecl)), None)
    wanted = _owned(complaint)
    for node in descendants(rule) if rule is not None and wanted is not None else ():
        target = complaint.analysis.tables.targets.get(node) if isinstance(node, Instance) else None
        if not isinstance(node, Instance) or node.name is not None or target is None:
            continue
        predicate = target.predicate
        if wanted in (*builtin_names(predicate.is_event), *(each.name for each in predicate.parameters)):
            edit = complaint.inserted(node.path.span, node.path.span.finish, f" {complaint.name}")
            yield f"name the token of `{node.path.span.text}` `{complaint.name}`", edit


def _named(complaint: _Complaint) -> Iterator[_Offer]:
    """A value of an enum, a member, a parameter or a global variable, by what the name is compared with."""
    type_ = _type_beside(complaint)
    if type_ is None:
        return
    constructor = next((node for node in complaint.around if isinstance(node, ConstructorDecl)), None)
    if constructor is not None:
        yield from _member(complaint, constructor, type_)
        return
    if type_.kind is Kind.ENUM:
        yield from _value(complaint, type_)
    rule = next((node for node in complaint.around if isinstance(node, RuleDecl)), None)
    offers = [*_global(complaint, type_)]
    if rule is not None:
        offers += _parameter(complaint, complaint.analysis.tables.predicates.get(rule), type_)
    yield from offers if complaint.name.isupper() else reversed(offers)


def _value(complaint: _Complaint, type_: Type) -> Iterator[_Offer]:
    enum = complaint.analysis.schema.enums.get(type_.base)
    if enum is not None and enum.node is not None and enum.node.values:
        last = enum.node.values[-1].span
        edit = complaint.inserted(last, last.finish, f", {complaint.name}")
        yield f"add `{complaint.name}` to `enum {enum.name}`", edit


def _global(complaint: _Complaint, type_: Type) -> Iterator[_Offer]:
    statement = complaint.around[-1] if complaint.around else None
    span = getattr(statement, "span", None)
    if isinstance(span, Span) and type_.kind is not Kind.OBJECT:
        declared = f"{type_.name} {complaint.name};"
        yield f"declare `{declared}`", complaint.inserted(span, _line_start(span), f"{declared}\n")


def _member(complaint: _Complaint, constructor: ConstructorDecl, type_: Type) -> Iterator[_Offer]:
    """A member declared above the constructor that assigns it."""
    owner = next((node for node in complaint.around if isinstance(node, ClassDecl)), None)
    assigned = next((node for node in complaint.around if isinstance(node, Assignment)), None)
    if owner is None or assigned is None or assigned.target.span.begin != complaint.span.begin:
        return
    declared = f"{type_.name} {complaint.name};"
    edit = _before(complaint, constructor.span, declared)
    yield f"add `{declared}` to class `{owner.name.name}`", edit


def _parameter(complaint: _Complaint, predicate: Predicate | None, type_: Type | None) -> Iterator[_Offer]:
    if predicate is None or type_ is None or not predicate.nodes:
        return
    node = next((node for node in predicate.nodes if isinstance(node, PredicateDecl)), None)
    if node is None:
        return
    declared = f"{type_.name} {complaint.name};"
    text = node.span.source.text
    brace = text.rfind("}", node.span.begin, node.span.finish)
    if brace < 0:
        return
    line = text.rfind("\n", 0, brace) + 1
    if not text[line:brace].strip() and node.body:
        edit = complaint.inserted(node.span, line, f"{indent_of(node.body[-1].span)}{declared}\n")
    else:
        blank = "" if text[brace - 1] == " " else " "
        edit = complaint.inserted(node.span, brace, f"{blank}{declared} ")
    yield f"add parameter `{declared}` to `{predicate.full_name}`", edit


def _moved_up(complaint: _Complaint, diagnostic: Diagnostic) -> Iterator[_Offer]:
    """The declaration, which stands below in the same text, above the statement that uses it."""
    place = next((note.span for note in diagnostic.notes if note.span is not None), None)
    source = complaint.view.parse.source
    if place is None or place.source is not source or not complaint.around:
        return
    statements = complaint.view.parse.module.statements
    scopes = [node for node in complaint.around if isinstance(node, RuleDecl | ClassDecl)]
    for inside in (
        statements,
        *(getattr(each, "body", None) or getattr(each, "members", None) or () for each in scopes),
    ):
        moved = next((each for each in inside if _holds(each.span, place)), None)
        used = next((each for each in inside if _holds(each.span, complaint.span)), None)
        if moved is None or used is None or moved is used:
            continue
        text = source.text
        begin, finish = _line_start(moved.span), text.find("\n", moved.span.finish) + 1 or len(text)
        if text[begin : moved.span.begin].strip() or text[moved.span.finish : finish].strip():
            return
        at = _line_start(used.span)
        uri, lines = complaint.conversion.place(source)
        written = text[begin:finish] if text[begin:finish].endswith("\n") else f"{text[begin:finish]}\n"
        edits = [TextEdit(lines.range(at, at), written), TextEdit(lines.range(begin, finish), "")]
        yield f"move `{complaint.name}` up, above its use", WorkspaceEdit({uri: edits})
        return


def _holds(outer: Span, inner: Span) -> bool:
    return outer.begin <= inner.begin and inner.finish <= outer.finish


def _last_argument(complaint: _Complaint) -> Iterator[_Offer]:
    """Variables that may be the last argument of a constraint, which lacks just that."""
    call = next((node for node in complaint.around if isinstance(node, CallConstraint)), None)
    rule = next((node for node in complaint.around if isinstance(node, RuleDecl)), None)
    row = complaint.analysis.callables.constraints.get(call.name.name) if call is not None else None
    if call is None or row is None or not call.arguments or len(call.arguments) + 1 != row.signature.minimum:
        return
    wanted = row.signature.argument(len(call.arguments))
    type_ = _type_of(complaint, call.arguments[0])
    if wanted is None or wanted.kind is not ArgumentKind.SAME or type_ is None:
        return
    named = {argument.span.text for argument in call.arguments}
    predicate = complaint.analysis.tables.predicates.get(rule) if rule is not None else None
    known = [*(predicate.parameters if predicate is not None else ()), *complaint.analysis.schema.globals.values()]
    schema = complaint.analysis.schema
    fitting = [
        variable.name
        for variable in known
        if variable.name not in named and variable.type and comparable(variable.type, type_, schema.is_subclass)
    ]
    last = call.arguments[-1].span
    for name in fitting[:_MOST_ARGUMENTS]:
        edit = complaint.inserted(last, last.finish, f", {name}")
        yield f"write `{call.name.name}({', '.join([*(each.span.text for each in call.arguments), name])})`", edit


def _type_beside(complaint: _Complaint) -> Type | None:
    """The type of what the name is compared with, given to, or put beside."""
    for node in complaint.around:
        match node:
            case BinaryExpr(left=left, right=right):
                return _type_of(complaint, right if _holds(left.span, complaint.span) else left)
            case Assignment(target=target, value=value):
                return _type_of(complaint, value if _holds(target.span, complaint.span) else target)
            case CallConstraint(arguments=arguments):
                others = [each for each in arguments if not _holds(each.span, complaint.span)]
                return next((type_ for each in others if (type_ := _type_of(complaint, each)) is not None), None)
            case MethodCall(target=target):
                return _type_of(complaint, target)
            case _:
                pass
    return None


def _type_of(complaint: _Complaint, expression: Expr) -> Type | None:
    """The type of an expression, as far as it was understood."""
    tables = complaint.analysis.tables
    reference = tables.references.get(expression) if isinstance(expression, PathExpr) else None
    return reference_type(reference, None) if reference is not None else tables.types.get(expression)


def _before(complaint: _Complaint, span: Span, declared: str) -> WorkspaceEdit:
    """The edit that declares something above what begins at `span`, in a line of its own where that begins one."""
    start = _line_start(span)
    is_own_line = not span.source.text[start : span.begin].strip()
    written = f"{indent_of(span)}{declared}\n" if is_own_line else f"{declared} "
    return complaint.inserted(span, start if is_own_line else span.begin, written)


def _line_start(span: Span) -> int:
    return span.source.text.rfind("\n", 0, span.begin) + 1


def indent_of(span: Span) -> str:
    """The blanks before what begins at `span`."""
    line = span.source.text[_line_start(span) : span.begin]
    return line[: len(line) - len(line.lstrip(" \t"))]
