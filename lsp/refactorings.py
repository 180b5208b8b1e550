"""Refactorings: a selection in; what may be written in its place, declared or included, as code actions, out."""

import os
import re
from collections.abc import Container, Iterable, Iterator
from itertools import count
from pathlib import Path

from lsprotocol.types import CodeAction, CodeActionKind, Range, TextEdit, WorkspaceEdit

from lsp.declarations import declarations, indent_of
from lsp.diagnostics import Conversion
from lsp.documents import Documents
from lsp.meaning import around_at, piece_at
from lsp.occurrences import symbol_of_predicate
from lsp.open_text import DocumentContext
from lsp.references import models_sharing
from lsp.roots import models_below
from lsp.uris import key_of
from nddl_lang.semantics.codes import UNKNOWN_CLASS, UNKNOWN_NAME, UNKNOWN_PREDICATE, UNKNOWN_TYPE
from nddl_lang.semantics.schema import Class, Predicate
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import ClassDecl, FloatLiteral, Include, IntLiteral, PredicateDecl, RuleDecl, UnaryExpr
from nddl_lang.syntax.words import RESERVED
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_text

_MISSING = (UNKNOWN_CLASS, UNKNOWN_TYPE, UNKNOWN_NAME)
_SCRIPT = re.compile(r"^[ \t]*(?:goal|fact|rejectable)\s*\(|^[ \t]*(?:\w+\s*\.\s*)?close\s*\(\s*\)", re.MULTILINE)
_DECLARED = r"^[ \t]*(?:class|enum|typedef\b.*?|[A-Za-z_]\w*)\s+{name}\b"


def refactorings(documents: Documents, view: DocumentContext, place: Range) -> list[CodeAction]:
    """What may be done at `place` beside mending what is wrong there."""
    lines = view.document.lines
    begin, finish = lines.offset(place.start), lines.offset(place.end)
    return [*_extractions(view, begin, finish), *_missing_rule(documents, view, begin)]


def additions(
    view: DocumentContext, diagnostic: Diagnostic, folders: Iterable[Path], conversion: Conversion
) -> Iterator[tuple[str, WorkspaceEdit]]:
    """What may be declared or included so that a complaint goes away: titles and edits."""
    if diagnostic.code is UNKNOWN_PREDICATE:
        yield from _missing_predicate(view, diagnostic, conversion)
    elif diagnostic.code in _MISSING:
        offered = {edit.text for fix in diagnostic.fixes for edit in fix.edits}
        yield from _missing_includes(view, diagnostic.span.text, folders, offered)
    yield from declarations(view, diagnostic, conversion)


# ---- a number becomes a constant or a parameter ----


def _extractions(view: DocumentContext, begin: int, finish: int) -> Iterator[CodeAction]:
    piece = piece_at(view.parse, begin)
    around = around_at(piece, begin) if piece is not None else ()
    if piece is None or not any(isinstance(node, RuleDecl) for node in around):
        return
    number = next((node for node in around if isinstance(node, IntLiteral | FloatLiteral)), None)
    if number is None or finish > number.span.finish:
        return
    outer = around[around.index(number) + 1] if around.index(number) + 1 < len(around) else None
    node = outer if isinstance(outer, UnaryExpr) and outer.op == "-" else number
    type_ = "int" if isinstance(number, IntLiteral) else "float"
    if not number.span.text[:1].isdigit() and not number.span.text.startswith("."):
        return  # inf
    text = node.span.text
    yield _extraction(view, piece.statements[0].span.begin, node, f"{type_} {{name}} = {text};\n", "{name}", "CONSTANT")
    if view.snapshot.analysis.dialect is Dialect.NDDLC:
        declared = f"{type_} {{name}} = [{text} {text}];\n"
        yield _extraction(view, piece.statements[0].span.begin, node, declared, "sampledParameter({name})", "PARAMETER")


def _extraction(view: DocumentContext, at: int, node: object, declared: str, used: str, stem: str) -> CodeAction:
    span = getattr(node, "span")  # noqa: B009  (any expression has one)
    lines = view.document.lines
    name = _fresh(view, stem)
    edits = [
        TextEdit(lines.range(at, at), declared.format(name=name)),
        TextEdit(lines.range(span.begin, span.finish), used.format(name=name)),
    ]
    what = "a constant" if stem == "CONSTANT" else "a sampled parameter"
    return CodeAction(
        f"make `{span.text}` {what}",
        CodeActionKind.RefactorExtract,
        edit=WorkspaceEdit({view.document.uri: edits}),
    )


def _fresh(view: DocumentContext, stem: str) -> str:
    """A name that no text of the model has yet."""
    known = {symbol.name for symbol in view.snapshot.names.all}
    return next(name for number in count(1) if (name := stem if number == 1 else f"{stem}_{number}") not in known)


# ---- what is missing is written ----


def _missing_rule(documents: Documents, view: DocumentContext, offset: int) -> Iterator[CodeAction]:
    piece = piece_at(view.parse, offset)
    around = around_at(piece, offset) if piece is not None else ()
    node = next((each for each in around if isinstance(each, PredicateDecl)), None)
    owner = next((each for each in around if isinstance(each, ClassDecl)), None)
    analysis = view.snapshot.analysis
    if node is None or owner is None:
        return
    predicate = analysis.tables.declared.get(node.name)
    if not isinstance(predicate, Predicate) or any(
        each.class_name == predicate.class_name and each.name == predicate.name
        for model in models_sharing(documents, view.snapshot, symbol_of_predicate(predicate))
        for each in model.analysis.tables.predicates.values()
    ):
        return
    at = owner.span.finish
    text = view.parse.source.text
    after = text.find("\n", at)
    at = after if after >= 0 and not text[at:after].strip(" \t\r;") else at
    edit = TextEdit(view.document.lines.range(at, at), f"\n\n{owner.name.name}::{node.name.name} {{\n}}")
    yield CodeAction(
        f"add a rule on `{owner.name.name}::{node.name.name}`",
        CodeActionKind.Refactor,
        edit=WorkspaceEdit({view.document.uri: [edit]}),
    )


def _missing_predicate(
    view: DocumentContext, diagnostic: Diagnostic, conversion: Conversion
) -> Iterator[tuple[str, WorkspaceEdit]]:
    """Declare the predicate in the class that the complaint leads to."""
    schema = view.snapshot.analysis.schema
    places = [note.span for note in diagnostic.notes if note.span is not None]
    owner = next((each for each in schema.classes.values() if places and each.span == places[0]), None)
    if not isinstance(owner, Class) or owner.node is None or owner.node.members is None:
        return
    span = owner.node.span
    text = span.source.text
    brace = text.rfind("}", span.begin, span.finish)
    if brace < 0:
        return
    name = diagnostic.span.text
    if name in RESERVED:
        return
    is_own_line = not text[text.rfind("\n", 0, brace) + 1 : brace].strip()
    at = text.rfind("\n", 0, brace) + 1 if is_own_line else brace
    indent = indent_of(owner.node.members[-1].span) if owner.node.members else "    "
    written = f"{indent}predicate {name} {{ }}\n" if is_own_line else f"predicate {name} {{ }} "
    uri, lines = conversion.place(span.source)
    yield (
        f"add `predicate {name}` to class `{owner.name}`",
        WorkspaceEdit({uri: [TextEdit(lines.range(at, at), written)]}),
    )


def _missing_includes(
    view: DocumentContext, name: str, folders: Iterable[Path], offered: Container[str]
) -> Iterator[tuple[str, WorkspaceEdit]]:
    """Include a file of the workspace that declares the name, unless that is offered already."""
    path = view.document.path
    if path is None or not name.isidentifier():
        return
    declared = re.compile(_DECLARED.format(name=re.escape(name)), re.MULTILINE)
    known = set(view.snapshot.parses)
    at = _end_of_includes(view)
    for file in _candidates(path, folders):
        if key_of(file) in known:
            continue
        try:
            text = read_text(file) or ""
        except (OSError, ValueError):
            continue
        # What states goals or closes classes is a model of its own, which nobody includes.
        if declared.search(text) and _SCRIPT.search(text) is None:
            relative = Path(os.path.relpath(file, path.parent)).as_posix()
            written = f'#include "{relative}"\n'
            if written in offered:
                continue
            edit = TextEdit(view.document.lines.range(at, at), written)
            yield f'include "{relative}", which declares `{name}`', WorkspaceEdit({view.document.uri: [edit]})


def _candidates(path: Path, folders: Iterable[Path]) -> list[Path]:
    found = {key_of(file): file for folder in (path.parent, *folders) for file in models_below(folder)}
    return sorted(found.values(), key=lambda file: (file.parent != path.parent, file))


def _end_of_includes(view: DocumentContext) -> int:
    text, at = view.parse.source.text, 0
    for statement in view.parse.module.statements:
        if not isinstance(statement, Include):
            break
        end = text.find("\n", statement.span.finish)
        at = end + 1 if end >= 0 else len(text)
    if at == 0 and view.parse.module.statements:
        at = view.parse.module.statements[0].span.begin
    return at
