"""A variable or token of one rule, used in another rule that does not declare it: its declaration is the help."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from nddl_lang.semantics.codes import UNKNOWN_NAME
from nddl_lang.semantics.schema import Schema
from nddl_lang.semantics.undeclared import declared
from nddl_lang.syntax.nodes import Instance, PathExpr, RuleDecl, Statement, VariableDecl
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span


def propose_declared_elsewhere(
    statements: Sequence[Statement], schema: Schema, found: Sequence[Diagnostic]
) -> tuple[Diagnostic, ...]:
    """`found`, where names that nothing helps with are declared as other rules of the model declare them.

    Where no rule does, the class is the only one that has all members that the rule uses of the name.
    """
    if not any(map(_is_helpless, found)):
        return tuple(found)
    rules = [each for each in statements if isinstance(each, RuleDecl)]
    return tuple(_helped(rules, schema, each) if _is_helpless(each) else each for each in found)


def _is_helpless(complaint: Diagnostic) -> bool:
    return complaint.code is UNKNOWN_NAME and complaint.help is None and not complaint.fixes


def _helped(rules: Sequence[RuleDecl], schema: Schema, complaint: Diagnostic) -> Diagnostic:
    name = complaint.span.text
    rule = next((each for each in rules if _covers(each.span, complaint.span)), None)
    place = next((each.span for each in rule.body if _covers(each.span, complaint.span)), None) if rule else None
    if rule is None or place is None:
        return complaint
    used = {
        each.parts[1].name
        for each in descendants(rule)
        if isinstance(each, PathExpr) and len(each.parts) > 1 and each.parts[0].name == name
    }
    others = [each for each in rules if each is not rule]
    variables = [each for each in _declarations(others) if any(one.name.name == name for one in each.declarators)]
    tokens = [each for each in _tokens(others) if each.name is not None and each.name.name == name]
    types = list(dict.fromkeys(each.type_name.name for each in variables))
    if len(types) == 1 and not tokens:
        note = Note(f"another rule declares its own `{name}` here", variables[0].span)
        told = declared(complaint, place, types[0])
        return replace(told, notes=(*told.notes, note))
    if tokens and not types:
        note = Note(f"another rule asks for its own `{name}` here; a rule sees no token of another", tokens[0].span)
        return replace(complaint, notes=(*complaint.notes, note))
    owners = _owners(schema, used) if used and not types and not tokens else []
    return declared(complaint, place, owners[0]) if len(owners) == 1 else complaint


def _owners(schema: Schema, used: set[str]) -> list[str]:
    """The classes that have all these members and extend none that has them too."""
    having = [name for name in schema.classes if all(schema.find_member(name, one) is not None for one in used)]
    return [name for name in having if (base := schema.classes[name].base) is None or base not in having]


def _declarations(rules: Sequence[RuleDecl]) -> Iterator[VariableDecl]:
    return (each for rule in rules for each in descendants(rule) if isinstance(each, VariableDecl))


def _tokens(rules: Sequence[RuleDecl]) -> Iterator[Instance]:
    return (each for rule in rules for each in descendants(rule) if isinstance(each, Instance))


def _covers(outer: Span, inner: Span) -> bool:
    return outer.source is inner.source and outer.begin <= inner.begin and inner.finish <= outer.finish
