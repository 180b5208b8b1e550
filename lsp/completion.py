"""A place where somebody types in; the names that may stand there out."""

import re
from collections.abc import Callable, Iterable, Iterator

from lsprotocol.types import CompletionItem, CompletionItemKind, InsertTextFormat, MarkupContent, MarkupKind

from lsp.completion_context import Situation, situation_at
from lsp.completion_place import Place, place_around
from lsp.describe import Describer, parameter_text
from lsp.expected_type import expected_types, rank, rank_of_class
from lsp.meaning import WORDS, piece_at
from lsp.rows import constraint_text, function_text, relation_head, relation_tail
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.functions import METHODS, Receiver
from nddl_lang.semantics.natives import builtin_names
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.semantics.schema import Kind, Predicate, Schema, Variable
from nddl_lang.semantics.types import BASIC_TYPES
from nddl_lang.syntax.parser import Parse
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.source import Span

_BEFORE = re.compile(r"(?P<path>(?:[A-Za-z_$][\w$]*\s*(?:\.|::)\s*)*)[\w$]*\Z")
# Nobody names more in front of a dot.
_LONGEST_PATH = 400

_Items = Iterator[CompletionItem]


def completions(analysis: Analysis, parse: Parse, offset: int, *, with_snippets: bool = False) -> list[CompletionItem]:
    """What may stand at `offset`, each name once, the likeliest first."""
    text = parse.source.text
    piece = piece_at(parse, offset)
    if piece is not None and any(
        start < offset - piece.anchor.offset and (offset - piece.anchor.offset < end or text[end - 1 : end] != "/")
        for start, end in piece.comments
        if start < offset - piece.anchor.offset <= end
    ):
        return []
    before = _BEFORE.search(text, max(0, offset - _LONGEST_PATH), offset)
    path = re.findall(r"[\w$]+|::|\.", before["path"]) if before is not None else []
    place = place_around(analysis, piece, offset)
    begun = before.start() if before is not None else offset
    situation = situation_at(piece, begun)
    if not path:
        items = _names(place, _known(place, piece, begun, situation), with_snippets)
    elif path[-1] == "::":
        items = _predicates(place.schema, path[-2])
    else:
        items = _members(place, [part for part in path if part not in (".", "::")], situation)
    found: dict[str, CompletionItem] = {}
    for item in items:
        found.setdefault(item.label, item)
    is_of_type = situation in (Situation.VALUE, Situation.NEW)
    expected = expected_types(place, piece, begun) if is_of_type else frozenset[str]()
    fits = rank_of_class if situation is Situation.NEW else rank
    ordered = sorted(found.values(), key=lambda item: fits(place, expected, item)) if not path else found.values()
    return [_sorted(item, number) for number, item in enumerate(ordered)]


def _known(place: Place, piece: Piece | None, begun: int, situation: Situation) -> Situation:
    """The situation, now that it is known what the word before names: only tokens have relations."""
    if situation is not Situation.RELATION or piece is None:
        return situation
    word = piece.text[: begun - piece.anchor.offset].split()[-1]
    return situation if place.token(word) is not None else Situation.NOTHING


def _sorted(item: CompletionItem, number: int) -> CompletionItem:
    item.sort_text = f"{number:04}"
    return item


def _names(place: Place, situation: Situation, with_snippets: bool) -> _Items:
    if with_snippets:
        yield from _snippets(place.schema, situation, {rule.predicate for rule in place.schema.rules})
    for group in _GROUPS[situation]:
        yield from group(place)


def _tokens(place: Place) -> _Items:
    for label in place.labels.values():
        yield _item(label.name, CompletionItemKind.Variable, label.predicate.full_name)


def _variables(place: Place) -> _Items:
    for variable in place.variables.values():
        yield _variable(variable)
    if place.predicate is not None:
        yield from _token_variables(place.predicate)


def _own_predicates(place: Place) -> _Items:
    if place.predicate is not None:
        yield from _predicates(place.schema, place.predicate.class_name)


def _globals(place: Place) -> _Items:
    for variable in place.globals().values():
        yield _variable(variable)


def _objects(place: Place) -> _Items:
    """What may stand before the dot of `object.predicate`."""
    parameters = place.predicate.parameters if place.predicate is not None else ()
    if place.predicate is not None:
        yield _item("object", CompletionItemKind.Field, WORDS["object"])
    for variable in (*place.variables.values(), *parameters, *place.globals().values()):
        if place.leads_to_predicates(variable.type):
            yield _variable(variable)
    for token in place.labels.values():
        if any(place.leads_to_predicates(each.type) for each in token.predicate.parameters):
            yield _item(token.name, CompletionItemKind.Variable, token.predicate.full_name)


def _goals(place: Place) -> _Items:
    for label in place.goals().values():
        yield _item(label.name, CompletionItemKind.Variable, label.predicate.full_name)


def _values(place: Place) -> _Items:
    for value in place.schema.enum_values.values():
        yield _item(value.value, CompletionItemKind.EnumMember, value.enum)


def _classes(place: Place) -> _Items:
    for owner in place.schema.classes.values():
        yield _item(owner.name, CompletionItemKind.Class, f"extends {owner.base}" if owner.base else None)


def _classes_of_tokens(place: Place) -> _Items:
    yield from (item for item in _classes(place) if place.has_predicates(item.label))


def _types(place: Place) -> _Items:
    for name in (*place.schema.enums, *place.schema.typedefs, *BASIC_TYPES):
        yield _item(name, CompletionItemKind.TypeParameter, None)


def _relations(place: Place) -> _Items:
    del place
    for row in RELATIONS.values():
        yield _item(row.name, CompletionItemKind.Operator, row.meaning)


def _constraints(place: Place) -> _Items:
    for row in place.analysis.callables.constraints.values():
        yield _item(row.name, CompletionItemKind.Function, f"({row.signature.text}) {row.meaning}")


def _functions(place: Place) -> _Items:
    for row in place.analysis.callables.functions.values():
        yield _item(row.name, CompletionItemKind.Function, f"({row.signature.text}) {row.meaning}")


def _own_members(place: Place) -> _Items:
    """The members of the class in whose constructor or predicate one types."""
    owner = place.owner
    for name in place.schema.ancestry(owner) if owner is not None else ():
        yield from (_variable(member) for member in place.schema.classes[name].members.values())


def _words(*words: str) -> Callable[[Place], _Items]:
    def offered(place: Place) -> _Items:
        del place
        yield from (_item(word, CompletionItemKind.Keyword, None) for word in words)

    return offered


_VALUES = (_variables, _tokens, _values, _globals, _functions, _words("new", "true", "false", "inf", "inff"))
_THINGS = (_tokens, _variables, _own_predicates, _globals)
_STATEMENTS = (_classes, _types, _relations, _constraints, _functions)
_GROUPS: dict[Situation, tuple[Callable[[Place], _Items], ...]] = {
    Situation.TOP: (
        _words("class", "enum", "typedef", "#include", "goal", "fact", "rejectable", "new", "close", "enforce"),
        _types,
        _classes,
        _globals,
        _goals,
        _constraints,
        _values,
        _functions,
    ),
    Situation.MEMBER: (_words("predicate", "action", "filter", "#include"), _types, _classes),
    Situation.PARAMETER: (_variables, _types, _classes, _constraints, _functions, _words("filter")),
    Situation.RULE: (
        *_THINGS,
        _values,
        *_STATEMENTS,
        _words("if", "else", "foreach", "enforce", "this", "filter"),
    ),
    Situation.BUILDING: (_words("super", "this"), _variables, _own_members, *_VALUES),
    Situation.INSTANCE: (_own_predicates, _objects, _classes_of_tokens, _words("condition", "effect")),
    Situation.CLASS: (_classes, _types),
    Situation.NEW: (_classes,),
    Situation.VALUE: (*_VALUES, _own_members, _goals, _classes),
    Situation.RELATION: (_relations,),
    Situation.TOKEN: (_tokens, _goals),
    Situation.NOTHING: (),
    Situation.ANYTHING: (*_THINGS, _goals, _values, *_STATEMENTS, _words(*WORDS)),
}


def _snippets(schema: Schema, situation: Situation, with_rules: set[Predicate]) -> _Items:
    """Whole statements with places to fill in."""
    match situation:
        case Situation.TOP:
            yield _snippet("class ...", "class ${1:Name} extends ${2:Timeline} {\n  predicate ${3:Idle} { }\n}\n")
            yield _snippet("enum ...", "enum ${1:Name} { ${2:First}, ${3:Second} }\n")
            yield _snippet("goal(...)", "goal(${1:object}.${2:predicate} ${3:name});\n")
            for owner in schema.classes.values():
                for predicate in owner.predicates.values() if not owner.is_native else ():
                    if predicate not in with_rules:
                        name = f"{owner.name}::{predicate.name}"
                        yield _snippet(name, f"{name} {{\n  $0\n}}\n", f"rule on {predicate.full_name}")
        case Situation.MEMBER:
            yield _snippet("predicate ...", "predicate ${1:Name} { $0 }\n")
        case Situation.RULE:
            yield _snippet("if ...", "if (${1:condition}) {\n  $0\n}")
            yield _snippet("foreach ...", "foreach (${1:each} in ${2:objects}) {\n  $0\n}")
            yield _snippet("met_by ...", "met_by(${1:object.Predicate} ${2:earlier});")
            yield _snippet("meets ...", "meets(${1:object.Predicate} ${2:later});")
            yield _snippet("contained_by ...", "contained_by(${1:object.Predicate} ${2:around});")
        case _:
            pass


def _snippet(label: str, text: str, detail: str | None = None) -> CompletionItem:
    return CompletionItem(
        label,
        kind=CompletionItemKind.Snippet,
        detail=detail,
        insert_text=text,
        insert_text_format=InsertTextFormat.Snippet,
    )


def _members(place: Place, path: list[str], situation: Situation) -> _Items:
    """What may follow the dot after `path`: the way to a predicate where a token is asked for, else to a variable."""
    schema, (head, *rest) = place.schema, path
    is_asked = situation is Situation.INSTANCE
    is_called = situation in (Situation.TOP, Situation.ANYTHING)  # elsewhere no method can be called
    token = place.token(head)
    if not rest and token is not None:
        variables = list(_token_variables(token))
        yield from (each for each in variables if not is_asked or _leads_on(place, [head, each.label]))
        if head != "this" and is_called:
            yield from _methods(Receiver.TOKEN)
        return
    if not rest and token is None and head not in place.variables:
        if head in schema.classes:
            yield from _predicates(schema, head)
            if is_called:
                yield from _methods(Receiver.CLASS)
            return
        if head in schema.enums:
            yield from (_item(value, CompletionItemKind.EnumMember, head) for value in schema.enums[head].values)
            return
    type_ = place.type_of(path)
    if type_ is None:
        return
    if type_.kind is Kind.OBJECT:
        for name in schema.ancestry(type_.base):
            for member in schema.classes[name].members.values():
                if not is_asked or place.leads_to_predicates(member.type):
                    yield _variable(member)
        if situation is not Situation.VALUE:
            yield from _predicates(schema, type_.base)
    if is_called:
        yield from _methods(Receiver.OBJECT) if type_.kind is Kind.OBJECT else ()
        yield from _methods(Receiver.VARIABLE)


def _leads_on(place: Place, path: list[str]) -> bool:
    type_ = place.type_of(path)
    return type_ is not None and place.leads_to_predicates(type_)


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


def resolved(analysis: Analysis, item: CompletionItem, link: Callable[[Span], str]) -> CompletionItem:
    """The item with all that is known about what it names."""
    describer = Describer(analysis, link)
    schema = analysis.schema
    name = item.label
    parts: Iterable[str] | None = None
    match item.kind:
        case CompletionItemKind.Class if name in schema.classes:
            parts = describer.class_(schema.classes[name])
        case CompletionItemKind.Method if item.detail is not None:
            owner, _, _ = item.detail.partition(".")
            predicate = schema.find_predicate(owner, name)
            parts = describer.predicate(predicate) if predicate is not None else None
        case CompletionItemKind.EnumMember if name in schema.enum_values:
            parts = describer.enum_value(schema.enum_values[name])
        case CompletionItemKind.Variable if name in schema.globals:
            parts = describer.variable(schema.globals[name])
        case CompletionItemKind.Operator if name in RELATIONS:
            parts = (*relation_head(RELATIONS[name]), *relation_tail(RELATIONS[name]))
        case CompletionItemKind.Function:
            constraint = analysis.callables.constraints.get(name)
            function = analysis.callables.functions.get(name)
            found = constraint_text(constraint) if constraint is not None else None
            parts = function_text(function) if function is not None else found
        case CompletionItemKind.Keyword if name in WORDS:
            parts = (WORDS[name],)
        case _:
            pass
    if parts is not None:
        item.documentation = MarkupContent(MarkupKind.Markdown, "\n\n".join(part for part in parts if part))
    return item
