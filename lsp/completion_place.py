"""A place in a text in; the names that can be seen from there, and what a path of them leads to, out."""

import re
from dataclasses import dataclass, field
from typing import Any

from nddl_lang.analysis import Analysis
from nddl_lang.semantics.natives import builtin_type
from nddl_lang.semantics.schema import Kind, Label, Predicate, Schema, Type, Variable
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.source import Span

# Looked for at the beginnings of words only: a long name is not tried from each of its letters.
_RULE = re.compile(r"(?<![\w$])([A-Za-z_$][\w$]*)\s*::\s*([A-Za-z_$][\w$]*)\s*\{")
_CLASS = re.compile(r"\bclass\s+([A-Za-z_$][\w$]*)")


@dataclass(frozen=True, slots=True)
class Place:
    """What is known around the cursor: names of open blocks, the predicate of the rule, the class being declared."""

    analysis: Analysis
    variables: dict[str, Variable]
    labels: dict[str, Label]
    predicate: Predicate | None
    owner: str | None
    begin: Span | None  # where the top-level statement begins

    @property
    def schema(self) -> Schema:
        """The model."""
        return self.analysis.schema

    def globals(self) -> dict[str, Variable]:
        """The global variables that are declared before this statement."""
        return {name: each for name, each in self.schema.globals.items() if self._is_before(each.span)}

    def goals(self) -> dict[str, Label]:
        """The tokens of the script that are declared before this statement."""
        return {name: each for name, each in self.schema.goals.items() if self._is_before(each.span)}

    def _is_before(self, span: Span | None) -> bool:
        begin = self.begin
        return begin is None or span is None or span.source is not begin.source or span.begin < begin.begin

    def token(self, name: str) -> Predicate | None:
        """The predicate of a token by its name, `this` included."""
        label = self.labels.get(name) or self.goals().get(name)
        return label.predicate if label is not None else self.predicate if name == "this" else None

    def type_of(self, path: list[str]) -> Type | None:
        """The type of a variable by its path: `speed`, `fix.start`, `object.part.size`."""
        head, *rest = path
        token = self.token(head)
        if token is not None:
            type_ = _type_in(token, rest.pop(0)) if rest else None
        elif (variable := self.variables.get(head)) is not None:
            type_ = variable.type
        else:
            type_ = _type_in(self.predicate, head) if self.predicate is not None else None
            member = self.schema.find_member(self.owner, head) if self.owner in self.schema.classes else None
            named = member or self.globals().get(head)
            type_ = type_ or (named.type if named is not None else None)
        for part in rest:
            found = self.schema.find_member(type_.base, part) if type_ is not None else None
            type_ = found.type if found is not None else None
        return type_

    def has_predicates(self, class_name: str) -> bool:
        """Whether tokens of a class can be asked for."""
        owner = self.schema.classes.get(class_name)
        return owner is not None and bool(owner.predicates or owner.inherited)

    def leads_to_predicates(self, type_: Type) -> bool:
        """Whether tokens can be asked for of an object of this type, or of one that a path from it leads to."""
        pending, seen = [type_], set[str]()
        while pending:
            one = pending.pop()
            if one.kind is not Kind.OBJECT or one.base in seen:
                continue
            seen.add(one.base)
            if self.has_predicates(one.base):
                return True
            for name in self.schema.ancestry(one.base):
                pending += [member.type for member in self.schema.classes[name].members.values()]
        return False


def place_around(analysis: Analysis, piece: Piece | None, offset: int) -> Place:
    """What is known at `offset`."""
    if piece is None:
        return Place(analysis, {}, {}, None, None, None)
    variables, labels = _visible(analysis, piece, offset - piece.anchor.offset)
    rule, owner = _RULE.search(piece.text), _CLASS.search(piece.text)
    return Place(
        analysis,
        variables,
        labels,
        analysis.schema.find_predicate(rule[1], rule[2]) if rule is not None else None,
        owner[1] if owner is not None else None,
        piece.span(piece.starts[0], piece.starts[0]) if piece.starts else None,
    )


@dataclass(slots=True)
class _Scopes:
    """Names by the block that they are declared in, while a statement is read from its beginning."""

    blocks: list[list[Any]] = field(default_factory=lambda: [[]])
    heads: list[Any] = field(default_factory=list)  # of a constructor or `foreach`: they hold in the block that follows
    begun: list[Any] = field(default_factory=list)  # of the statement at hand: it cannot use them itself

    def read(self, text: str, is_inside: bool) -> None:
        """Take one sign in; `is_inside` of parentheses."""
        match text:
            case "{":
                self.blocks.append(self.heads)
                self.heads = []
            case "}":
                self.blocks = self.blocks[:-1] or [[]]
            case ";" | ",":
                if text == ";" or not is_inside:
                    self.blocks[-1] += self.begun
                    self.begun = []
        if text in ("{", "}", ";"):
            self.heads, self.begun = [], []


def _visible(analysis: Analysis, piece: Piece, at: int) -> tuple[dict[str, Variable], dict[str, Label]]:
    """The locals, parameters and tokens that are declared before `at` in the blocks that are open there."""
    declared = {
        name.span.start: each for name, each in analysis.tables.declared.items() if name.span.anchor is piece.anchor
    }
    scopes = _Scopes()
    depth = 0
    for start, end, text in zip(piece.starts, piece.ends, piece.texts, strict=True):
        if end > at:
            break
        depth = 0 if text in ("{", "}", ";") else depth + (text == "(") - (text == ")")
        scopes.read(text, depth > 0)
        each = declared.get(start)
        if isinstance(each, Variable | Label):
            (scopes.heads if depth > 0 and isinstance(each, Variable) else scopes.begun).append(each)
    seen = [each for block in scopes.blocks for each in block]
    return (
        {each.name: each for each in seen if isinstance(each, Variable)},
        {each.name: each for each in seen if isinstance(each, Label)},
    )


def _type_in(predicate: Predicate, name: str) -> Type | None:
    found = next((each.type for each in predicate.parameters if each.name == name), None)
    return found or builtin_type(name, predicate)
