"""A model in, its sites out: each line that may be mistaken, with every small edit of it, by the syntax tree.

An edit is a fault where the model was right, and a repair where it was wrong: `nddlc mutate` makes the one of it, a
counterfactual trial the other.
"""

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from checker.mutation.agreement import Agreement
from checker.mutation.comments import numbers_beside, tells_rate
from checker.mutation.copies import copied_names, said_before
from checker.mutation.exchanges import exchangeable, exchanged, exchanged_numbers, misplaced, recast, shortened, turned
from checker.mutation.kinds import NUMERIC, EditKind
from checker.mutation.missing_lines import missing_lines
from checker.mutation.names import renamings, tautologies
from checker.mutation.scope import LineScope, Scopes
from checker.mutation.swaps import Rows, swapped_branches, swapped_rows
from nddl_lang.semantics.constraints import CONSTRAINTS
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.syntax.includes import LIBRARY, LoadedModules
from nddl_lang.syntax.nodes import (
    Assignment,
    BinaryExpr,
    CallConstraint,
    CallExpr,
    ClassDecl,
    ConstructorDecl,
    ExprConstraint,
    FloatLiteral,
    Foreach,
    GoalStatement,
    IfStatement,
    Instance,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    RuleDecl,
    UnaryExpr,
    VariableDecl,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span

_INFINITE = 2**52 - 1
_NUMBERS = ("int", "float")
_SAMPLING = "sampledParameter"
_FACTORS = (2.0, 0.5, 10.0, 0.1)
_RELATIONS = ("any", "contains", "contained_by", "before", "after", "meets", "met_by", "starts", "ends", "equals")
_OTHER_SIGNS = {
    "<=": (">=", "==", "<"),
    ">=": ("<=", "==", ">"),
    "<": (">", "<=", "=="),
    ">": ("<", ">=", "=="),
    "==": ("<=", ">=", "!="),
    "!=": ("==",),
}
_OTHER_NAMES = {"leq": ("eq", "lt"), "lt": ("leq", "eq"), "eq": ("leq", "neq"), "neq": ("eq",)}
_OUTSIDE = LineScope()


@dataclass(frozen=True, slots=True)
class SmallEdit:
    """Characters `begin` to `end` of a file give way to `new`; `file` is its real path, `line` where that begins."""

    kind: EditKind
    file: str
    begin: int
    end: int
    old: str
    new: str
    line: int


@dataclass(frozen=True, eq=False, slots=True)
class EditSite:
    """A statement that may be mistaken, from its first line to its last: `rule` is what it is a part of.

    A branch has the lines of its condition. `scope` are the lines of the whole rule. `named` is the global variable
    that is set here, a number if `is_number`; `is_rule`: it is the head of a rule, for which something may be missing.
    `begin` is its offset. `agreeing` edits, each by its offset and what it writes, give both sides of `==` one type.
    `is_apart`: the two can hardly be compared. `wanted` edits, given alike, make of a copy what it was copied for, or
    hand a function what it calls its argument. `unlike` edits, given alike, write a whole number for a real one, or the
    other way round, unless they agree; of a goal, a number beyond those of all other goals, where it lies among them.
    `noted` edits, given alike, write a number that a comment names, where it does not name the one that stands there;
    where it does, that is `stated`, by its offset. `is_rate`: a comment says that what is set is so much per something.
    `inputs` are the numbers, each with its type, that the token of a rule brings along, told at its head.
    `coded` is the constraint of the project's own that it calls, in Python. `is_check`: a conflict shows that it only
    compares what others give.
    """

    file: str
    first: int
    column: int
    last: int
    rule: str
    scope: tuple[int, int]
    text: str
    edits: tuple[SmallEdit, ...]
    named: str = ""
    is_rule: bool = False
    begin: int = 0
    is_number: bool = False
    coded: str = ""
    agreeing: frozenset[tuple[int, str]] = frozenset()
    is_apart: bool = False
    wanted: frozenset[tuple[int, str]] = frozenset()
    unlike: frozenset[tuple[int, str]] = frozenset()
    inputs: tuple[tuple[str, str], ...] = ()
    is_check: bool = False
    noted: frozenset[tuple[int, str]] = frozenset()
    stated: frozenset[int] = frozenset()
    is_rate: bool = False

    def holds(self, file: str, line: int) -> bool:
        """Whether a place is one of its lines."""
        return file == self.file and self.first <= line <= self.last

    def edit(self, kind: EditKind, first: int, last: int, new: str) -> SmallEdit:
        """The edit that writes `new` for a part of its text."""
        line = self.first + self.text.count("\n", 0, first)
        return SmallEdit(kind, self.file, self.begin + first, self.begin + last, self.text[first:last], new, line)

    def after(self, edit: SmallEdit) -> str:
        """Its text after one of its edits."""
        return self.text[: edit.begin - self.begin] + edit.new + self.text[edit.end - self.begin :]

    def rivals(self, edit: SmallEdit, kind: EditKind) -> list[SmallEdit]:
        """Its edits of a kind that begin where another one does, that one included if it is of the kind."""
        return [one for one in self.edits if one.kind is kind and one.begin == edit.begin]


def edited(text: str, edit: SmallEdit) -> str:
    """The text after an edit."""
    return text[: edit.begin] + edit.new + text[edit.end :]


def sites_of(loaded: LoadedModules) -> list[EditSite]:
    """Every site of a model, files that come with the package left out, in the order of execution."""
    library = real_path(LIBRARY)
    own = [
        one for one in loaded.module.statements if not real_path(loaded.paths[one.span.source]).is_relative_to(library)
    ]
    names = {
        declarator.name.name: one.type_name.name
        for one in own
        if isinstance(one, VariableDecl)
        for declarator in one.declarators
    }
    reader = _Reader(loaded, names, swapped_rows(own))
    return [site for statement in own for site in reader.sites(statement)]


class _Reader:
    """Reads the sites of a model whose numeric global variables are `names`."""

    def __init__(self, loaded: LoadedModules, names: dict[str, str], rows: Rows) -> None:
        self._rows = rows
        self._files = {source: str(real_path(path)) for source, path in loaded.paths.items()}
        self._limits = sorted(name for name, kind in names.items() if kind in _NUMBERS)
        self._scopes = Scopes(loaded.module.statements, self._limits)
        self._types = Agreement(names)
        self._copied: frozenset[tuple[int, str]] = frozenset()  # not changed when the rule that is read was copied

    def sites(self, statement: Any) -> Iterator[EditSite]:
        """The sites of a top-level statement."""
        match statement:
            case RuleDecl(class_name=owner, predicate=predicate, body=body):
                rule = f"{owner.name}.{predicate.name}"
                names = self._scopes.of_predicate(owner.name, predicate.name)
                head, scope = owner.span, _lines(statement.span)
                yield EditSite(
                    self._files[head.source],
                    head.line,
                    head.column,
                    head.line,
                    rule,
                    scope,
                    f"{owner.name}::{predicate.name}",
                    (),
                    is_rule=True,
                    inputs=tuple((name, kind) for name, kind in names.variables.items() if kind in _NUMBERS),
                )
                self._copied = frozenset((span.begin, name) for span, name in copied_names(body))
                self._copied |= {(span.begin, _blank(span.text)) for span in said_before(body)}
                yield from self._body(body, rule, statement.span, names)
            case ClassDecl(name=owner, members=members):
                for member in members or ():
                    if isinstance(member, PredicateDecl):
                        names = self._scopes.of_predicate(owner.name, member.name.name)
                        yield from self._body(member.body, f"{owner.name}.{member.name.name}", member.span, names)
                    elif isinstance(member, ConstructorDecl):  # what it reads is read; nothing is tried there
                        yield from (self._site(each, "", each.span, ()) for each in member.body)
            case VariableDecl(declarators=declarators):
                rows = self._rows.get(statement, ())
                more = [self._edit(EditKind.SWAP, span, new) for span, new, _ in rows]
                self._copied = frozenset((span.begin, new) for span, new, is_wanted in rows if is_wanted)
                names = self._scopes.outside
                yield self._site(statement, "", statement.span, (statement,), declarators[-1].name.name, more, names)
            case Assignment(target=target, value=value):
                yield self._site(statement, "", statement.span, (value,), target.parts[-1].name)
            case CallConstraint() | ExprConstraint() | Relation() | GoalStatement():
                yield self._site(statement, "", statement.span, (statement,))
            case _:
                pass

    def _body(self, body: Iterable[Any], rule: str, whole: Span, names: LineScope) -> Iterator[EditSite]:
        for statement in body:
            match statement:
                case IfStatement(condition=condition, then=then, otherwise=otherwise):
                    self._rows = {**self._rows, **swapped_branches(statement)}
                    branches = [self._dropped(one[0].span.to(one[-1].span)) for one in (then, otherwise) if one]
                    yield self._site(condition, rule, whole, (condition,), more=branches, names=names)
                    for branch in (then, otherwise or ()):
                        yield from self._body(branch, rule, whole, names)
                case Foreach(body=inner):
                    yield from self._body(inner, rule, whole, names)
                case CallConstraint() | ExprConstraint() | Relation() | VariableDecl() | Assignment():
                    behind = self._scopes.after(names, statement)
                    made = {label: shape for label, shape in behind.tokens.items() if label not in names.tokens}
                    more = [self._edit(EditKind.LINE, *one) for one in missing_lines(statement, whole, behind, made)]
                    more += [self._edit(EditKind.SWAP, span, new) for span, new, _ in self._rows.get(statement, ())]
                    yield self._site(statement, rule, whole, (statement,), more=more, names=names)
                    names = behind
                case _:
                    pass

    def _site(
        self,
        node: Any,
        rule: str,
        whole: Span,
        roots: tuple[Any, ...],
        named: str = "",
        more: Sequence[SmallEdit] = (),
        names: LineScope = _OUTSIDE,
    ) -> EditSite:
        edits = [edit for root in roots for edit in self._edits(root, names)]
        if isinstance(node, (CallConstraint, ExprConstraint)):
            edits.append(self._edit(EditKind.DROPPED_CONSTRAINT, node.span, _blank(node.span.text)))
        told = numbers_beside(node.span, whole)
        return EditSite(
            self._files[node.span.source],
            node.span.line,
            node.span.column,
            _lines(node.span)[1],
            rule,
            _lines(whole),
            node.span.text,
            (*edits, *more),
            named,
            begin=node.span.begin,
            is_number=named in self._limits,
            coded=node.name.name if isinstance(node, CallConstraint) and node.name.name not in CONSTRAINTS else "",
            agreeing=(agreeing := self._agreeing(node, names, edits)),
            wanted=frozenset((edit.begin, edit.new) for edit in (*edits, *more)) & self._copied,
            unlike=frozenset((edit.begin, edit.new) for edit in edits if _is_unlike(edit, names)) - agreeing,
            is_apart=isinstance(node, ExprConstraint) and self._types.is_apart(node.expression, names),
            noted=_noted(edits, told),
            stated=frozenset(edit.begin for edit in edits if edit.kind in NUMERIC and float(edit.old) in told),
            is_rate=bool(named) and tells_rate(node.span),
        )

    def _agreeing(self, node: Any, names: LineScope, edits: Iterable[SmallEdit]) -> frozenset[tuple[int, str]]:
        """The names that would be of the type of the other side of `==`, where the one that stands there is not."""
        expr = node.expression if isinstance(node, ExprConstraint) else None
        wanted = {span.begin: kind for span, kind in self._types.wanted(expr, names)}
        return frozenset(
            (edit.begin, edit.new)
            for edit in edits
            if edit.kind in (EditKind.NAME, EditKind.LIMIT)
            if edit.begin in wanted and wanted[edit.begin] == self._types.kind_of(edit.new, names)
        )

    def _dropped(self, span: Span) -> SmallEdit:
        return self._edit(EditKind.DROPPED_BRANCH, span, _blank(span.text))

    def _edit(self, kind: EditKind, span: Span, new: str) -> SmallEdit:
        return SmallEdit(kind, self._files[span.source], span.begin, span.finish, span.text, new, span.line)

    def _edits(self, root: Any, names: LineScope) -> Iterator[SmallEdit]:
        sampled = {
            argument
            for node in descendants(root)
            if isinstance(node, CallExpr) and node.function.name == _SAMPLING
            for argument in node.arguments
        }
        apart = sampled | {node.path for node in descendants(root) if isinstance(node, Instance)}
        empty = {one for node in descendants(root) for one in (*tautologies(node), *self._emptied(node))}
        for node in descendants(root):
            if node not in apart:
                seen = {(node.span, node.span.text)} | empty  # 9 halved is 9 less 5
                renamed = (
                    renamings(node, names, self._scopes, self._types) if not sampled else ()
                )  # draws are the world's
                for kind, span, new in (*self._changes(node), *renamed):
                    if new != span.text and (span, new) not in seen:
                        seen.add((span, new))
                        yield self._edit(kind, span, new)

    def _emptied(self, node: Any) -> Iterator[tuple[Span, str]]:
        """What would leave an interval without a value: no model has that."""
        if isinstance(node, IntervalExpr):
            lower, upper = node.lower, node.upper
            if isinstance(lower, IntLiteral | FloatLiteral) and isinstance(upper, IntLiteral | FloatLiteral):
                yield from ((span, new) for _, span, new in self._changes(lower) if float(new) > upper.value)
                yield from ((span, new) for _, span, new in self._changes(upper) if float(new) < lower.value)

    def _changes(self, node: Any) -> Iterator[tuple[EditKind, Span, str]]:
        match node:
            case IntLiteral(value=value, span=span) if abs(value) < _INFINITE:
                for factor in _FACTORS:
                    if round(value * factor):
                        yield EditKind.CONSTANT, span, str(round(value * factor))
                for step in (5, -5):
                    yield EditKind.CONSTANT, span, str(value + step)
                for step in (1, -1):
                    yield EditKind.OFF_BY_ONE, span, str(value + step)
                if value < 0:
                    yield EditKind.SIGN, span, str(-value)
            case FloatLiteral(value=value, span=span) if abs(value) < _INFINITE:
                for factor in _FACTORS:
                    yield EditKind.CONSTANT, span, repr(round(value * factor, 12))
                if value < 0.0:
                    yield EditKind.SIGN, span, repr(-value)
            case PathExpr(parts=(name,), span=span) if name.name in self._limits:
                for limit in self._limits:
                    yield EditKind.LIMIT, span, limit
            case BinaryExpr(op=op, op_span=span):
                for other_op in _OTHER_SIGNS.get(op, ()):
                    yield EditKind.COMPARISON, span, other_op
                if op in ("+", "-"):
                    yield EditKind.SIGN, span, "-" if op == "+" else "+"
                if op in ("+", "*"):
                    yield EditKind.OPERATOR, span, "*" if op == "+" else "+"
                yield from ((EditKind.ARGUMENTS, *each) for each in misplaced(node))
                yield from ((EditKind.TURN, *each) for each in turned(node))
                yield from ((EditKind.TERM, span, new) for span, new in shortened(node))
                yield from ((EditKind.FORMULA, span, new) for span, new in recast(node))
            case UnaryExpr(op="-", operand=operand, span=span):
                yield EditKind.SIGN, span, operand.span.text
            case Relation(relation=relation, bounds=()):
                for other in dict.fromkeys((*_RELATIONS, inverse_of(relation.name))):
                    yield EditKind.RELATION, relation.span, other
            case Relation(relation=relation):  # bounds mean something else in most others
                yield EditKind.RELATION, relation.span, inverse_of(relation.name)
            case CallConstraint(name=name, arguments=arguments):
                known = CONSTRAINTS.get(name.name)
                others = _OTHER_NAMES.get(known.name if known is not None else name.name, ())
                yield from ((EditKind.COMPARISON, name.span, one) for one in others)
                for first, second in exchangeable(known, len(arguments)):
                    yield EditKind.ARGUMENTS, *exchanged(arguments[first], arguments[second])
            case CallExpr(arguments=arguments) if len(arguments) > 1:
                yield EditKind.ARGUMENTS, *exchanged(*arguments[:2])
            case NewExpr(arguments=arguments):
                for first in range(len(arguments) - 1):
                    yield EditKind.ARGUMENTS, *exchanged_numbers(*arguments[first : first + 2])
            case _:
                pass


def inverse_of(relation: str) -> str:
    """The relation that says the same with the tokens swapped; the same one where there is no other."""
    row = RELATIONS.get(relation)
    return row.inverse if row is not None and row.inverse is not None else relation


def _noted(edits: Iterable[SmallEdit], numbers: Container[float]) -> frozenset[tuple[int, str]]:
    """The edits that write a number of those for one that is none of them."""
    told = [one for one in edits if one.kind in NUMERIC and float(one.old) not in numbers]
    return frozenset((one.begin, one.new) for one in told if float(one.new) in numbers)


def _is_unlike(edit: SmallEdit, names: LineScope) -> bool:
    """Whether a variable stands then for one of the other type of numbers."""
    kinds = {names.type_of(tuple(one.split("."))) for one in (edit.old, edit.new)}
    return edit.kind is EditKind.NAME and kinds == set(_NUMBERS)


def _lines(span: Span) -> tuple[int, int]:
    """The first and the last line of a span."""
    return span.line, span.source.locate(max(span.begin, span.finish - 1))[0]


def _blank(text: str) -> str:
    """As many lines of nothing."""
    return "\n" * text.count("\n")
