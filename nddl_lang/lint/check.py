"""Files in, all that is wrong with them by the settings of their project out."""

from dataclasses import replace
from pathlib import Path

from nddl_lang.analysis import Analyser
from nddl_lang.lint.linter import Linter
from nddl_lang.lint.mending import Mended, mend
from nddl_lang.lint.settings import Settings
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import decode
from nddl_lang.text.source import Source


class Checker:
    """Checks files; `directories` and `dialect` are asked for beside what each project says."""

    def __init__(self, directories: tuple[Path, ...] = (), dialect: Dialect | None = None) -> None:
        self._directories = directories
        self._dialect = dialect

    def check(self, path: Path, settings: Settings) -> tuple[Diagnostic, ...]:
        """All that is wrong with a file and what it includes; raises OSError if it cannot be read."""
        return self._check(Source(str(path), decode(path.read_bytes())), settings)

    def mend(self, path: Path, settings: Settings, *, unsafe: bool) -> tuple[str, Mended] | None:
        """The text of a file and how it is after its fixes; None where it is no UTF-8 text."""
        content = path.read_bytes()
        text = decode(content)
        if text.encode() != content:
            return None
        # What weighs less than an error for the project is still mended: only what it ignores is not.
        quiet = replace(settings, severities=tuple(each for each in settings.severities if each[1] is None))
        return text, mend(text, lambda changed: self._check(Source(str(path), changed), quiet), unsafe=unsafe)

    def _check(self, source: Source, settings: Settings) -> tuple[Diagnostic, ...]:
        directories = (*self._directories, *settings.directories)
        loaded = load_module_graph(source, directories, self._dialect or settings.dialect)
        return tuple(settings.choose(Linter().lint(Analyser(settings.callables).analyse(loaded))))
