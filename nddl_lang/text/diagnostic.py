"""Say what is wrong with a text: codes, and the diagnostics that carry them."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.text.printable import printable
from nddl_lang.text.source import Span


class Severity(Enum):
    """How much a diagnostic weighs, heaviest first."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"
    HINT = "hint"


@dataclass(frozen=True, slots=True)
class Edit:
    """Put `text` in place of `span`."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """A mend that a tool may apply; a safe one keeps the meaning that the writer evidently had.

    One that `is_choice` loses a part of what was written: whoever reads it may choose it, no command carries it out.
    """

    title: str
    edits: tuple[Edit, ...]
    safe: bool = True
    is_choice: bool = False


@dataclass(frozen=True, slots=True)
class Note:
    """Where the other half of a complaint is; without a span, a remark."""

    message: str
    span: Span | None = None


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One complaint about one place."""

    code: "Code"
    severity: Severity
    span: Span
    message: str
    notes: tuple[Note, ...] = ()
    help: str | None = None
    fixes: tuple[Fix, ...] = ()


@dataclass(frozen=True, slots=True)
class Code:
    """A stable name for one kind of complaint.

    `kind` groups codes as the conformance suite does: syntax, include, name, duplicate, type, arity, domain,
    state, rule; lints use `lint`. `template` is filled by keyword.
    """

    id: str
    severity: Severity
    kind: str
    template: str

    def at(
        self,
        span: Span,
        *,
        notes: tuple[Note, ...] = (),
        help: str | None = None,
        fixes: tuple[Fix, ...] = (),
        **values: object,
    ) -> Diagnostic:
        """The diagnostic of this code at `span`."""
        message = printable(self.template.format(**values))
        return Diagnostic(self, self.severity, span, message, notes, None if help is None else printable(help), fixes)
