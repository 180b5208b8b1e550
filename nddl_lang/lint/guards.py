"""Find guards that can never hold, always hold, or are never decided."""

from collections.abc import Iterator

from nddl_lang.lint.codes import ALWAYS_TRUE, NEVER_DECIDED, NEVER_TRUE, SEVERAL_VALUES, VARYING_FIELD
from nddl_lang.lint.logic import Known, assume, truth
from nddl_lang.lint.part import Facts, Finding, Part
from nddl_lang.lint.reading import declared, is_finite
from nddl_lang.semantics.names import COMPARISONS
from nddl_lang.semantics.schema import Kind, LocalReference, MemberReference, TokenVariableReference, Variable
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    CallExpr,
    Expr,
    ExprConstraint,
    Foreach,
    IfStatement,
    IntervalExpr,
    PathExpr,
    RuleDecl,
    RuleStatement,
    SetExpr,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note

_ASKING = frozenset({"isSingleton", "isSpecified"})


def lint_guards(part: Part) -> Iterator[Finding]:
    """Conditions of a rule, each with what the rule says beside it."""
    if not isinstance(part.node, RuleDecl) or not part.all(IfStatement):
        return
    sampled = set(part.tables.sampled)
    pending: list[tuple[tuple[RuleStatement, ...], Known]] = [(part.node.body, Known())]
    while pending:
        body, known = pending.pop()
        for statement in body:
            if isinstance(statement, ExprConstraint):
                known = assume(part, statement.expression, True, known)
        for statement in body:
            if isinstance(statement, Foreach):
                pending.append((statement.body, known))
            elif isinstance(statement, IfStatement):
                yield from _judged(part, statement, known)
                yield from _undecided(part, statement.condition, sampled)
                pending.append((statement.then, assume(part, statement.condition, True, known)))
                if statement.otherwise:
                    pending.append((statement.otherwise, assume(part, statement.condition, False, known)))


def _judged(part: Part, statement: IfStatement, known: Known) -> Iterator[Finding]:
    condition = statement.condition
    if not any(isinstance(node, PathExpr) for node in descendants(condition)):
        return
    notes = _notes(part, condition)
    if truth(part, condition, known) is False:
        yield NEVER_TRUE.at(condition.span, notes=notes)
    elif truth(part, condition, known.without_exclusions()) is True:
        yield ALWAYS_TRUE.at(condition.span, notes=notes)


def _notes(part: Part, condition: Expr) -> tuple[Note, ...]:
    """Where the variables of a condition are declared."""
    notes: dict[object, Note] = {}
    for node in descendants(condition):
        reference = part.reference(node) if isinstance(node, PathExpr) else None
        variable: Variable | None = None
        if isinstance(reference, LocalReference):
            variable = reference.variable
        elif isinstance(reference, TokenVariableReference):
            names = (p for p in reference.label.predicate.parameters if p.name == reference.name)
            variable = next(names, None)
        if variable is not None and variable.span is not None:
            notes[variable] = Note(f"`{variable.name}` is declared here", variable.span)
    return tuple(notes.values())


def _undecided(part: Part, condition: Expr, sampled: set[object]) -> Iterator[Finding]:
    for node in descendants(condition):
        if isinstance(node, BinaryExpr) and node.op in ("==", "!="):
            for side in (node.left, node.right):
                if isinstance(side, IntervalExpr) or (isinstance(side, SetExpr) and len(side.items) > 1):
                    help_ = "compare with the bounds, or with each value: `x >= 3 && x <= 4`, `x == 3 || x == 4`"
                    yield SEVERAL_VALUES.at(side.span, help=help_)
    asked = {
        argument
        for node in descendants(condition)
        if isinstance(node, CallExpr) and node.function.name in _ASKING
        for argument in node.arguments
    }
    for node in descendants(condition):
        if isinstance(node, PathExpr) and node not in asked:
            yield from _undecided_path(part, condition, node, sampled)


def _undecided_path(part: Part, condition: Expr, path: PathExpr, sampled: set[object]) -> Iterator[Finding]:
    reference = part.reference(path)
    if (variable := _narrowed(part, path, sampled)) is not None:
        fixes = _computed_in_place(part, condition, path, variable, sampled)
        written = f"`{fixes[0].edits[0].text}`" if fixes else "a parameter, or what the variable is computed from"
        help_ = f"let the condition ask for {written}: only a search decides a local, once few values are left"
        yield NEVER_DECIDED.at(path.span, help=help_, fixes=fixes, name=variable.name)
    elif isinstance(reference, MemberReference) and part.dialect is Dialect.NDDL3:
        base = reference.base
        type_ = (
            base.type
            if isinstance(base, TokenVariableReference)
            else getattr(getattr(base, "variable", None), "type", None)
        )
        if type_ is not None and isinstance(base, TokenVariableReference | LocalReference):
            yield _varying(path, type_.base)


def _narrowed(part: Part, path: PathExpr, sampled: set[object]) -> Variable | None:
    """The local number that a path names, where nothing but constraints narrows it."""
    reference = part.reference(path)
    if not isinstance(reference, LocalReference) or reference.variable.type.kind not in (Kind.INT, Kind.FLOAT):
        return None
    variable = reference.variable
    is_decided = is_finite(variable.type, declared(variable)) or _is_sampled(part, variable, sampled)
    return None if is_decided else variable


def _computed_in_place(
    part: Part, condition: Expr, path: PathExpr, variable: Variable, sampled: set[object]
) -> tuple[Fix, ...]:
    """What a local equals, written in place of it, where one line above says so and asks for no such local itself."""
    values: list[Expr] = []
    for node in part.all(ExprConstraint):
        equality = node.expression
        if isinstance(equality, BinaryExpr) and equality.op == "==" and node.span.begin < path.span.begin:
            for side, other in ((equality.left, equality.right), (equality.right, equality.left)):
                reference = part.reference(side) if isinstance(side, PathExpr) else None
                if isinstance(reference, LocalReference) and reference.variable is variable:
                    values.append(other)
    value = values[0] if len(values) == 1 and part.dialect is Dialect.NDDLC else None
    if not isinstance(value, BinaryExpr | CallExpr):
        return ()
    names = [node for node in descendants(value) if isinstance(node, PathExpr)]
    if any(_narrowed(part, name, sampled) is not None for name in names):
        return ()
    is_alone = isinstance(value, CallExpr) or (value.op in ("*", "/", "+", "-") and _is_whole(condition, path))
    text = value.span.text if is_alone else f"({value.span.text})"
    return (Fix(f"write `{text}`", (Edit(path.span, text),), safe=False),)


def _is_whole(condition: Expr, path: PathExpr) -> bool:
    """Whether a name is one side of a comparison, not a part of one."""
    return any(
        path in (node.left, node.right) and node.op in COMPARISONS
        for node in descendants(condition)
        if isinstance(node, BinaryExpr)
    )


def _is_sampled(part: Part, variable: Variable, sampled: set[object]) -> bool:
    """Whether a draw gives the variable its value."""
    for node in part.all(ExprConstraint):
        sides = [getattr(node.expression, "left", None), getattr(node.expression, "right", None)]
        if any(side in sampled for side in sides):
            references = [part.reference(side) for side in sides if isinstance(side, PathExpr)]
            if any(isinstance(each, LocalReference) and each.variable is variable for each in references):
                return True
    return any(
        isinstance(reference := part.reference(argument), LocalReference) and reference.variable is variable
        for call in sampled
        for argument in getattr(call, "arguments", ())[:1]
        if isinstance(argument, PathExpr)
    )


def _varying(path: PathExpr, class_name: str) -> Finding:
    prefix = path.parts[0].name

    def finding(facts: Facts) -> Diagnostic | None:
        made = {tuple(argument.span.text for argument in new.arguments) for new in facts.objects.get(class_name, ())}
        if len(made) < 2:
            return None
        help_ = f"EUROPA decides it only if `{path.span.text}` is the same for all objects when the rule starts"
        return VARYING_FIELD.at(path.span, help=help_, name=prefix)

    return finding
