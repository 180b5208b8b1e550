"""Files in, all that is wrong with them by the settings of their project out."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Protocol

from nddl_lang.analysis import analyse
from nddl_lang.lint.linter import Linter
from nddl_lang.lint.mending import Mended, mend, text_to_mend
from nddl_lang.lint.settings import Settings
from nddl_lang.lint.unused import OF_ALL_MODELS
from nddl_lang.misspelt_declaration import name_misspelt_part
from nddl_lang.repair import repaired
from nddl_lang.syntax.codes import UNREADABLE_FILE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.nodes import Identifier
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.read import decode, read_named, read_over, read_text, real_path
from nddl_lang.text.source import Anchor, Source, Span


class Checker:
    """Checks files; `directories` and `dialect` are asked for beside what each project says.

    `parts` are files that no models include but those that are checked, by their resolved paths. What no model uses of
    such a file is only known when all are checked: `is_agreed` tells.
    """

    def __init__(
        self,
        directories: tuple[Path, ...] = (),
        dialect: Dialect | None = None,
        parts: frozenset[Path] = frozenset(),
    ) -> None:
        self._directories = directories
        self._dialect = dialect
        self._parts = parts
        self._part_of: dict[Source, Path] = {}
        self._names: dict[Path, Path] = {}
        self._roots: dict[Path, dict[Path, Settings]] = {}
        self._readers: Counter[Path] = Counter()
        self._votes: Counter[tuple[Path, int, str]] = Counter()
        self._sources: list[Source] = []
        self._declared: list[Identifier] = []

    def check(self, path: Path, settings: Settings) -> tuple[Diagnostic, ...]:
        """All that is wrong with a file and what it includes, and if that is that it cannot be read."""
        try:
            text = self._read(path)
        except OSError as problem:
            place = Span(Anchor(Source(str(path), "")), 0, 0)
            return (UNREADABLE_FILE.at(place, path=path, reason=problem.strerror or problem),)
        found = self._check(Source(str(path), text), settings, is_counted=True)
        self._votes.update({(part, each.span.begin, each.code.id) for each in found if (part := self._part(each))})
        return found

    @staticmethod
    def _read(path: Path) -> str:
        """The text of a file, or of a pipe that the user named."""
        return (read_text(path) or "") if path.is_file() else decode(read_named(path))

    def is_agreed(self, finding: Diagnostic) -> bool:
        """Whether all models that include the file of a finding say the same, where that is needed."""
        part = self._part(finding)
        if part is None or finding.code not in OF_ALL_MODELS:
            return True
        return self._votes[part, finding.span.begin, finding.code.id] == self._readers[part]

    def gathered(self, found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
        """`found` in all models, where a name that a shared file misspells is told once, at its declaration."""
        return name_misspelt_part(self._sources, found, self._declared, frozenset(self._part_of))

    def _part(self, finding: Diagnostic) -> Path | None:
        return self._part_of.get(finding.span.source)

    def mend(self, path: Path, settings: Settings, *, unsafe: bool) -> tuple[str, Mended] | None:
        """The text of a file and how it is after its fixes; None where it is no UTF-8 text."""
        text = text_to_mend(path)
        if text is None:
            return None
        quiet = settings.for_mending()

        def check(changed: str, *, is_repaired: bool = False) -> tuple[Diagnostic, ...]:
            return self._check(Source(str(path), changed), quiet, is_repaired=is_repaired)

        return text, _mended(text, check, unsafe=unsafe)

    def mend_parts(self, *, unsafe: bool) -> Iterator[tuple[Path, tuple[str, Mended] | None]]:
        """Each file that the mended models include, and no others: its name, and what `mend` gives for it."""
        for part, roots in list(self._roots.items()):
            text = text_to_mend(part)
            if text is None:
                yield self._names[part], None
                continue

            def check(
                changed: str, part: Path = part, roots: dict[Path, Settings] = roots, *, is_repaired: bool = False
            ) -> tuple[Diagnostic, ...]:
                found: list[Diagnostic] = []
                for root, settings in roots.items():
                    source = Source(str(root), self._read(root))
                    quiet = settings.for_mending()
                    found += self._check(source, quiet, is_repaired=is_repaired, texts={part: changed})
                votes = Counter((each.span.begin, each.code.id) for each in found)
                return tuple(
                    each
                    for each in found
                    if each.code not in OF_ALL_MODELS or votes[each.span.begin, each.code.id] == len(roots)
                )

            yield self._names[part], (text, _mended(text, check, unsafe=unsafe))

    def _check(
        self,
        source: Source,
        settings: Settings,
        *,
        is_counted: bool = False,
        is_repaired: bool = False,
        texts: Mapping[Path, str] | None = None,
    ) -> tuple[Diagnostic, ...]:
        directories = (*self._directories, *settings.directories)
        dialect = self._dialect or settings.dialect
        open_text = read_text if texts is None else read_over(texts)
        loaded = load_module_graph(source, directories, dialect, open_text=open_text, most=settings.most_lexemes)
        for included, place in loaded.paths.items():
            if included is not source and (part := real_path(place)) in self._parts:
                self._part_of[included] = part
                self._names.setdefault(part, Path(included.name))
                self._roots.setdefault(part, {})[Path(source.name)] = settings
                self._readers[part] += is_counted
        analysis = analyse(loaded, settings.callables)
        if is_counted or is_repaired:  # else fixes are carried out, of consequences as well
            analysis = repaired(analysis)
        if is_counted and analysis.has_errors:
            self._sources += loaded.sources
            self._declared += (name for tables in analysis.by_statement.values() for name in tables.declared)
        return tuple(settings.choose(Linter(self._parts).lint(analysis)))


class _Check(Protocol):
    """All that is wrong with a changed text; where it `is_repaired`, with small edits as fixes."""

    def __call__(self, changed: str, *, is_repaired: bool = False) -> tuple[Diagnostic, ...]: ...


def _mended(text: str, check: _Check, *, unsafe: bool) -> Mended:
    """A text after the fixes of its messages, and then after small edits that would leave no error."""
    done = mend(text, check, unsafe=unsafe)
    if not unsafe or not any(each.severity is Severity.ERROR for each in done.left):
        return done
    again = mend(done.text, lambda changed: check(changed, is_repaired=True), unsafe=True)
    return Mended(again.text, done.count + again.count, again.left)
