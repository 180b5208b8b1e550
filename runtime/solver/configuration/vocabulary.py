"""Names of a configuration for numbers of the plan, and back."""

from runtime.constraints.domains.tags import KIND_OBJECT, KIND_STRING
from runtime.plan.database import PlanDatabase


class PlanVocabulary:
    """The names of predicates, classes, relations, variables and values of one database."""

    def __init__(self, database: PlanDatabase) -> None:
        self.database = database

    def predicate_text(self, predicate: int) -> str:
        """The full name of a predicate."""
        return self.database.program.predicates[predicate].name

    def class_text(self, owner: int) -> str:
        """The name of a class."""
        return self.database.program.classes[owner].name

    def relation_text(self, relation: int) -> str:
        """The name of a relation."""
        return self.database.relation_names[relation]

    def name_text(self, name: int) -> str:
        """A label of a token, or the name of a local variable."""
        return self.database.names.text(name)

    def member_text(self, owner: int, number: int) -> str:
        """The name of a member of a class."""
        return self.database.program.classes[owner].members[number].name

    def global_text(self, index: int) -> str:
        """The name of a global variable."""
        return self.database.program.globals[index][0]

    def value_text(self, v: int) -> str:
        """The single value of a variable that holds names: an object, a symbol or a text."""
        kind = self.database.plan.engine.kind[v]
        value = self.database.plan.engine.lb[v]
        if kind == KIND_OBJECT:
            return self.database.objects.names[value]
        if kind == KIND_STRING:
            return self.database.prototypes.texts.text(value)
        return self.database.prototypes.symbols.text(value)

    def value_number(self, v: int, text: str) -> float | None:
        """The number of a name as a value of `v`; None if nothing is called so."""
        kind = self.database.plan.engine.kind[v]
        if kind == KIND_OBJECT:
            return self.database.objects.numbers.get(text)
        names = self.database.prototypes.texts if kind == KIND_STRING else self.database.prototypes.symbols
        return names.numbers.get(text)
