"""Find subgoals that leave open what was probably meant: which object, which of several predicates."""

from collections.abc import Iterator

from nddl_lang.lint.codes import ANY_OBJECT, ANY_OF_MANY
from nddl_lang.lint.part import Facts, Finding, Part
from nddl_lang.semantics.schema import TokenVariableReference
from nddl_lang.syntax.nodes import Instance, PathExpr, Relation, RuleDecl
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix


def lint_subgoals(part: Part) -> Iterator[Finding]:
    """`meets(T.b q)` in a rule of `T`, and `any(...)` of a predicate that several classes have."""
    if not isinstance(part.node, RuleDecl):
        return
    own = part.tables.predicates.get(part.node)
    if own is None:
        return
    placed = {
        reference.label
        for path in part.all(PathExpr)
        if isinstance(reference := part.reference(path), TokenVariableReference) and reference.name == "object"
    }
    for instance in part.all(Instance):
        target = part.tables.targets.get(instance)
        if target is None or target.object != "any" or target.predicate.class_name != own.class_name:
            continue
        if target.label is None or target.label not in placed:
            yield _any_object(instance, own.class_name)
    for relation in part.all(Relation):
        if relation.relation.name != "any":
            continue
        for instance in relation.created:
            if (wanted := part.predicate_of(instance)) is not None and instance.name is None:
                yield _any_of_many(relation, wanted.class_name, wanted.name)


def _any_object(instance: Instance, owner: str) -> Finding:
    def finding(facts: Facts) -> Diagnostic | None:
        if len(facts.objects.get(owner, ())) == 1:
            return None
        head = instance.path.parts[0]
        fix = Fix("write `object`", (Edit(head.span, "object"),), safe=False)
        help_ = f"write `object.{instance.path.parts[-1].name}` for the same object, or say which: `q.object == ...`"
        text = instance.path.span.text
        return ANY_OBJECT.at(instance.path.span, help=help_, fixes=(fix,), text=text, owner=owner)

    return finding


def _any_of_many(relation: Relation, owner: str, name: str) -> Finding:
    def finding(facts: Facts) -> Diagnostic | None:
        schema = facts.schema
        others = [
            each.name
            for each in schema.classes.values()
            if name in each.predicates
            and not schema.is_subclass(each.name, owner)
            and not schema.is_subclass(owner, each.name)
        ]
        if not others:
            return None
        help_ = f"`{others[0]}` has a predicate of this name too; name the relation that is meant"
        return ANY_OF_MANY.at(relation.span, help=help_, name=name)

    return finding
