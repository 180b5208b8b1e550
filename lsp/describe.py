"""Something that a model declares in, Markdown about it out."""

from collections.abc import Callable, Iterable, Iterator

from lsp.definition import parameter_of
from lsp.meaning import WORDS
from lsp.rows import fenced
from lsp.uses import Use, givings, rules_on, samplings
from nddl_lang.analysis import Analysis
from nddl_lang.semantics import domains
from nddl_lang.semantics.natives import TIMELINE, builtin_names
from nddl_lang.semantics.schema import (
    Class,
    Constructor,
    Enumeration,
    EnumValue,
    Kind,
    Label,
    Predicate,
    TokenVariableReference,
    Type,
    Typedef,
    Variable,
)
from nddl_lang.text.source import Span

_Link = Callable[[Span], str]
# A list that is longer is cut, with the number of what is left out.
_MOST = 12
_BASIC = {
    Kind.INT: "Whole numbers.",
    Kind.FLOAT: "Real numbers.",
    Kind.BOOL: "`true` and `false`.",
    Kind.STRING: "Texts.",
    Kind.SYMBOL: "Texts, and values of enums.",
}


class Describer:
    """Describes what one analysis knows; `link` writes a place as a Markdown link."""

    def __init__(self, analysis: Analysis, link: _Link) -> None:
        self._analysis = analysis
        self._link = link

    # ---- types ----

    def basic(self, type_: Type) -> Iterator[str]:
        """A type of the language."""
        yield fenced(type_.name)
        if (text := _BASIC.get(type_.kind)) is not None:
            yield text

    def typedef(self, typedef: Typedef) -> Iterator[str]:
        """A named restriction of a type."""
        domain = f" {domains.text(typedef.type.restriction)}" if typedef.type.restriction is not None else ""
        yield fenced(f"typedef {typedef.type.base}{domain} {typedef.name};")
        yield from _doc(typedef.doc)

    def enumeration(self, enum: Enumeration) -> Iterator[str]:
        """An enum with its values."""
        yield fenced(_enum_text(enum))
        yield from _doc(enum.doc)

    def enum_value(self, value: EnumValue) -> Iterator[str]:
        """A value of an enum; where it stands for a parameter of missions, who samples it."""
        yield fenced(f"{value.enum}.{value.value}")
        enum = self._analysis.schema.enums.get(value.enum)
        if enum is not None:
            position = enum.values.index(value.value) + 1 if value.value in enum.values else 0
            yield f"Value {position} of {len(enum.values)} of `enum {enum.name}`."
            yield from _doc(enum.doc)
        yield from self._sampled(value, "Its range and distribution come from the mission file.")

    # ---- classes ----

    def class_(self, owner: Class) -> Iterator[str]:
        """A class with what it declares and inherits."""
        base = f" extends {owner.base}" if owner.base is not None else ""
        yield fenced(f"class {owner.name}{base}")
        yield from _doc(owner.doc)
        schema = self._analysis.schema
        if owner.is_native:
            yield "Built in."
        elif not owner.is_defined:
            yield "Announced, but not defined so far."
        if schema.is_subclass(owner.name, TIMELINE):
            yield "A timeline: the tokens of one object never overlap."
        constructors = [_constructor_text(each) for each in owner.constructors]
        yield from _listed("Constructors", (f"`{text}`" for text in constructors))
        members = [
            f"`{member.type.name} {member.name}`"
            for name in schema.ancestry(owner.name)
            for member in schema.classes[name].members.values()
        ]
        yield from _listed("Members", members)
        predicates = {**owner.inherited, **owner.predicates}.values()
        yield from _listed("Predicates", (f"`{_predicate_text(each)}`" for each in predicates))
        objects = [
            f"`{variable.name}`"
            for variable in schema.globals.values()
            if variable.type.kind is Kind.OBJECT and schema.is_subclass(variable.type.base, owner.name)
        ]
        yield from _listed("Objects", objects)

    def constructor(self, constructor: Constructor) -> Iterator[str]:
        """A constructor, with its class."""
        yield fenced(_constructor_text(constructor))
        if constructor.node is not None:
            yield from _doc(constructor.node.doc)
        owner = self._analysis.schema.classes.get(constructor.class_name)
        if owner is not None:
            yield f"Constructor of `class {owner.name}`" + (f", which extends `{owner.base}`." if owner.base else ".")
            yield from _doc(owner.doc)

    def predicate(self, predicate: Predicate) -> Iterator[str]:
        """A predicate with all of its parameters."""
        word = "action" if predicate.is_action else "predicate"
        lines = [f"  {parameter_text(each)};" for each in predicate.parameters]
        body = "\n".join(["{", *lines, "}"]) if lines else "{ }"
        yield fenced(f"{word} {predicate.full_name} {body}")
        yield from _doc(predicate.doc)
        own = ", ".join(f"`{name}`" for name in builtin_names(predicate.is_event))
        yield f"{'An event' if predicate.is_event else 'Every token'} has {own}."
        declared = [name for name in predicate.declared_in if name != predicate.class_name]
        if declared:
            yield "Inherited from " + ", ".join(f"`{name}`" for name in declared) + "."
        yield from _listed("Rules", (self._link(rule.span) for rule in rules_on(self._analysis, predicate)))

    # ---- variables ----

    def variable(self, variable: Variable) -> Iterator[str]:
        """A variable of any kind: its type, its domain, its role, and the values that the script gives."""
        yield fenced(parameter_text(variable))
        yield from _doc(variable.doc)
        schema = self._analysis.schema
        yield f"{self._role(variable)}{self._domain(variable.type)}"
        if variable.type.kind is Kind.ENUM and (enum := schema.enums.get(variable.type.base)) is not None:
            yield fenced(_enum_text(enum))
        if schema.globals.get(variable.name) is variable:
            given = (f"`{use.text}` {self._link(use.span)}" for use in givings(self._analysis, variable))
            yield from _listed("Given", given)
            yield from self._sampled(variable, self._range(variable))

    def token_variable(self, variable: TokenVariableReference) -> Iterator[str]:
        """A variable of a token."""
        parameter = parameter_of(variable)
        owner = variable.label.predicate.full_name
        token = "the token at hand" if variable.label.name == "this" else f"token `{variable.label.name}`"
        if parameter is None:
            yield fenced(f"{variable.type.name} {variable.name}")
            yield WORDS.get(variable.name, "")
            yield f"Of {token}, a `{owner}`."
        else:
            yield fenced(parameter_text(parameter))
            yield from _doc(parameter.doc)
            yield f"Parameter of {token}, a `{owner}`.{self._domain(variable.type)}"
            if variable.type.kind is Kind.ENUM and (enum := self._analysis.schema.enums.get(variable.type.base)):
                yield fenced(_enum_text(enum))

    def label(self, label: Label) -> Iterator[str]:
        """A token, with its predicate."""
        if label.name == "this":
            yield f"The token that the rule is on, a `{label.predicate.full_name}`."
        else:
            yield f"Token `{label.name}`, a `{label.predicate.full_name}`."
        yield from self.predicate(label.predicate)

    def _role(self, variable: Variable) -> str:
        schema = self._analysis.schema
        if schema.globals.get(variable.name) is variable:
            return "Object." if variable.type.kind is Kind.OBJECT else "Global variable."
        for owner in schema.classes.values():
            if owner.members.get(variable.name) is variable:
                return f"Member of `class {owner.name}`."
            for predicate in owner.predicates.values():
                if variable in predicate.parameters:
                    return f"Parameter of `{predicate.full_name}`."
            if any(variable in constructor.parameters for constructor in owner.constructors):
                return f"Parameter of a constructor of `{owner.name}`."
        return "Local variable."

    def _domain(self, type_: Type) -> str:
        if type_.restriction is not None:
            return f" Domain: `{domains.text(type_.restriction)}`" + (
                f" (`{type_.name}`)." if type_.name != type_.base else "."
            )
        return ""

    def _range(self, variable: Variable) -> str:
        domain = variable.initialiser.span.text if variable.initialiser is not None else None
        if domain is None and variable.type.restriction is not None:
            domain = domains.text(variable.type.restriction)
        if domain is None:
            domain = next((use.text.partition("=")[2].strip() for use in givings(self._analysis, variable)), None)
        if domain is None:
            return "Its range comes from the mission file."
        return f"Range: `{domain}`, uniform unless the mission file says otherwise."

    def _sampled(self, parameter: Variable | EnumValue, range_: str) -> Iterator[str]:
        """Who draws the parameter, if anybody does."""
        uses = samplings(self._analysis, parameter)
        if uses:
            yield f"**Sampled by missions.** {range_}"
            yield from _listed("Sampled in", (self._sampling(use) for use in uses))

    def _sampling(self, use: Use) -> str:
        return f"`{use.text}` {self._link(use.span)}"


def parameter_text(variable: Variable) -> str:
    """A variable as it is declared."""
    value = f" = {variable.initialiser.span.text}" if variable.initialiser is not None else ""
    return f"{variable.type.name} {variable.name}{value}"


def _constructor_text(constructor: Constructor) -> str:
    parameters = ", ".join(f"{each.type.name} {each.name}" for each in constructor.parameters)
    return f"{constructor.class_name}({parameters})"


def _predicate_text(predicate: Predicate) -> str:
    return f"{predicate.name}({', '.join(f'{each.type.name} {each.name}' for each in predicate.parameters)})"


def _enum_text(enum: Enumeration) -> str:
    values = ", ".join(enum.values[:_MOST]) + (", ..." if len(enum.values) > _MOST else "")
    return f"enum {enum.name} {{ {values} }}"


def _doc(doc: str | None) -> Iterator[str]:
    if doc:
        yield doc


def _listed(title: str, items: Iterable[str]) -> Iterator[str]:
    """A list under its title, if there is anything in it."""
    lines = list(items)
    if not lines:
        return
    more = [f"- and {len(lines) - _MOST} more"] if len(lines) > _MOST else []
    yield "\n".join([f"**{title}**", "", *(f"- {line}" for line in lines[:_MOST]), *more])
