"""User constraints: posted to the engine, and told the names of the values of the plan."""

from collections.abc import Sequence

from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import KIND_OBJECT, KIND_STRING
from runtime.constraints.engine import Engine
from runtime.plan.store.names import Names
from runtime.plan.store.prototypes import Prototypes
from runtime.user.constraint import Constraint
from runtime.user.written import Written


class UserConstraints:
    """A modeler's constraints by number, over the names of one plan."""

    def __init__(self, engine: Engine, prototypes: Prototypes, constraints: Sequence[Constraint]) -> None:
        self.engine = engine
        self.texts: Names = prototypes.texts
        self.symbols: Names = prototypes.symbols
        self.objects: list[str] = []
        self.spans: list[Span] = []
        self.externals = [Written(each, self) for each in constraints]

    def post(self, number: int, arguments: list[int], span: int, owner: int) -> int:
        """Post constraint `number`; its id in the engine."""
        return self.engine.post_external(self.externals[number], arguments, span, owner)

    def text(self, kind: int, number: int) -> str:
        """The name of an object, a text or a value of an enum."""
        if kind == KIND_OBJECT:
            return self.objects[number] if 0 <= number < len(self.objects) else f"object {number}"
        names = self.texts if kind == KIND_STRING else self.symbols
        return names.text(number) if 0 <= number < len(names.texts) else f"value {number}"

    def number(self, kind: int, text: str) -> int | None:
        """The number of a name; None for an object that does not exist."""
        if kind == KIND_OBJECT:
            return self.objects.index(text) if text in self.objects else None
        if kind == KIND_STRING:
            return self.texts.number(text)
        if text not in self.symbols.numbers:
            raise ValueError(f"no enum has a value `{text}`")
        return self.symbols.number(text)

    def source_place(self, span: int) -> str | None:
        """File and line of what was posted from the program's stretch `span`."""
        return f"{self.spans[span].source.name}:{self.spans[span].line}" if 0 <= span < len(self.spans) else None
