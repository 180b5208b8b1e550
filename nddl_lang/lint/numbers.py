"""Find arithmetic that does not do what it seems to: floats compared for equality, ints among floats, a < b < c."""

from collections.abc import Iterator
from functools import partial

from nddl_lang.lint.codes import (
    ARROW,
    BEYOND_FLOATS,
    CHAINED,
    FLOAT_EQUALITY,
    INT_AMONG_FLOATS,
    INT_OF_FLOATS,
    INT_RESULT,
    NEVER_WHOLE,
    TRUTH_AS_NUMBER,
    WHOLE_FLOAT,
)
from nddl_lang.lint.part import Facts, Finding, Part
from nddl_lang.lint.reading import declared, domain_of
from nddl_lang.lint.sampling import draws_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import is_fraction, number, whole_beside
from nddl_lang.semantics.names import COMPARISONS
from nddl_lang.semantics.schema import GlobalReference, Interval, Kind, LocalReference, Values, Variable
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import (
    Assignment,
    BinaryExpr,
    CallConstraint,
    CallExpr,
    ClassDecl,
    Declarator,
    Expr,
    ExprConstraint,
    FloatLiteral,
    IfStatement,
    IntervalExpr,
    IntLiteral,
    PathExpr,
    SetExpr,
    VariableDecl,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span

_LARGEST_FLOAT = 2.0**51  # what is beyond counts as infinite, as in EUROPA
_ARITHMETIC = frozenset({"+", "-", "*", "/"})
_TRUTHS = Values((0, 1))
_ROUND = "say how to round: `ceil(...)` or `floor(...)`"
_ROUNDING = frozenset({"ceil", "floor"})
_PRODUCTS = frozenset({"mulEq", "multEq", "divEq", "eqProduct"})


def _kind(part: Part, expression: Expr) -> Kind | None:
    type_ = part.tables.types.get(expression)
    return type_.kind if type_ is not None else None


def _is_computed(part: Part, expression: Expr) -> bool:
    """Whether an expression is the result of arithmetic over something that is not written out."""
    if isinstance(expression, BinaryExpr) and expression.op in _ARITHMETIC:
        return number(expression) is None
    return isinstance(expression, CallExpr) and expression not in part.tables.sampled


def lint_float_equality(part: Part) -> Iterator[Finding]:
    """A float that was computed, tested for equality where the answer matters."""
    computed = _computed_locals(part)
    for comparison in _tests(part):
        sides = (comparison.left, comparison.right)
        if comparison.op not in ("==", "!=") or Kind.FLOAT not in (_kind(part, side) for side in sides):
            continue
        for side in sides:
            reference = part.reference(side) if isinstance(side, PathExpr) else None
            is_local = isinstance(reference, LocalReference) and reference.variable in computed
            if (is_local or _is_computed(part, side)) and _kind(part, side) is Kind.FLOAT:
                help_ = "floats are rounded; compare with bounds, as in `x >= 0.99 && x <= 1.01`"
                yield FLOAT_EQUALITY.at(comparison.span, help=help_, op=comparison.op)
                break


def _tests(part: Part) -> Iterator[BinaryExpr]:
    """The comparisons whose truth is asked for: in conditions, under `&&` and `||`, and inside comparisons."""
    roots: list[Expr] = [statement.condition for statement in part.all(IfStatement)]
    for constraint in part.all(ExprConstraint):
        expression = constraint.expression
        if isinstance(expression, BinaryExpr):
            roots += (expression.left, expression.right)
    for root in roots:
        for node in descendants(root):
            if isinstance(node, BinaryExpr) and node.op in COMPARISONS:
                yield node


def _computed_locals(part: Part) -> set[object]:
    """The locals that equal a result of arithmetic, and those that a product gives, all else in it given."""
    found: set[object] = set()
    given: set[object] = set()
    for left, right, _ in _equalities(part):
        for path, other in ((left, right), (right, left)):
            reference = part.reference(path) if isinstance(path, PathExpr) else None
            if not isinstance(reference, LocalReference):
                continue
            if _is_computed(part, other):
                found.add(reference.variable)
            if _kind(part, other) is not Kind.INT:
                given.add(reference.variable)
    for call in part.all(CallConstraint):
        references = [part.reference(argument) for argument in call.arguments if isinstance(argument, PathExpr)]
        free = [each.variable for each in references if isinstance(each, LocalReference) and each.variable not in given]
        if call.name.name in _PRODUCTS and len(free) == 1:
            found.update(free)
    return found


def lint_int_among_floats(part: Part) -> Iterator[Finding]:
    """An int variable in a product of floats: what is drawn back from the product is rounded to a whole number."""
    for call in part.all(CallConstraint):
        if call.name.name not in _PRODUCTS:
            continue
        kinds = [_kind(part, argument) for argument in call.arguments]
        if Kind.FLOAT not in kinds or not any(
            isinstance(argument, PathExpr) and kind is Kind.FLOAT
            for argument, kind in zip(call.arguments, kinds, strict=True)
        ):
            continue
        for argument, kind in zip(call.arguments, kinds, strict=True):
            if kind is Kind.INT and isinstance(argument, PathExpr):
                text = argument.span.text
                name = text.rpartition(".")[2]
                help_ = f"copy it into a float first: `float {name}Exact; eq({name}Exact, {text});`"
                yield INT_AMONG_FLOATS.at(argument.span, help=help_, name=text, constraint=call.name.name)


def lint_int_results(part: Part) -> Iterator[Finding]:
    """An int that is to equal a float that was computed or drawn, or a number that is not whole."""
    computed = _computed_locals(part)
    drawn = _drawn_locals(part)
    results: dict[Variable, list[Diagnostic]] = {}
    for left, right, span in _equalities(part):
        for path, other in ((left, right), (right, left)):
            if (
                not isinstance(path, PathExpr)
                or _kind(part, path) is not Kind.INT
                or _kind(part, other) is not Kind.FLOAT
            ):
                continue
            name, text = path.span.text, other.span.text
            if (written := number(other)) is not None:
                if fixes := whole_beside(written, other.span):
                    yield NEVER_WHOLE.at(span, fixes=fixes, name=name, value=text)
                continue
            reference = part.reference(other) if isinstance(other, PathExpr) else None
            variable = reference.variable if isinstance(reference, LocalReference) else None
            fix = Fix("round up", (Edit(other.span, f"ceil({text})"),), safe=False)
            fixes = (fix,) if part.dialect is Dialect.NDDLC else ()
            result = INT_RESULT.at(span, help=_ROUND, fixes=fixes, name=name)
            if isinstance(reference, GlobalReference):
                yield partial(_never_whole, span, name, reference.variable)
            elif variable in drawn:
                yield partial(_seldom_whole, result, drawn[variable])
            elif variable in computed or _is_computed(part, other):
                if (own := _declared_int(part, path)) is not None:
                    results.setdefault(own, []).append(result)
                else:
                    yield result
    for variable, found in results.items():
        yield from _of_floats(part, variable, found)


def _declared_int(part: Part, path: Expr) -> Variable | None:
    """The local variable that a declaration of its own makes an int, and gives no value."""
    reference = part.reference(path) if isinstance(path, PathExpr) else None
    if not isinstance(reference, LocalReference) or reference.variable.initialiser is not None:
        return None
    node = reference.variable.node
    is_own = isinstance(node, VariableDecl) and len(node.declarators) == 1 and node.type_name.name == "int"
    return reference.variable if is_own else None


def _of_floats(part: Part, variable: Variable, results: list[Diagnostic]) -> Iterator[Diagnostic]:
    """The `results` of an int; one finding where it is declared, where it is used as a float everywhere else too."""
    uses = [each for each in part.all(PathExpr) if _declared_int(part, each) is variable]
    beside = {
        each: other for one in part.all(BinaryExpr) for each, other in ((one.left, one.right), (one.right, one.left))
    }
    beside |= {each: other for left, right, _ in _equalities(part) for each, other in ((left, right), (right, left))}
    rounded = {each for call in part.all(CallExpr) if call.function.name in _ROUNDING for each in call.arguments}
    are_floats = all(each in rounded or _kind(part, beside.get(each, each)) is Kind.FLOAT for each in uses)
    if not are_floats or len(uses) <= len(results) or variable.span is None:
        yield from results
        return
    assert isinstance(variable.node, VariableDecl)
    fix = Fix(f"declare `float {variable.name};`", (Edit(variable.node.type_name.span, "float"),), safe=False)
    notes = tuple(Note("this holds only where the float is whole", each.span) for each in results)
    yield INT_OF_FLOATS.at(variable.span, notes=notes, fixes=(fix,), name=variable.name)


def _never_whole(span: Span, name: str, constant: Variable, facts: Facts) -> Diagnostic | None:
    """The finding where a constant is no whole number."""
    match facts.assigned.get((constant, "")) or declared(constant):
        case Values(items=(value,)) if is_fraction(value):
            notes = (Note(f"`{constant.name}` is declared here", constant.span),)
            return NEVER_WHOLE.at(
                span, notes=notes, help=_ROUND, name=name, value=f"{value}, which `{constant.name}` is"
            )
    return None


def _seldom_whole(result: Diagnostic, parameter: Variable, facts: Facts) -> Diagnostic | None:
    """`result` where the range ends with a fraction: of another one a mission may draw whole numbers."""
    match facts.assigned.get((parameter, "")) or declared(parameter):
        case Interval(lower=lower, upper=upper) if lower != upper and (is_fraction(lower) or is_fraction(upper)):
            return result
    return None


def _drawn_locals(part: Part) -> dict[Variable, Variable]:
    """The local floats that are the value of a sampled parameter, with that."""
    return {
        draw.receiver[0]: draw.parameter.variable
        for draw in draws_of(part)
        if draw.receiver is not None and isinstance(draw.receiver[0], Variable)
        if isinstance(draw.parameter, GlobalReference)
    }


def _equalities(part: Part) -> Iterator[tuple[Expr, Expr, Span]]:
    """What is said to be equal, in either form."""
    for constraint in part.all(ExprConstraint):
        expression = constraint.expression
        if isinstance(expression, BinaryExpr) and expression.op == "==":
            yield expression.left, expression.right, expression.span
    for call in part.all(CallConstraint):
        if call.name.name == "eq" and len(call.arguments) == 2:
            yield call.arguments[0], call.arguments[1], call.span


def lint_whole_floats(part: Part) -> Iterator[Finding]:
    """A float variable with a domain of ints, which EUROPA turns into an int."""
    if part.dialect is not Dialect.NDDL3:
        return
    declared: list[tuple[str, Expr]] = []
    if isinstance(part.node, VariableDecl):
        for declarator in part.all(Declarator):
            variable = part.tables.declared.get(declarator.name)
            if (
                declarator.initialiser is not None
                and getattr(getattr(variable, "type", None), "kind", None) is Kind.FLOAT
            ):
                declared.append((declarator.name.name, declarator.initialiser))
    elif isinstance(part.node, ClassDecl):
        for assignment in part.all(Assignment):
            reference = part.reference(assignment.target)
            members = getattr(reference, "members", ())
            if members and members[-1].type.kind is Kind.FLOAT:
                declared.append((assignment.target.span.text, assignment.value))
    for name, value in declared:
        literals = [node for node in descendants(value) if isinstance(node, IntLiteral | FloatLiteral)]
        if not isinstance(value, IntervalExpr | SetExpr | IntLiteral) or not literals:
            continue
        if all(isinstance(literal, IntLiteral) and "inf" not in literal.span.text for literal in literals):
            edits = tuple(Edit(literal.span, f"{literal.span.text.rstrip('lL')}.0") for literal in literals)
            fix = Fix("write floats", edits)
            yield WHOLE_FLOAT.at(value.span, fixes=(fix,), name=name)


def lint_chained_comparisons(part: Part) -> Iterator[Finding]:
    """`a < b < c`, which compares the truth of `a < b` with `c`."""
    for outer in part.all(BinaryExpr):
        inner = outer.left
        if outer.op not in COMPARISONS or not isinstance(inner, BinaryExpr) or inner.op not in COMPARISONS:
            continue
        if inner.left.span.begin > inner.span.begin:  # in parentheses: it is meant so
            continue
        middle, right = inner.right.span.text, outer.right.span.text
        first = part.tables.types.get(inner.left)
        is_truth = inner.op == "==" and first is not None and first.kind is Kind.BOOL
        text = f"{inner.span.text} && {middle} {outer.op} {right}"
        if is_truth:
            text = f"{inner.left.span.text} == ({middle} {outer.op} {right})"
        fix = Fix(f"write `{text}`", (Edit(outer.span, text),), safe=False)
        notes = (Note(f"read as `({inner.span.text}) {outer.op} {right}`"),)
        yield CHAINED.at(outer.op_span, notes=notes, fixes=(fix,), op=outer.op, text=inner.span.text)


def lint_truths_as_numbers(part: Part) -> Iterator[Finding]:
    """A truth that is to equal a number: one which is neither 0 nor 1, `LIMIT == (a > 3)`, or a written 0 or 1."""
    conditions = {each.condition for each in part.all(IfStatement)}
    for comparison in part.all(BinaryExpr):
        for truth, other in ((comparison.left, comparison.right), (comparison.right, comparison.left)):
            if comparison.op in ("==", "!=") and isinstance(truth, PathExpr) and _kind(part, truth) is Kind.BOOL:
                if isinstance(other, IntLiteral) and other.value in (0, 1):
                    word = "true" if other.value else "false"
                    fix = Fix(f"write `{word}`", (Edit(other.span, word),))
                    yield TRUTH_AS_NUMBER.at(
                        other.span, fixes=(fix,), name=truth.span.text, value=other.value, truth=word
                    )
                    continue
            is_told = comparison in conditions and isinstance(truth, PathExpr)  # as a condition that never holds
            if comparison.op not in ("==", "!=") or is_told or _kind(part, truth) is not Kind.BOOL:
                continue
            kind = _kind(part, other)
            domain = domain_of(part, other) if kind in (Kind.INT, Kind.FLOAT) else None
            if domain is not None and kind is not None and domains.intersect(domain, _TRUTHS, kind) is None:
                known, value = other.span.text, domains.text(domain)
                said = f"`{known}` is {value}, and " if known != value else ""
                notes = (Note(f"{said}a truth counts as 0 or 1"),)
                yield CHAINED.at(comparison.op_span, notes=notes, op=comparison.op, text=truth.span.text)


def lint_arrows(part: Part) -> Iterator[Finding]:
    """`x <- 3`, which other languages read as "x becomes 3"."""
    for comparison in part.all(BinaryExpr):
        sign, right = comparison.op_span, comparison.right.span
        behind = sign.source.text[sign.finish : sign.finish + 2]
        if comparison.op == "<" and right.begin == sign.finish and behind[:1] == "-" and behind[1:].isspace():
            place = Span(sign.anchor, sign.start, sign.end + 1)
            is_value = isinstance(part.node, ExprConstraint)
            meant = "=" if is_value else "=="
            fixes = tuple(Fix(f"write `{text}`", (Edit(place, text),), safe=False) for text in (meant, "< -"))
            yield ARROW.at(place, fixes=fixes, text=comparison.span.text)


def lint_beyond_floats(part: Part) -> Iterator[Finding]:
    """A number that is written out and counts as infinite, though it does not say so."""
    for literal in part.all(FloatLiteral):
        if abs(literal.value) >= _LARGEST_FLOAT and "inf" not in literal.span.text:
            help_ = "write `inff` where infinity is meant, or measure in a larger unit"
            yield BEYOND_FLOATS.at(literal.span, help=help_, text=literal.span.text)
