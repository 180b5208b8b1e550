"""Find names inside one rule or constructor that nothing uses, and names that hide others."""

from collections.abc import Collection, Iterator, Sequence
from itertools import takewhile

from nddl_lang.lint.codes import (
    HIDDEN_GLOBAL,
    HIDDEN_LOCAL,
    HIDDEN_PARAMETER,
    HIDDEN_TOKEN,
    UNUSED_FORMAL,
    UNUSED_LABEL,
    UNUSED_LOCAL,
)
from nddl_lang.lint.part import Facts, Finding, Part, mentioned_labels
from nddl_lang.lint.reading import domain_of
from nddl_lang.semantics.schema import (
    GlobalReference,
    Kind,
    LocalReference,
    MemberReference,
    TokenVariableReference,
    Variable,
)
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    ConstructorDecl,
    Declarator,
    ExprConstraint,
    Foreach,
    FormalParameter,
    Identifier,
    IfStatement,
    Instance,
    NewExpr,
    PathExpr,
    PredicateDecl,
    RuleDecl,
    VariableDecl,
)
from nddl_lang.syntax.removal import undeclare
from nddl_lang.text.diagnostic import Code, Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span


def used_variables(part: Part, but: Collection[object] = ()) -> set[Variable]:
    """The variables that a statement refers to, apart from declaring them and in the names `but`."""
    used: set[Variable] = set()
    for node, reference in part.tables.references.items():
        if node in but:
            continue
        base = reference.base if isinstance(reference, MemberReference) else reference
        if isinstance(base, LocalReference | GlobalReference):
            used.add(base.variable)
        elif isinstance(base, TokenVariableReference):
            used.update(p for p in base.label.predicate.parameters if p.name == base.name)
        if isinstance(reference, MemberReference):
            used.update(reference.members)
    return used


def lint_unused_locals(part: Part) -> Iterator[Finding]:
    """A rule's local variable, or a constructor's parameter, that nothing refers to."""
    if isinstance(part.node, RuleDecl):
        used = used_variables(part)
        read = used_variables(part, _given_names(part))
        for node in part.all(VariableDecl):
            for index, declarator in enumerate(node.declarators):
                variable = part.tables.locals.get(declarator)
                if variable is None or variable in read or isinstance(declarator.initialiser, NewExpr):
                    continue
                if variable in used:
                    if declarator.initialiser is None and variable.type.restriction is None:
                        help_ = f"nothing depends on `{variable.name}`: use it where its value counts, or remove it"
                        yield UNUSED_LOCAL.at(declarator.name.span, help=help_, name=variable.name, done="read")
                elif declarator.name.span not in _hidden_places(part):
                    yield _unused_local(node, index, declarator, variable)
        for loop in part.all(Foreach):
            turned = part.tables.declared.get(loop.variable)
            if isinstance(turned, Variable) and turned not in used and loop.body:
                help_ = "each turn of the loop asks for the same; say of which object it speaks"
                yield UNUSED_LOCAL.at(loop.variable.span, help=help_, name=loop.variable.name, done="used")
    elif constructors := part.all(ConstructorDecl):
        used = used_variables(part)
        for constructor in constructors:
            for formal in constructor.parameters:
                declared = part.tables.declared.get(formal.name)
                if isinstance(declared, Variable) and declared not in used:
                    yield UNUSED_FORMAL.at(formal.name.span, name=formal.name.name)


def _given_names(part: Part) -> set[object]:
    """Names that stand in a rule for nothing but to get a constant; what is drawn and not used NDDL562 tells."""
    names: set[object] = set()
    for one in part.all(ExprConstraint):
        match one.expression:
            case BinaryExpr(op="==", left=PathExpr(parts=parts) as left, right=right):
                if not isinstance(right, PathExpr) and domain_of(part, right) is not None:
                    names |= {left, *parts}
    return names


def _unused_local(node: VariableDecl, index: int, declarator: Declarator, variable: Variable) -> Finding:
    help_ = None
    if variable.type.kind is Kind.OBJECT:
        help_ = "a search has to choose an object for it all the same"
    is_free = variable.type.kind in (Kind.INT, Kind.FLOAT, Kind.STRING) and declarator.initialiser is None
    fix = undeclare(node, index, safe=is_free)
    return UNUSED_LOCAL.at(declarator.name.span, help=help_, fixes=(fix,), name=variable.name, done="used")


def lint_unused_labels(part: Part) -> Iterator[Finding]:
    """A child token whose name nothing refers to."""
    if not isinstance(part.node, RuleDecl):
        return
    mentioned = set(mentioned_labels(part))
    for instance in part.all(Instance):
        label = part.label_of(instance)
        if label is None or instance.name is None or label in mentioned:
            continue
        if instance.name.span not in _hidden_places(part):
            yield UNUSED_LABEL.at(instance.name.span, name=label.name)


def _hidden_places(part: Part) -> set[Span]:
    """Where names stand that another one hides: who is told that need not be told that the first is unused."""
    told = (each for each in lint_hidden_names(part) if isinstance(each, Diagnostic))
    return {note.span for finding in told for note in finding.notes if note.span is not None}


def lint_hidden_names(part: Part) -> Iterator[Finding]:
    """A local or a label that takes the name of something else which is visible."""
    if not isinstance(part.node, RuleDecl):
        return
    predicate = part.tables.predicates.get(part.node)
    parameters = {p.name: p for p in predicate.parameters} if predicate is not None else {}
    # Blocks with the names visible in them: names of one branch do not reach the other.
    pending: list[tuple[tuple[object, ...], dict[str, Identifier]]] = [(part.node.body, {})]
    while pending:
        body, outer = pending.pop()
        visible = dict(outer)
        for statement in body:
            match statement:
                case VariableDecl(declarators=declarators):
                    for declarator in declarators:
                        name = declarator.name
                        if name.name in parameters:
                            notes = _note(parameters[name.name])
                            help_ = f"the parameter stays free; `{name.name}` means the local from here on"
                            yield HIDDEN_PARAMETER.at(name.span, help=help_, notes=notes, name=name.name)
                        else:
                            yield from _hidden(visible, name, twice=_said_twice(body, statement))
                            yield from _hidden_by_others(part, name)
                        visible[name.name] = name
                case IfStatement(then=then, otherwise=otherwise):
                    pending += [(block, visible) for block in (then, otherwise) if block]
                case Foreach(variable=name, body=inner):
                    yield from _hidden(visible, name)
                    pending.append((inner, {**visible, name.name: name}))
                case _:
                    for instance in getattr(statement, "created", ()):
                        if instance.name is not None:
                            yield from _hidden(visible, instance.name, HIDDEN_TOKEN)
                            visible[instance.name.name] = instance.name


def _note(variable: Variable) -> tuple[Note, ...]:
    return (Note("the parameter is declared here", variable.span),) if variable.span is not None else ()


def _said_twice(body: Sequence[object], declared: VariableDecl) -> Span | None:
    """A declaration that stands in the block before, word for word: where it stands the second time."""
    before = takewhile(lambda one: one is not declared, body)
    is_twice = any(isinstance(one, VariableDecl) and one.span.text == declared.span.text for one in before)
    return declared.span if is_twice else None


def _hidden(
    visible: dict[str, Identifier], name: Identifier, code: Code = HIDDEN_LOCAL, twice: Span | None = None
) -> Iterator[Finding]:
    first = visible.get(name.name)
    if first is not None:
        note = Note("the one that is hidden is declared here", first.span)
        fixes = () if twice is None else (Fix("leave out the second one", (Edit(twice, ""),), safe=False),)
        help_ = "give one of the two another name" if code is HIDDEN_LOCAL else None
        if twice is not None:
            help_ = f"`{twice.text}` stands there twice: leave out the second one"
        yield code.at(name.span, notes=(note,), name=name.name, help=help_, fixes=fixes)


def _hidden_by_others(part: Part, name: Identifier) -> Iterator[Finding]:
    def finding(facts: Facts) -> Diagnostic | None:
        hidden = facts.schema.globals.get(name.name)
        if hidden is None or hidden.span is None:
            return None
        note = Note("the global variable is declared here", hidden.span)
        return HIDDEN_GLOBAL.at(name.span, notes=(note,), name=name.name)

    if part.tables.declared.get(name) is not None:
        yield finding


def named_variables(part: Part) -> list[Identifier]:
    """The names of the variables that a statement declares: parameters, formal ones, local and global variables."""
    if isinstance(part.node, RuleDecl | VariableDecl):
        return [each.name for node in part.all(VariableDecl) for each in node.declarators]
    names: list[Identifier] = []
    for predicate in part.all(PredicateDecl):
        for statement in predicate.body:
            if isinstance(statement, VariableDecl):
                names += [each.name for each in statement.declarators]
    return [*names, *(formal.name for formal in part.all(FormalParameter))]
