"""Find statements of the script that cannot come true: tokens outside the horizon, merges, objects never chosen."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from nddl_lang.analysis import Analysis
from nddl_lang.lint.codes import IDLE_FACT, NEVER_PLANNED, NO_MERGE, OUTSIDE_HORIZON, UNCLOSED
from nddl_lang.lint.part import Part
from nddl_lang.lint.suppression import suppress
from nddl_lang.lint.whole import Whole, hull_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import (
    GlobalReference,
    Interval,
    Kind,
    Label,
    TokenReference,
    Variable,
)
from nddl_lang.syntax.nodes import (
    Assignment,
    BinaryExpr,
    ClassDecl,
    ExprConstraint,
    GoalStatement,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    RuleDecl,
    Statement,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note, Severity
from nddl_lang.text.source import Span

_CLOSE = "write `close();` after the last object is made"
_DEFAULT_HORIZON = Interval(0, 100)


def lint_script(whole: Whole) -> Iterator[Diagnostic]:
    """What the goals of a whole model say about times, objects and resources."""
    goals = [(part, part.node) for part in whole.statements(GoalStatement) if isinstance(part.node, GoalStatement)]
    yield from _horizon(whole, goals)
    yield from _merges(whole)
    yield from _facts(whole, goals)
    if goals and whole.is_whole and whole.is_own(goals[0][0].node.span):
        yield from _unclosed(whole, goals[0][0])
    elif not goals and whole.is_whole:
        yield from _unclosed_without_goals(whole)


# ---- the horizon ----


def _horizon_of(whole: Whole) -> tuple[Interval, NewExpr] | None:
    """The planning horizon that the model itself sets, None where it sets none or several."""
    made = whole.objects.get("PlannerConfig", [])
    if len(made) != 1:
        return None
    arguments = made[0].arguments
    if not arguments:
        return _DEFAULT_HORIZON, made[0]
    bounds = [number(argument) for argument in arguments[:2]]
    if len(bounds) < 2 or bounds[0] is None or bounds[1] is None:
        return None
    return Interval(bounds[0], bounds[1]), made[0]


def _horizon(whole: Whole, goals: list[tuple[Part, GoalStatement]]) -> Iterator[Diagnostic]:
    found = _horizon_of(whole)
    if found is None:
        return
    horizon, config = found
    notes = (Note("the horizon is set here", config.span),)
    for part, node in goals:
        for instance in node.instances:
            label = part.label_of(instance)
            predicate = part.predicate_of(instance)
            if predicate is None or predicate.is_event or _is_active_from_start(whole, predicate.class_name):
                continue
            name = label.name if label is not None else instance.path.span.text
            if label is None or label not in whole.usage.labels:
                help_ = f"a token is planned once it must start before {horizon.upper}: bound its `start`"
                yield NEVER_PLANNED.at(instance.span, notes=notes, help=help_, name=name)
                continue
            start = hull_of(whole.assigned.get((label, "start")))
            end = hull_of(whole.assigned.get((label, "end")))
            if (start is not None and start.lower >= horizon.upper) or (end is not None and end.upper <= horizon.lower):
                yield OUTSIDE_HORIZON.at(instance.span, notes=notes, name=name, horizon=domains.set_text(horizon))


def _is_active_from_start(whole: Whole, class_name: str) -> bool:
    return any(
        whole.analysis.schema.classes[name].is_native and name not in ("Object", "Timeline")
        for name in whole.ancestry(class_name)
    )


# ---- merges ----


def _merges(whole: Whole) -> Iterator[Diagnostic]:
    for part in whole.statements(MethodCall):
        node = part.node
        if not isinstance(node, MethodCall) or node.method.name != "merge" or len(node.arguments) != 1:
            continue
        tokens = [part.reference(node.target), part.reference(node.arguments[0])]
        labels = [token.label for token in tokens if isinstance(token, TokenReference)]
        if len(labels) == 2:
            yield from _difference(whole, node, labels[0], labels[1])


def _difference(whole: Whole, node: MethodCall, one: Label, other: Label) -> Iterator[Diagnostic]:
    variables = ["start", "end", "duration", *(parameter.name for parameter in one.predicate.parameters)]
    for variable in variables:
        left, right = (whole.assigned.get((label, variable)) for label in (one, other))
        parameter = next((each for each in one.predicate.parameters if each.name == variable), None)
        kind = parameter.type.kind if parameter is not None else Kind.INT
        if left is not None and right is not None and domains.intersect(left, right, kind) is None:
            notes = tuple(
                Note(f"`{label.name}.{variable}` is given here", whole.given[label, variable][0][1])
                for label in (one, other)
            )
            yield NO_MERGE.at(node.span, notes=notes, name=one.name, other=other.name, variable=variable)
            return


# ---- facts, closing ----


def _facts(whole: Whole, goals: list[tuple[Part, GoalStatement]]) -> Iterator[Diagnostic]:
    if not whole.is_whole:
        return
    planned: set[Label] = set()
    for part in (*whole.statements(MethodCall), *whole.statements(Assignment)):
        node = part.node
        if isinstance(node, MethodCall) and node.method.name in ("activate", "merge", "constrain"):
            for path in (node.target, *node.arguments):
                reference = part.reference(path)
                if isinstance(reference, TokenReference):
                    planned.add(reference.label)
        elif isinstance(node, Assignment) and node.target.parts[-1].name == "state":
            label = getattr(part.reference(node.target), "label", None)
            if isinstance(label, Label):
                planned.add(label)
    for part, node in goals:
        if node.kind != "fact" or not whole.is_own(node.span):
            continue
        for instance in node.instances:
            label = part.label_of(instance)
            if label is None or label not in planned:
                how = f"`{label.name}.activate();`" if label is not None else "a name, and `activate()`"
                yield IDLE_FACT.at(instance.span, help=f"to put it into the plan, add {how}")


def _unclosed(whole: Whole, first: Part) -> Iterator[Diagnostic]:
    choices: list[Variable] = []
    if any(_closes(part.node) for part in whole.statements(MethodCall)):
        return
    for part in whole.parts:
        for declaration in part.all(VariableDecl):
            for declarator in declaration.declarators:
                variable = part.tables.declared.get(declarator.name)
                if isinstance(variable, Variable) and variable.type.kind is Kind.OBJECT and variable.span is not None:
                    is_given = declarator.initialiser is not None or isinstance(part.node, ClassDecl)
                    if not is_given or _is_parameter(part, declaration):
                        choices.append(variable)
    if choices:
        notes = (Note(f"`{choices[0].name}` waits for that", choices[0].span),)
        fixes = tuple(map(_closing, _makers(whole.parts)[-1:]))
        yield UNCLOSED.at(first.node.span, notes=notes, help=_CLOSE, fixes=fixes)


def _unclosed_without_goals(whole: Whole) -> Iterator[Diagnostic]:
    """A hint: whether a mission flies the model, or another one includes it, is not known here."""
    makers = _makers(whole.parts)
    if makers and not any(_closes(part.node) for part in whole.statements(MethodCall)):
        for found in _left_open(whole.parts, makers[-1]):
            message = "no class is closed: in a mission no object would be chosen"
            help_ = f"where a mission flies it, {_CLOSE}"
            yield replace(found, severity=Severity.HINT, message=message, help=help_, fixes=())


def unclosed_in_mission(analysis: Analysis) -> tuple[Diagnostic, ...]:
    """Tell of a model without goals of its own that a mission flies, where rules leave open which object is meant."""
    if any(isinstance(node, GoalStatement) or _closes(node) for node in analysis.statements):
        return ()  # with goals of its own `lint_script` says it
    parts = [Part(node, analysis.by_statement[node], analysis.dialect) for node in analysis.statements]
    makers = _makers(parts)
    if not makers:
        return ()
    last = next((one for one in reversed(makers) if one.span.source is analysis.loaded.root), makers[-1])
    return suppress(analysis, tuple(_left_open(parts, last)), is_linted=False)


def _makers(parts: Iterable[Part]) -> list[Statement]:
    """The statements of a script that make objects."""
    return [each.node for each in parts if isinstance(each.node, VariableDecl | Assignment) and each.all(NewExpr)]


def _closes(node: Statement) -> bool:
    return isinstance(node, MethodCall) and node.method.name == "close"


def _left_open(parts: Iterable[Part], last: Statement) -> Iterator[Diagnostic]:
    """The complaint, at the last statement that makes an object, where a rule leaves open which one is meant."""
    choices = (variable for each in parts if isinstance(each.node, RuleDecl) for variable in _chosen_in(each))
    if (first := next(choices, None)) is not None:
        notes = (Note(f"`{first.name}` waits for that", first.span),)
        yield UNCLOSED.at(last.span, notes=notes, help=_CLOSE, fixes=(_closing(last),))


def _closing(last: Statement) -> Fix:
    """`close();` behind a statement."""
    after = Span(last.span.anchor, last.span.end, last.span.end)
    return Fix("close the classes here", (Edit(after, "\nclose();"),), safe=False)


def _chosen_in(part: Part) -> Iterator[Variable]:
    """The variables of a rule that may be one of several objects, and that no `==` says it is."""
    said: set[object] = set()
    for constraint in part.all(ExprConstraint):
        expression = constraint.expression
        if isinstance(expression, BinaryExpr) and expression.op == "==":
            sides = [
                part.reference(each) if isinstance(each, PathExpr) else None
                for each in (expression.left, expression.right)
            ]
            if None not in sides:
                said.update(getattr(each, "variable", None) for each in sides if not isinstance(each, GlobalReference))
    for declaration in part.all(VariableDecl):
        for declarator in declaration.declarators:
            variable = part.tables.declared.get(declarator.name)
            is_given = declarator.initialiser is not None or variable in said
            if isinstance(variable, Variable) and variable.type.kind is Kind.OBJECT and not is_given:
                yield variable


def _is_parameter(part: Part, declaration: VariableDecl) -> bool:
    return any(declaration in predicate.body for predicate in part.all(PredicateDecl))
