"""A place where somebody types in; the names that may stand there out."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from lsprotocol.types import CompletionItem, CompletionItemKind

from lsp.describe import parameter_text
from lsp.meaning import WORDS, piece_at
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.functions import METHODS, Receiver
from nddl_lang.semantics.natives import builtin_names, builtin_type
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.semantics.schema import Kind, Label, Predicate, Schema, Type, Variable
from nddl_lang.semantics.types import BASIC_TYPES
from nddl_lang.syntax.parser import Parse

_BEFORE = re.compile(r"(?P<path>(?:[A-Za-z_$][\w$]*\s*(?:\.|::)\s*)*)[\w$]*\Z")
_RULE = re.compile(r"([A-Za-z_$][\w$]*)\s*::\s*([A-Za-z_$][\w$]*)\s*\{")
# Nobody names more in front of a dot.
_LONGEST_PATH = 400

_Items = Iterator[CompletionItem]


@dataclass(frozen=True, slots=True)
class _Place:
    """What is known around the cursor: the names of the statement, and the predicate of the rule."""

    analysis: Analysis
    variables: dict[str, Variable]
    labels: dict[str, Label]
    predicate: Predicate | None

    @property
    def schema(self) -> Schema:
        return self.analysis.schema


def completions(analysis: Analysis, parse: Parse, offset: int) -> list[CompletionItem]:
    """What may stand at `offset`, each name once, the nearest declarations first."""
    text = parse.source.text
    before = _BEFORE.search(text, max(0, offset - _LONGEST_PATH), offset)
    path = re.findall(r"[\w$]+|::|\.", before["path"]) if before is not None else []
    place = _place(analysis, parse, offset)
    if not path:
        items = _names(place)
    elif path[-1] == "::":
        items = _predicates(place.schema, path[-2])
    else:
        items = _members(place, [part for part in path if part not in (".", "::")])
    found: dict[str, CompletionItem] = {}
    for item in items:
        found.setdefault(item.label, item)
    return [_sorted(item, number) for number, item in enumerate(found.values())]


def _sorted(item: CompletionItem, number: int) -> CompletionItem:
    item.sort_text = f"{number:04}"
    return item


def _place(analysis: Analysis, parse: Parse, offset: int) -> _Place:
    piece = piece_at(parse, offset)
    variables: dict[str, Variable] = {}
    labels: dict[str, Label] = {}
    predicate = None
    if piece is not None:
        for name, declared in analysis.tables.declared.items():
            if name.span.anchor is piece.anchor:
                if isinstance(declared, Variable):
                    variables[declared.name] = declared
                elif isinstance(declared, Label):
                    labels[declared.name] = declared
        if (rule := _RULE.search(piece.text)) is not None:
            predicate = analysis.schema.find_predicate(rule[1], rule[2])
    return _Place(analysis, variables, labels, predicate)


def _names(place: _Place) -> _Items:
    schema = place.schema
    for label in place.labels.values():
        yield _item(label.name, CompletionItemKind.Variable, label.predicate.full_name)
    for variable in place.variables.values():
        yield _variable(variable)
    if place.predicate is not None:
        yield from _token_variables(place.predicate)
        yield from _predicates(schema, place.predicate.class_name)
    for variable in schema.globals.values():
        yield _variable(variable)
    for label in schema.goals.values():
        yield _item(label.name, CompletionItemKind.Variable, label.predicate.full_name)
    for value in schema.enum_values.values():
        yield _item(value.value, CompletionItemKind.EnumMember, value.enum)
    for owner in schema.classes.values():
        yield _item(owner.name, CompletionItemKind.Class, f"extends {owner.base}" if owner.base else None)
    for name in (*schema.enums, *schema.typedefs, *BASIC_TYPES):
        yield _item(name, CompletionItemKind.TypeParameter, None)
    for row in RELATIONS.values():
        yield _item(row.name, CompletionItemKind.Operator, row.meaning)
    callables = place.analysis.callables
    for constraint in callables.constraints.values():
        yield _item(constraint.name, CompletionItemKind.Function, f"({constraint.signature.text}) {constraint.meaning}")
    for function in callables.functions.values():
        yield _item(function.name, CompletionItemKind.Function, f"({function.signature.text}) {function.meaning}")
    for word in WORDS:
        yield _item(word, CompletionItemKind.Keyword, None)


def _members(place: _Place, path: list[str]) -> _Items:
    """What may follow the dot after `path`."""
    schema, (head, *rest) = place.schema, path
    label = place.labels.get(head) or schema.goals.get(head)
    predicate = label.predicate if label is not None else place.predicate if head == "this" else None
    type_: Type | None = None
    if predicate is not None:
        if not rest:
            yield from _token_variables(predicate)
            if label is not None:
                yield from _methods(Receiver.TOKEN)
            return
        type_ = _type_in(predicate, rest.pop(0))
    else:
        if head in schema.classes and not rest:
            yield from _predicates(schema, head)
            yield from _methods(Receiver.CLASS)
            return
        if head in schema.enums and not rest:
            yield from (_item(value, CompletionItemKind.EnumMember, head) for value in schema.enums[head].values)
            return
        variable = place.variables.get(head) or schema.globals.get(head)
        if variable is not None:
            type_ = variable.type
        elif place.predicate is not None:
            type_ = _type_in(place.predicate, head)
    for part in rest:
        member = schema.find_member(type_.base, part) if type_ is not None else None
        type_ = member.type if member is not None else None
    if type_ is None:
        return
    if type_.kind is Kind.OBJECT:
        for name in schema.ancestry(type_.base):
            yield from (_variable(member) for member in schema.classes[name].members.values())
        yield from _predicates(schema, type_.base)
        yield from _methods(Receiver.OBJECT)
    yield from _methods(Receiver.VARIABLE)


def _type_in(predicate: Predicate, name: str) -> Type | None:
    found = next((each.type for each in predicate.parameters if each.name == name), None)
    return found or builtin_type(name, predicate)


def _predicates(schema: Schema, class_name: str) -> _Items:
    owner = schema.classes.get(class_name)
    if owner is not None:
        for predicate in (*owner.predicates.values(), *owner.inherited.values()):
            parameters = ", ".join(parameter_text(each) for each in predicate.parameters)
            yield _item(predicate.name, CompletionItemKind.Method, f"{predicate.full_name}({parameters})")


def _token_variables(predicate: Predicate) -> _Items:
    for parameter in predicate.parameters:
        yield _variable(parameter)
    for name in builtin_names(predicate.is_event):
        yield _item(name, CompletionItemKind.Field, WORDS.get(name))


def _methods(receiver: Receiver) -> Iterable[CompletionItem]:
    return [
        _item(row.name, CompletionItemKind.Method, f"({row.signature.text}) {row.meaning}")
        for row in METHODS.values()
        if row.receiver is receiver
    ]


def _variable(variable: Variable) -> CompletionItem:
    return _item(variable.name, CompletionItemKind.Variable, parameter_text(variable))


def _item(name: str, kind: CompletionItemKind, detail: str | None) -> CompletionItem:
    return CompletionItem(name, kind=kind, detail=detail)
