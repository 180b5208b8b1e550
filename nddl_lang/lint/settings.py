"""What a project wants to hear: findings in, those that were asked for, as heavy as was asked, out."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import MOST_LEXEMES
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.source import Span


@dataclass(frozen=True, slots=True)
class ProjectModule:
    """A Python file with constraints, and where the configuration names it."""

    path: Path
    span: Span


@dataclass(frozen=True, slots=True)
class Settings:
    """What a configuration file or a command line asks for.

    Codes may be cut short: `NDDL5` means all that begin so. `severities` maps codes to what they weigh, None meaning
    not at all. `fail_on` None: findings never make the command fail. `modules` are the Python files with the project's
    own constraints, and `seconds` how long one call of theirs may take, None for the usual limit; `callables` is what
    models may call with them, which is not found out here. A model
    may have `most_lexemes`. `folder` is that of the configuration file, if there is one.
    """

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    severities: tuple[tuple[str, Severity | None], ...] = ()
    directories: tuple[Path, ...] = ()
    dialect: Dialect | None = None
    fail_on: Severity | None = Severity.WARNING
    modules: tuple[ProjectModule, ...] = ()
    seconds: float | None = None
    callables: Callables = NATIVE_CALLABLES
    folder: Path | None = None
    most_lexemes: int = MOST_LEXEMES

    def choose(self, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
        """The findings that are asked for; an error always is."""
        if not (self.select or self.ignore or self.severities):
            yield from findings
            return
        for finding in findings:
            if finding.severity is Severity.ERROR:
                yield finding
                continue
            code = finding.code.id
            if (self.select and not code.startswith(self.select)) or (self.ignore and code.startswith(self.ignore)):
                continue
            severity = self._severity(code, finding.severity)
            if severity is not None:
                yield finding if severity is finding.severity else replace(finding, severity=severity)

    def for_mending(self) -> "Settings":
        """These, where what weighs less than an error for the project is mended too: all but what it ignores."""
        return replace(self, severities=tuple(each for each in self.severities if each[1] is None))

    def _severity(self, code: str, usual: Severity) -> Severity | None:
        """The severity that the longest fitting entry gives."""
        best, found = 0, usual
        chosen: Severity | None = found
        for prefix, severity in self.severities:
            if code.startswith(prefix) and len(prefix) > best:
                best, chosen = len(prefix), severity
        return chosen


def at_least(severity: Severity, limit: Severity) -> bool:
    """Whether `severity` weighs as much as `limit` or more."""
    order = list(Severity)
    return order.index(severity) <= order.index(limit)
