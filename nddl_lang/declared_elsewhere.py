"""A variable or token of one rule, used in another rule that does not declare it: its declaration is the help."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from nddl_lang.semantics.codes import UNKNOWN_NAME, UNKNOWN_TOKEN
from nddl_lang.semantics.natives import builtin_names
from nddl_lang.semantics.schema import Schema
from nddl_lang.semantics.undeclared import asked_for, declared
from nddl_lang.syntax.nodes import Instance, PathExpr, Relation, RuleDecl, Statement, VariableDecl
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span


def propose_declared_elsewhere(
    statements: Sequence[Statement], schema: Schema, found: Sequence[Diagnostic]
) -> tuple[Diagnostic, ...]:
    """`found`, where names that nothing helps with are declared as other rules of the model declare them.

    Where no rule does, the class, or the predicate of another one's token, is the only one that has all members that
    the rule uses of the name.
    """
    if not any(map(_is_helpless, found)):
        return tuple(found)
    rules = [each for each in statements if isinstance(each, RuleDecl)]
    mended: set[tuple[RuleDecl, str]] = set()
    kept: list[Diagnostic] = []
    for each in found:
        rule = next((one for one in rules if _covers(one.span, each.span)), None) if _is_helpless(each) else None
        if rule is None:
            kept.append(each)
        elif (rule, each.span.text) not in mended:  # what mends one line that names it mends all
            is_token = any(_is_helpless(one) and one.code is UNKNOWN_TOKEN and _is_of(one, rule, each) for one in found)
            kept.append(_helped(rules, rule, schema, each, is_token=is_token))
            if kept[-1].fixes:
                mended.add((rule, each.span.text))
    return tuple(kept)


def _is_helpless(complaint: Diagnostic) -> bool:
    return complaint.code in (UNKNOWN_NAME, UNKNOWN_TOKEN) and complaint.help is None and not complaint.fixes


def _is_of(one: Diagnostic, rule: RuleDecl, other: Diagnostic) -> bool:
    """Whether a complaint is about the same name in the same rule."""
    return one.span.text == other.span.text and _covers(rule.span, one.span)


def _helped(
    rules: Sequence[RuleDecl], rule: RuleDecl, schema: Schema, complaint: Diagnostic, *, is_token: bool
) -> Diagnostic:
    name = complaint.span.text
    place = next((each.span for each in rule.body if _covers(each.span, complaint.span)), None)
    if place is None:
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
    if len(types) == 1 and not tokens and not is_token:
        note = Note(f"another rule declares its own `{name}` here", variables[0].span)
        told = declared(complaint, place, types[0])
        return replace(told, notes=(*told.notes, note))
    owners = [] if types or is_token else _owners(schema, used)
    asked = [] if types else _asked(schema, rule, used, name)
    if tokens and not types:
        note = Note(f"another rule asks for its own `{name}` here; a rule sees no token of another", tokens[0].span)
        complaint = replace(complaint, notes=(*complaint.notes, note))
    elif len(owners) == 1 and not asked:
        return declared(complaint, place, owners[0])
    return asked_for(complaint, place, asked[0]) if len(asked) == 1 and not owners else complaint


def _asked(schema: Schema, rule: RuleDecl, used: set[str], name: str) -> list[str]:
    """The requests for a token of another class that has all these variables, by the relation most of the rule have."""
    there = {each.path.parts[-1].name for each in _tokens([rule])}  # one of these is more likely meant by another name
    found = [
        one
        for each in schema.classes.values()
        if not schema.is_subclass(rule.class_name.name, each.name)
        for one in each.predicates.values()
        if one.name not in there
        and (own := used - {*builtin_names(one.is_event)})
        and own <= {parameter.name for parameter in one.parameters}
    ]
    alike = [each for each in found if each.name.casefold() == name.casefold()]
    relations = Counter(each.relation.name for each in descendants(rule) if isinstance(each, Relation) and each.created)
    relation = max(relations, key=lambda each: relations[each], default="contains")
    return [f"{relation}({each.class_name}.{each.name} {name});" for each in alike or found]


def _owners(schema: Schema, used: set[str]) -> list[str]:
    """The classes that have all these members and extend none that has them too."""
    if not used:
        return []
    having = [name for name in schema.classes if all(schema.find_member(name, one) is not None for one in used)]
    return [name for name in having if (base := schema.classes[name].base) is None or base not in having]


def _declarations(rules: Sequence[RuleDecl]) -> Iterator[VariableDecl]:
    return (each for rule in rules for each in descendants(rule) if isinstance(each, VariableDecl))


def _tokens(rules: Sequence[RuleDecl]) -> Iterator[Instance]:
    return (each for rule in rules for each in descendants(rule) if isinstance(each, Instance))


def _covers(outer: Span, inner: Span) -> bool:
    return outer.source is inner.source and outer.begin <= inner.begin and inner.finish <= outer.finish
