"""Signature help: a place inside a call in; what may be called there, and which argument stands there, out."""

from bisect import bisect_left

from lsprotocol.types import MarkupContent, MarkupKind, ParameterInformation, SignatureHelp, SignatureInformation

from lsp.describe import parameter_text
from lsp.meaning import piece_at
from lsp.open_text import DocumentContext
from nddl_lang.semantics.functions import METHODS
from nddl_lang.semantics.schema import Schema
from nddl_lang.semantics.signature import Signature
from nddl_lang.syntax.nodes import ClassDecl
from nddl_lang.syntax.piece import Piece

_CLOSING = {")": "(", "]": "[", "}": "{"}


def signature_help(view: DocumentContext, offset: int) -> SignatureHelp | None:
    """The signatures of the innermost call around `offset`."""
    piece = piece_at(view.parse, offset)
    call = call_around(piece, offset) if piece is not None else None
    if piece is None or call is None:
        return None
    name, at, count = call
    before = piece.texts[at - 1] if at else ""
    found = _signatures(view, piece, name, before)
    if not found:
        return None
    fitting = next((number for number, each in enumerate(found) if count < len(each.parameters or ())), 0)
    parameters = found[fitting].parameters or ()
    active = min(count, max(0, len(parameters) - 1))
    return SignatureHelp(found, fitting, active)


def call_around(piece: Piece, offset: int) -> tuple[str, int, int] | None:
    """The name before the innermost open parenthesis, its index, and how many commas stand between."""
    depth = count = 0
    last = bisect_left(piece.ends, offset - piece.anchor.offset + 1)
    if last < len(piece.starts) and piece.starts[last] < offset - piece.anchor.offset:
        last += 1
    for index in range(last - 1, -1, -1):
        text = piece.texts[index]
        if text in _CLOSING:
            depth += 1
        elif text in ("(", "[", "{"):
            if depth == 0:
                return (piece.texts[index - 1], index - 1, count) if text == "(" and index else None
            depth -= 1
        elif depth == 0 and text == ";":
            return None
        elif depth == 0 and text == ",":
            count += 1
    return None


def _signatures(view: DocumentContext, piece: Piece, name: str, before: str) -> list[SignatureInformation]:
    analysis = view.snapshot.analysis
    schema, callables = analysis.schema, analysis.callables
    if before == "new":
        return _constructors(schema, name)
    if name == "super":
        owner = next((each for each in piece.statements if isinstance(each, ClassDecl)), None)
        return _constructors(schema, owner.base.name) if owner is not None and owner.base is not None else []
    if before == ".":
        rows = [row for (_, method), row in METHODS.items() if method == name]
        return [_shown(row.name, row.signature, row.meaning) for row in rows]
    found = []
    if (function := callables.functions.get(name)) is not None:
        found.append(_shown(name, function.signature, function.meaning))
    if (constraint := callables.constraints.get(name)) is not None and constraint.signature not in (
        function.signature if function is not None else None,
    ):
        found.append(_shown(name, constraint.signature, constraint.meaning))
    return found


def _shown(name: str, signature: Signature, meaning: str) -> SignatureInformation:
    places = [*signature.required, *signature.optional, *([signature.rest] if signature.rest is not None else [])]
    return SignatureInformation(
        f"{name}({signature.text})",
        MarkupContent(MarkupKind.Markdown, meaning),
        [ParameterInformation(place.name, place.kind.value) for place in places],
    )


def _constructors(schema: Schema, class_name: str) -> list[SignatureInformation]:
    owner = schema.classes.get(class_name)
    found = []
    for constructor in owner.constructors if owner is not None else ():
        texts = [parameter_text(each) for each in constructor.parameters]
        doc = constructor.node.doc if constructor.node is not None else None
        found.append(
            SignatureInformation(
                f"{class_name}({', '.join(texts)})",
                MarkupContent(MarkupKind.Markdown, doc) if doc else None,
                [ParameterInformation(text) for text in texts],
            )
        )
    return found
