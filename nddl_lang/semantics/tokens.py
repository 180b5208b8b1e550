"""Check what creates tokens and relates them: instances such as `object.p q`, and relations."""

from collections.abc import Sequence
from dataclasses import replace

from nddl_lang.semantics.codes import (
    DUPLICATE_TOKEN,
    MISPLACED_THIS,
    MISSING_OBJECT,
    MISSING_ORIGIN,
    NO_OBJECT_PREFIX,
    NO_OBJECT_YET,
    THIS_AS_OBJECT,
    UNKNOWN_PREDICATE,
    UNKNOWN_RELATION,
    UNKNOWN_TOKEN,
    WHOLE_BOUNDS,
    WRONG_COUNT,
)
from nddl_lang.semantics.expressions import type_of
from nddl_lang.semantics.names import (
    MOST_NAMED,
    TOKEN_OF_SCRIPT,
    complain_unknown,
    find,
    find_script_token,
    listed,
    resolve_dotted,
    suggest_name,
)
from nddl_lang.semantics.owned_names import labels_of, only_one
from nddl_lang.semantics.relations import REFUSED_RELATIONS, RELATIONS, RelationRow
from nddl_lang.semantics.schema import (
    Class,
    ClassReference,
    Kind,
    Label,
    Predicate,
    Reference,
    Target,
    TokenReference,
    TokenVariableReference,
)
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.types import object_type, phrase, reference_type
from nddl_lang.semantics.values import constant
from nddl_lang.syntax.nodes import Identifier, Instance, IntervalExpr, PathExpr, Relation
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span


def check_relation(context: Context, scope: Scope, node: Relation) -> list[Label | None]:
    """Check a relation; the labels of the tokens that it creates, in order."""
    row = _find_relation(context, node.relation)
    if node.created and (complaint := _between_tokens(context, scope, node)) is not None:
        context.complain(complaint)
        return [None] * len(node.created)
    origin = _find_origin(context, scope, node)
    if origin is not None:
        context.tables.origins[node] = origin
    if row is not None and node.bounds:
        _check_bounds(context, scope, node, row)
    if node.existing is not None:
        _check_existing(context, scope, node, node.existing)
    return check_instances(context, scope, node.created)


def _between_tokens(context: Context, scope: Scope, node: Relation) -> Diagnostic | None:
    """What is wrong with `before(a, b)` and `before(a)`, where these are tokens that exist; else None."""
    names: list[Identifier] = []
    for instance in node.created:
        (name, *rest) = instance.path.parts
        is_bare = not rest and instance.name is None and instance.role is None
        if not is_bare or not (scope.find_label(name.name) or find_script_token(context, scope, name.name)):
            return None
        if scope.own_class is not None and context.symbols.find_predicate(scope.own_class, name.name) is not None:
            return None
        names.append(name)
    has_origin = node.origin is not None
    if len(names) > 2 or (len(names) == 2 and has_origin) or (len(names) == 1 and not has_origin and scope.own is None):
        return None
    first, last = names[0], names[-1]
    text, base = node.span.text, node.span.start
    opener = text.rfind("(", 0, first.span.start - base)
    closer = text.find(")", last.span.end - base)
    if opener < 0 or closer < 0:
        return None
    relation = text[node.relation.span.start - base : opener].rstrip()
    origin = node.origin if len(names) == 1 else first
    named = [] if origin is None or origin.name == "this" else [origin.name]
    written = " ".join([*named, relation, last.name])
    at = Span(node.span.anchor, base, base + closer + 1)
    fix = Fix(f"write `{written}`", (Edit(at, written),))
    help_ = f"without parentheses a relation leads to a token that exists: `{written}`"
    if scope.own_class is not None:
        return UNKNOWN_PREDICATE.at(first.span, help=help_, fixes=(fix,), owner=scope.own_class, name=first.name)
    if node.origin is None:
        return MISSING_ORIGIN.at(node.relation.span, help=help_, fixes=(fix,))
    return MISSING_OBJECT.at(first.span, help=help_, fixes=(fix,), name=first.name)


def check_instances(context: Context, scope: Scope, instances: Sequence[Instance]) -> list[Label | None]:
    """The labels of the tokens that a goal or relation creates, in order."""
    labels: list[Label | None] = []
    for index, instance in enumerate(instances):
        complaint = _name_behind_comma(context, scope, instances[index - 1], instance) if index else None
        if complaint is None:
            labels.append(_check_instance(context, scope, instance))
        else:
            context.complain(complaint)
            _doubt(context, scope, instance.path.parts[0])
            labels.append(None)
    return labels


def _name_behind_comma(context: Context, scope: Scope, before: Instance, instance: Instance) -> Diagnostic | None:
    """What is wrong with `goal(a.p, g)`, where `g` is to be the name of the token; else None."""
    (name, *rest) = instance.path.parts
    if rest or instance.name is not None or before.name is not None or len(before.path.parts) == 1:
        return None
    fix = Fix("remove the comma", (Edit(Span(name.span.anchor, before.span.end, name.span.start), " "),), safe=False)
    help_ = f"the name of a token follows without a comma: `{before.span.text} {name.name}`"
    if scope.own_class is None:
        return MISSING_OBJECT.at(name.span, help=help_, fixes=(fix,), name=name.name)
    if context.symbols.find_predicate(scope.own_class, name.name) is not None:
        return None
    return UNKNOWN_PREDICATE.at(name.span, help=help_, fixes=(fix,), owner=scope.own_class, name=name.name)


def _check_instance(context: Context, scope: Scope, instance: Instance) -> Label | None:
    """Check what `object.p q` creates and let its name be known; its label, None where it has none."""
    target = _find_target(context, scope, instance.path)
    if target is None:
        if instance.name is not None or len(instance.path.parts) == 1:
            _doubt(context, scope, instance.name or instance.path.parts[0])
        return None
    predicate, source = target
    label = None
    if instance.name is not None:
        label = Label(instance.name.name, predicate, instance.name.span)
        context.tables.declared[instance.name] = label
    if scope.kind is BlockKind.SCRIPT:
        if not context.symbols.has_objects(predicate.class_name) and not context.symbols.is_doubtful("new"):
            context.complain(NO_OBJECT_YET.at(instance.span, name=predicate.class_name))
        if label is not None and instance.name is not None and not _declare_goal(context, label, instance.name):
            label = None
    elif label is not None:
        scope.name_token(label)
    else:
        scope.ask_unnamed(instance.path)
    context.tables.targets[instance] = Target(predicate, source, label)
    return label


def _find_token(context: Context, scope: Scope, name: Identifier, relation: Relation) -> Label | None:
    """The token of that name; a complaint where there is none, with a name that stands on the other side never."""
    label = scope.find_label(name.name) or find_script_token(context, scope, name.name)
    if label is not None:
        context.tables.references[name] = TokenReference(label)
        return label
    if name.name == "this":
        context.complain(MISPLACED_THIS.at(name.span, place=scope.kind.value))
    elif (other := find(context, scope, name.name)) is not None:
        what = "a class" if isinstance(other, ClassReference) else "a variable"
        help_ = f"`{name.name}` is {what}; relations link tokens"
        context.complain(UNKNOWN_TOKEN.at(name.span, help=help_, name=name.name))
    elif context.symbols.find_goal(name.name) is not None:
        help_ = TOKEN_OF_SCRIPT.format(name=name.name)
        context.complain(UNKNOWN_TOKEN.at(name.span, help=help_, name=name.name))
    elif any(
        is_known(name.name)
        for is_known in (scope.lost_at, scope.unnamed, scope.declared_below, context.symbols.declared_below)
    ):
        complain_unknown(context, scope, name)
    elif not scope.is_doubtful(name.name) and not context.symbols.is_doubtful(name.name):
        complaint = UNKNOWN_TOKEN.at(name.span, name=name.name)
        if scope.own_class is not None and context.symbols.find_predicate(scope.own_class, name.name) is not None:
            text = f"({name.name})"
            fix = Fix(f"write `{text}`", (Edit(name.span, text),))
            help_ = f"a name in parentheses creates a token: `{text}`"
            complaint = UNKNOWN_TOKEN.at(name.span, help=help_, fixes=(fix,), name=name.name)
            context.complain(complaint)
        elif scope.kind is BlockKind.SCRIPT:
            labels = [*scope.visible_labels(), *context.symbols.names("goal")]
            context.complain(suggest_name(complaint, name, [each for each in labels if each not in _linked(relation)]))
        else:
            labels = [label for label in scope.visible_labels() if label not in _linked(relation)]
            alike = [label for label in labels if _is_of(scope.find_label(label), name.name)]
            context.complain(suggest_name(complaint, name, labels, alike[0] if len(alike) == 1 else None))
    return None


def _linked(relation: Relation) -> set[str]:
    """The names of the tokens that a relation links."""
    target = relation.existing.parts[0] if relation.existing is not None else None
    return {name.name for name in (relation.origin, target) if name is not None}


def _is_of(label: Label | None, predicate: str) -> bool:
    """Whether a token is one of a predicate, whose name people write for it."""
    return label is not None and label.predicate.name.casefold() == predicate.casefold()


def find_predicate(context: Context, owner: Class, name: Identifier, *, is_bare: bool = False) -> Predicate | None:
    """The predicate of a class; a complaint where it has none of that name, which may stand without its object."""
    found = context.symbols.find_predicate(owner.name, name.name)
    if found is None and not context.symbols.is_partial(owner.name) and not context.symbols.is_doubtful(name.name):
        notes = (Note(f"`{owner.name}` is declared here", owner.span),) if owner.span is not None else ()
        complaint = UNKNOWN_PREDICATE.at(name.span, notes=notes, owner=owner.name, name=name.name)
        own = [*owner.predicates, *owner.inherited]
        others = [other for other in context.symbols.names("class") if _has_predicate(context, other, name.name)]
        # Whose class is named has misspelt the predicate rather than the class.
        if others and (is_bare or suggest_name(complaint, name, own) is complaint):
            help_ = (
                "write " + " or ".join(f"`{other}.{name.name}`" for other in others[:3]) + " for that of another class"
            )
            fixes = tuple(
                Fix(f"write `{other}.{name.name}`", (Edit(name.span, f"{other}.{name.name}"),), safe=False)
                for other in others[:3]
                if is_bare
            )
            complaint = UNKNOWN_PREDICATE.at(
                name.span, notes=notes, help=help_, fixes=fixes, owner=owner.name, name=name.name
            )
        complaint = suggest_name(complaint, name, own)
        if not complaint.fixes and not is_bare and 0 < len(own) <= MOST_NAMED:
            named = f"its {listed('predicate', own)}"
            complaint = replace(complaint, help="; ".join(each for each in (named, complaint.help) if each))
        if is_bare and complaint.help is None:
            help_ = "the name of a token follows its predicate without a comma: `object.predicate name`"
            complaint = replace(complaint, help=help_)
        context.complain(complaint)
    return found


def _has_predicate(context: Context, class_name: str, name: str) -> bool:
    owner = context.symbols.find_class(class_name)
    return owner is not None and name in owner.predicates


def _find_relation(context: Context, name: Identifier) -> RelationRow | None:
    row = RELATIONS.get(name.name)
    if row is None:
        meant = REFUSED_RELATIONS.get(name.name)
        fixes = (Fix(f"write `{meant}`", (Edit(name.span, meant),)),) if meant is not None else ()
        context.complain(UNKNOWN_RELATION.at(name.span, fixes=fixes, name=name.name))
    return row


def _find_origin(context: Context, scope: Scope, node: Relation) -> Label | None:
    if node.origin is not None:
        return _find_token(context, scope, node.origin, node)
    if scope.own is None:
        context.complain(MISSING_ORIGIN.at(node.relation.span))
    return scope.own


def _check_bounds(context: Context, scope: Scope, node: Relation, row: RelationRow) -> None:
    expected, found = len(row.distances), len(node.bounds)
    if found > expected:
        count = "no bounds" if expected == 0 else "1 bound" if expected == 1 else f"at most {expected} bounds"
        span = node.bounds[expected].span
        context.complain(WRONG_COUNT.at(span, name=row.name, expected=count, found=found))
    for bound in node.bounds:
        _check_bound(context, scope, bound)


def _check_bound(context: Context, scope: Scope, bound: IntervalExpr) -> None:
    type_ = type_of(context, scope, bound)
    if type_ is None:
        return
    if type_.kind is not Kind.INT or constant(context, bound) is None:
        context.complain(WHOLE_BOUNDS.at(bound.span, text=bound.span.text))


def _check_existing(context: Context, scope: Scope, node: Relation, path: PathExpr) -> None:
    if len(path.parts) > 1:
        alike = _labels_of(context, scope, path, node)
        named = f": {' or '.join(f'`{each}`' for each in alike)}" if alike else ""
        help_ = f"a token is known by a single name{named}"
        fixes = only_one(path.span, alike)
        context.complain(UNKNOWN_TOKEN.at(path.span, help=help_, fixes=fixes, name=path.span.text))
        return
    label = _find_token(context, scope, path.parts[0], node)
    if label is not None:
        context.tables.existing[node] = label
        context.tables.references[path] = TokenReference(label)


def _labels_of(context: Context, scope: Scope, path: PathExpr, node: Relation) -> list[str]:
    """The tokens of a rule that are of the predicate which `path` names, but for the other end of a relation."""
    *prefix, name = [part.name for part in path.parts]
    is_class = len(prefix) == 1 and context.symbols.find_class(prefix[0]) is not None
    found = labels_of(context, scope, prefix[0] if is_class else None, name)
    return [one.name for one in found if one.name not in _linked(node)]


def _find_target(context: Context, scope: Scope, path: PathExpr) -> tuple[Predicate, Reference | str] | None:
    """The predicate that `a.b.p` names, and where the object comes from."""
    *prefix, name = path.parts
    if not prefix:
        return _find_own(context, scope, name)
    head = prefix[0]
    symbols = context.symbols
    if len(prefix) == 1 and (owner := symbols.find_class(head.name)) is not None:
        context.tables.references[head] = ClassReference(owner.name)
        context.tables.type_names[head] = object_type(owner.name)
        predicate = find_predicate(context, owner, name)
        return None if predicate is None else (predicate, "any")
    if head.name == "this" and scope.own is not None and len(prefix) == 1:
        fix = Fix("write `object`", (Edit(head.span, "object"),))
        context.complain(THIS_AS_OBJECT.at(head.span, help="write `object`, or leave it out", fixes=(fix,)))
        return None
    reference = find(context, scope, head.name) if len(prefix) == 1 else resolve_dotted(context, scope, prefix)
    if reference is None:
        if len(prefix) == 1:
            complain_unknown(context, scope, head, ("class",))
        return None
    context.tables.references[prefix[-1]] = reference
    type_ = reference_type(reference, scope.own_class)
    if type_ is None or type_.kind is not Kind.OBJECT or isinstance(reference, TokenReference):
        found = "a token" if isinstance(reference, TokenReference) else phrase(type_) if type_ else "a class"
        span = head.span.to(prefix[-1].span)
        context.complain(NO_OBJECT_PREFIX.at(span, name=span.text, type=found))
        return None
    owner = symbols.find_class(type_.base)
    predicate = find_predicate(context, owner, name) if owner is not None else None
    if predicate is None:
        return None
    is_own = (
        isinstance(reference, TokenVariableReference) and reference.label is scope.own and reference.name == "object"
    )
    return predicate, "own" if is_own else reference


def _find_own(context: Context, scope: Scope, name: Identifier) -> tuple[Predicate, Reference | str] | None:
    owner = context.symbols.find_class(scope.own_class) if scope.own_class is not None else None
    if owner is None:
        context.complain(MISSING_OBJECT.at(name.span, name=name.name))
        return None
    predicate = context.symbols.find_predicate(owner.name, name.name)
    if predicate is None:
        predicate = find_predicate(context, owner, name, is_bare=True)
    return None if predicate is None else (predicate, "own")


def _declare_goal(context: Context, label: Label, name: Identifier) -> bool:
    first = context.symbols.find_goal(label.name) or context.symbols.find_global(label.name)
    if first is not None:
        notes = (Note("the first declaration is here", first.span),) if first.span is not None else ()
        context.complain(DUPLICATE_TOKEN.at(name.span, notes=notes, name=label.name))
        return False
    context.symbols.put("goal", label.name, label)
    return True


def _doubt(context: Context, scope: Scope, name: Identifier) -> None:
    if scope.kind is BlockKind.SCRIPT:
        context.symbols.put_faulty(name.name)
    else:
        scope.doubt(name.name)
