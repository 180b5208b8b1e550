"""Find what a whole model declares and never uses.

Only what the linted text declares itself is judged, and only if the model is whole: a text that others include may
declare for them.
"""

from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from nddl_lang.lint.codes import (
    FREE_PARAMETER,
    UNUSED_GLOBAL,
    UNUSED_MEMBER,
    UNUSED_PARAMETER,
    UNUSED_TYPE,
    UNUSED_VALUE,
)
from nddl_lang.lint.part import Part
from nddl_lang.lint.whole import Whole
from nddl_lang.semantics.schema import Kind, Predicate, Variable
from nddl_lang.syntax.nodes import (
    ClassDecl,
    EnumDecl,
    NewExpr,
    PredicateDecl,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.removal import removal, undeclare
from nddl_lang.text.diagnostic import Diagnostic, Fix

AGENT_TIMELINE = "AgentTimeline"


def lint_declarations(whole: Whole) -> Iterator[Diagnostic]:
    """Names that nothing in the model refers to."""
    if not whole.is_whole:
        return
    used = whole.usage.variables
    for part in whole.own(VariableDecl):
        yield from _globals(whole, part, used)
    for part in whole.own(ClassDecl):
        assert isinstance(part.node, ClassDecl)
        yield from _members(whole, part, part.node)
        if not whole.gist_of[part].parameters <= used:
            yield from _parameters(whole, part, part.node)
    for part in whole.own(EnumDecl):
        assert isinstance(part.node, EnumDecl)
        yield from _values(whole, part.node)
    for part in whole.own(TypedefDecl):
        assert isinstance(part.node, TypedefDecl)
        name = part.node.name
        if name.name not in whole.usage.words:
            fix = Fix(f"remove `{name.name}`", (removal(part.node.span),))
            yield UNUSED_TYPE.at(name.span, fixes=(fix,), what="typedef", name=name.name)


def _globals(whole: Whole, part: Part, used: AbstractSet[object]) -> Iterator[Diagnostic]:
    node = part.node
    assert isinstance(node, VariableDecl)
    for index, declarator in enumerate(node.declarators):
        variable = part.tables.declared.get(declarator.name)
        if not isinstance(variable, Variable) or variable.type.kind is Kind.OBJECT or variable in used:
            continue
        if variable.name in whole.usage.words or isinstance(declarator.initialiser, NewExpr):
            continue
        # What somebody wrote down is often read by a line that is missing.
        fix = undeclare(node, index, safe=declarator.initialiser is None)
        is_given = variable in whole.usage.written
        done, fixes = ("read", ()) if is_given else ("used", (fix,))
        yield UNUSED_GLOBAL.at(declarator.name.span, fixes=fixes, name=variable.name, done=done)


def _members(whole: Whole, part: Part, node: ClassDecl) -> Iterator[Diagnostic]:
    for declaration in node.members or ():
        if not isinstance(declaration, VariableDecl):
            continue
        for declarator in declaration.declarators:
            member = part.tables.declared.get(declarator.name)
            if isinstance(member, Variable) and member not in whole.usage.variables:
                done = "read" if member in whole.usage.written else "used"
                if member.type.kind is Kind.OBJECT and done == "read":
                    continue  # the object that it holds may be what counts
                yield UNUSED_MEMBER.at(declarator.name.span, name=member.name, owner=node.name.name, done=done)


def _values(whole: Whole, node: EnumDecl) -> Iterator[Diagnostic]:
    name = node.name.name
    if name not in whole.usage.words and not any(value.name in whole.usage.words for value in node.values):
        fix = Fix(f"remove `{name}`", (removal(node.span),))
        yield UNUSED_TYPE.at(node.name.span, fixes=(fix,), what="enum", name=name)
        return
    # Where no value is ever written, all of them are for a search to choose from.
    if sum(value.name in whole.usage.words for value in node.values) < 2:
        return
    for value in node.values:
        if value.name not in whole.usage.words:
            yield UNUSED_VALUE.at(value.span, name=value.name, enum=name)


def _parameters(whole: Whole, part: Part, node: ClassDecl) -> Iterator[Diagnostic]:
    owner = whole.analysis.schema.classes.get(node.name.name)
    if owner is None or AGENT_TIMELINE in whole.ancestry(owner.name):
        return  # tokens of shared timelines come from other reactors, with their parameters
    for declaration in node.members or ():
        if isinstance(declaration, PredicateDecl):
            predicate = owner.predicates.get(declaration.name.name)
            if predicate is not None and predicate.name in whole.usage.requested:
                yield from _free(whole, part, declaration, predicate)


def _free(whole: Whole, part: Part, node: PredicateDecl, predicate: Predicate) -> Iterator[Diagnostic]:
    used = whole.usage.variables
    for declaration in node.body:
        if not isinstance(declaration, VariableDecl):
            continue
        for declarator in declaration.declarators:
            variable = part.tables.declared.get(declarator.name)
            if not isinstance(variable, Variable) or variable in used or declarator.initialiser is not None:
                continue
            is_open = variable.type.kind in (Kind.INT, Kind.FLOAT, Kind.STRING) and variable.type.restriction is None
            code = FREE_PARAMETER if is_open else UNUSED_PARAMETER
            help_ = "no search decides it: its values are without end" if is_open else None
            yield code.at(declarator.name.span, help=help_, name=variable.name, predicate=predicate.full_name)
