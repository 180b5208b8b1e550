"""A relation of a rule in, lines out that may be missing behind it: what a parameter of its token is, when it ends.

A parameter that no line of the rule speaks of has any value that its planner likes, a rule that says nothing of its own
end may go on for ever, and a token that is asked for with `any` and never mentioned again may come whenever it likes.
"""

import re
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from checker.mutation.scope import LineScope, Shape
from nddl_lang.syntax.nodes import Relation, VariableDecl
from nddl_lang.text.source import Span

_OWN_END = re.compile(r"(?<![\w.])(?:end|duration)\b")
_OTHER_TIME = re.compile(r"\b\w+\.(?:start|end)\b")
_ENDING = re.compile(
    r"^\s*(?:ends|equals|meets)\s*\(|\bthis\s+(?:ends|equals|meets)\b|\b(?:ends|equals|met_by)\s+this\b"
)
_ORDER = re.compile(r"(<=|>=|<|>)")
_USE = re.compile(r"\s*\w+\.time\s*==")
_COMMENT = re.compile(r"//[^\n]*")
_ADDED = re.compile(r" \w+\.(\w+) == (?:\w+\.)*(\w+);")
_ORDERED = re.compile(r"\b(\w+)\s+(?:before|after|meets|met_by)\s+(\w+)\s*;")
_LATER = re.compile(r"\b(\w+)\s*\.\s*start\s*>=?\s*(\w+)\s*\.\s*end\b|\b(\w+)\s*\.\s*end\s*<=?\s*(\w+)\s*\.\s*start\b")
_CHILD = re.compile(r"\bcontains\s*\(\s*[\w.]+\s+(\w+)\s*\)")
_TOKEN = re.compile(r"\(\s*(\w+)\.\w+\s+(\w+)\s*\)")
_ANYHOW = "any"  # the relation that demands nothing
_FEWEST = 3  # children that say how a rule orders them
_TRUTHS = ("true", "false")
# By these a rule looks at what is there already: that need not be told what it is.
_AROUND = ("contained_by", "met_by", "after", "starts_during", "ends_during")


def missing_lines(statement: Any, rule: Span, names: LineScope, made: dict[str, Shape]) -> Iterator[tuple[Span, str]]:
    """Lines that may follow a relation, which has `made` tokens; `names` are what may be named behind it.

    What an object is made of is handed on where it is chosen: `window.field == field;`.
    """
    behind = Span(statement.span.anchor, statement.span.end, statement.span.end)
    if isinstance(statement, VariableDecl):
        chosen = statement.declarators[-1].name.name
        for member, kind in names.members.get(names.variables.get(chosen, ""), {}).items():
            if names.variables.get(member) == kind and not _is_said(f"{chosen}.{member}", rule.text):
                yield behind, f" {chosen}.{member} == {member};"
    if not isinstance(statement, Relation) or statement.relation.name in _AROUND:
        return
    for label, shape in made.items():
        for parameter, kind in shape.parameters.items():
            if names.is_value(kind) and not re.search(rf"\b{label}\s*\.\s*{parameter}\b", rule.text):
                for value in _values(label, kind, names):
                    yield behind, f" {label}.{parameter} == {value};"
            elif names.is_value(kind) and not _is_said(f"{label}.{parameter}", rule.text):
                for value in _values(label, kind, names):  # it is read, and nothing says what it is
                    if value.rpartition(".")[2] == parameter:
                        yield behind, f" {label}.{parameter} == {value};"
        if not shape.is_event and not _is_ended(rule.text):
            yield behind, f" {label}.end == end;"
        yield from ((behind, f" {before} before {label};") for before, after in _gaps(rule.text) if after == label)
        if statement.relation.name == _ANYHOW:
            yield from ((behind, f" {one} meets {other};") for one, other in _unrelated(label, rule.text))


def _is_said(name: str, rule: str) -> bool:
    """Whether a line of a rule holds a variable to something, by itself on one side of a comparison or in a call."""
    path = re.escape(name)
    lines = re.split("[;{}]", _COMMENT.sub("", rule))
    return any(re.search(rf"^\s*{path}\s*[<>=!]|[<>=]\s*{path}\s*(?::|$)|\(.*\b{path}\b.*\)", line) for line in lines)


def _unrelated(label: str, rule: str) -> Iterator[tuple[str, str]]:
    """A token that a rule asks for anyhow and never mentions again, with each other one of its timeline, either way."""
    code = _COMMENT.sub("", rule)
    tokens = {name: owner for owner, name in _TOKEN.findall(code)}
    if len(re.findall(rf"\b{label}\b", code)) == 1 and label in tokens:
        for other, owner in tokens.items():
            if other != label and owner == tokens[label]:
                yield other, label
                yield label, other


def _gaps(rule: str) -> list[tuple[str, str]]:
    """The children that follow each other in a rule and that no line orders, where all others are in one order."""
    children = _CHILD.findall(rule)
    pairs = [*_ORDERED.findall(rule), *(tuple(filter(None, one)) for one in _LATER.findall(rule))]
    groups = {child: {child} for child in children}
    for one, other in pairs:
        joined = groups.get(one, set()) | groups.get(other, set())
        groups |= dict.fromkeys(joined, joined)
    gaps = [(one, other) for one, other in pairwise(children) if other not in groups[one]]
    return gaps if len(children) >= _FEWEST and len(gaps) == 1 else []


def _is_ended(rule: str) -> bool:
    """Whether a line of a rule says when its token ends: an upper bound alone only says when it must be over.

    What a resource is used at the end of is told by that end, and does not tell it; what begins by then waits for it.
    """
    for line in re.split("[;{}]", _COMMENT.sub("", rule)):
        is_tied = "==" in line or (_OTHER_TIME.search(line) and not _waits(line))
        if _OWN_END.search(line) and is_tied and not _USE.match(line):
            return True
        if _ENDING.search(line):
            return True
    return False


def _waits(line: str) -> bool:
    """Whether a line only says that the own end comes no sooner than something: `next.start <= end + TURN_MAX`."""
    sides = _ORDER.split(line)
    if len(sides) != 3:
        return False
    smaller, larger = (sides[0], sides[2]) if sides[1].startswith("<") else (sides[2], sides[0])
    return _OWN_END.search(larger) is not None and _OWN_END.search(smaller) is None


def is_namesake(added: str) -> bool:
    """Whether an added line hands on what has the same name."""
    found = _ADDED.fullmatch(added)
    return found is not None and found.group(1) == found.group(2)


def said_of(added: str) -> str:
    """What an added line is about: the variable before `==`."""
    return added.partition("==")[0]


def _values(label: str, kind: str, names: LineScope) -> Iterator[str]:
    """What a parameter of a token may be: a variable of the rule, a parameter of another token, a value of an enum."""
    known = [one for one in names.alike(kind) if names.type_of(tuple(one.split("."))) == kind]
    yield from (one for one in known if not one.startswith(f"{label}."))
    yield from (f"{kind}.{value}" for value in names.enums.get(kind, ()))
    yield from _TRUTHS if kind == "bool" else ()
