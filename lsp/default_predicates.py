"""Default predicates: a predicate in; the strings by which timelines of agents fall back to it out.

`super(m, "Idle")` in the constructor of such a timeline, and `new Gps(Internal, "Idle")`, name a predicate of it.
"""

from collections.abc import Iterator
from dataclasses import replace

from lsp.occurrences import Occurrence, Role, Symbol, SymbolType, symbol_of_predicate
from lsp.project import Snapshot
from nddl_lang.lint.declarations import AGENT_TIMELINE
from nddl_lang.semantics.schema import Schema
from nddl_lang.syntax.nodes import ClassDecl, NewExpr, StringLiteral, SuperCall
from nddl_lang.syntax.walk import descendants


def defaults_of(snapshot: Snapshot, symbol: Symbol) -> Iterator[Occurrence]:
    """The strings of a model that name a predicate, without their quotes."""
    if symbol.type is not SymbolType.PREDICATE:
        return
    schema = snapshot.analysis.schema
    for statement in snapshot.analysis.statements:
        if f'"{symbol.name}"' not in statement.span.text:
            continue
        for node in descendants(statement):
            match node:
                case SuperCall(arguments=arguments) if isinstance(statement, ClassDecl):
                    owner = statement.name.name
                case NewExpr(class_name=name, arguments=arguments):
                    owner = name.name
                case _:
                    continue
            if _falls_back_to(schema, owner, symbol):
                for each in arguments:
                    if isinstance(each, StringLiteral) and each.value == symbol.name:
                        inside = replace(each.span, start=each.span.start + 1, end=each.span.end - 1)
                        yield Occurrence(symbol, inside, Role.READS)


def _falls_back_to(schema: Schema, owner: str, symbol: Symbol) -> bool:
    predicate = schema.find_predicate(owner, symbol.name)
    return (
        schema.is_subclass(owner, AGENT_TIMELINE) and predicate is not None and symbol_of_predicate(predicate) == symbol
    )
