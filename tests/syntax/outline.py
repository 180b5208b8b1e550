"""Write a syntax tree as text."""

from dataclasses import fields
from typing import Any

from nddl_lang.syntax.nodes import (
    BoolLiteral,
    FloatLiteral,
    Identifier,
    IntLiteral,
    Module,
    PathExpr,
    StringLiteral,
)


def outline(module: Module) -> str:
    """One line for each top-level statement: `(VariableDecl int [(Declarator a 1)])`; what is absent is left out."""
    return "\n".join(map(_node, module.statements))


def _node(node: Any) -> str:
    match node:
        case Identifier(name=name):
            return name
        case PathExpr(parts=parts):
            return ".".join(part.name for part in parts) or "()"
        case IntLiteral(value=value) | FloatLiteral(value=value):
            return repr(value)
        case BoolLiteral(value=value):
            return str(value).lower()
        case StringLiteral(value=value):
            return f'"{value}"'
        case tuple():
            return f"[{' '.join(map(_node, node))}]"
        case True | str():
            return str(node)
    words = []
    for field in fields(node):
        value = getattr(node, field.name)
        if field.name in ("span", "op_span") or value is None or value is False:
            continue
        words.append(field.name if value is True else _node(value))
    return f"({' '.join([type(node).__name__, *words])})"
