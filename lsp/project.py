"""One model under edit: its texts in, its analysis out, with all that an edit leaves alone kept from before."""

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from lsp.occurrences import NameIndex, NameIndexer
from lsp.uris import key_of
from nddl_lang.analysis import Analyser, Analysis
from nddl_lang.lint.configuration import find_configuration, read_configuration
from nddl_lang.lint.linter import Linter
from nddl_lang.lint.project_modules import read_callables
from nddl_lang.lint.settings import Settings as Configuration
from nddl_lang.repair import repair
from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import Parse
from nddl_lang.syntax.placement import CLASS, TOP
from nddl_lang.syntax.roots import parts_of
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source

OpenText = Callable[[Path], str | None]
# What models of a project may call, whether it is trusted or not; and what its modules hide.
Know = Callable[[Configuration, bool], tuple[Callables, tuple[Diagnostic, ...]]]
_Place = tuple[str, Dialect, bool]


def read_only(configuration: Configuration, is_trusted: bool) -> tuple[Callables, tuple[Diagnostic, ...]]:
    """What the texts of the project's modules tell."""
    del is_trusted
    return read_callables(configuration, NATIVE_CALLABLES)


@dataclass(frozen=True, slots=True)
class ServerSettings:
    """What holds for all models: the dialect that is asked for, and where included files are looked for.

    Python of a project is run only where it `is_trusted`, and read otherwise: `know` does either.
    """

    dialect: Dialect | None = None
    directories: tuple[str, ...] = ()
    is_trusted: bool = False
    know: Know = read_only


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The analysis of a model as it stands, and the parse of each of its texts, by the key of its file.

    `diagnostics` are all complaints, those of the linter included, as the project's configuration wants them.
    `keys` are the keys of the texts.
    """

    analysis: Analysis
    diagnostics: tuple[Diagnostic, ...]
    parses: dict[str, Parse]
    indexer: NameIndexer
    keys: dict[Source, str]

    @cached_property
    def names(self) -> NameIndex:
        """Where each name stands: worked out once somebody asks."""
        return self.indexer.index(self.analysis)


class Project:
    """A text, known by the key of its file, with all that it includes."""

    def __init__(self, key: str, settings: ServerSettings) -> None:
        self.key = key
        self._settings = settings
        self._configuration, self._gaps = _configuration(Path(key), settings)
        self._directories = (*map(Path, settings.directories), *self._configuration.directories)
        self._analyser = Analyser(self._configuration.callables)
        self._linter = Linter()
        self._indexer = NameIndexer()
        self._kept: dict[_Place, tuple[Incremental, Parse]] = {}
        self._used: dict[_Place, tuple[Incremental, Parse]] = {}
        self._snapshot: Snapshot | None = None
        self._parts: frozenset[Path] | None = None
        self._repair: Generator[None, None, Analysis] | None = None
        self.is_repaired = False

    @property
    def is_in_repair(self) -> bool:
        """Whether the smallest edit that would mend the model is still looked for."""
        return self._repair is not None

    @property
    def snapshot(self) -> Snapshot:
        """What the last `analyse` found."""
        assert self._snapshot is not None
        return self._snapshot

    @property
    def members(self) -> Sequence[str]:
        """The keys of its texts, the first one its own."""
        return tuple(self.snapshot.parses)

    def analyse(self, name: str, text: str, open_text: OpenText) -> None:
        """Take a new snapshot: the model is `text`, called `name`, and what `open_text` gives for its includes."""
        # Should this fail half-way, nothing half-done is kept.
        analyser, self._analyser = self._analyser, Analyser(self._configuration.callables)
        linter, self._linter = self._linter, Linter()
        self._used = {}
        loaded = load_module_graph(
            Source(name, text),
            self._directories,
            self._settings.dialect or self._configuration.dialect,
            open_text=open_text,
            parse_text=self._parse,
            most=self._configuration.most_lexemes,
        )
        self._kept, self._used = self._used, {}
        parses = {key_of(loaded.paths[parse.source]): parse for parse in loaded.parses}
        parses.pop(self.key, None)
        linter.judged = self._own_parts()
        analysis = analyser.analyse(loaded)
        found = tuple(self._configuration.choose((*self._gaps, *linter.lint(analysis))))
        parses = {self.key: loaded.parses[0], **parses}
        keys = {parse.source: key for key, parse in parses.items()}
        self._snapshot = Snapshot(analysis, found, parses, self._indexer, keys)
        self._analyser, self._linter = analyser, linter
        self._repair = repair(analysis) if analysis.has_errors else None
        self.is_repaired = False

    def repair(self, trials: int | None = None) -> bool:
        """Try some more of the edits that may mend the model, or all; whether that changed what is told.

        The meaning of the snapshot stays that of the text as it is, with all errors.
        """
        while self._repair is not None and (trials is None or trials > 0):
            try:
                next(self._repair)
            except StopIteration as end:
                repaired: Analysis = end.value
                self._repair = None
                self.is_repaired = repaired is not self.snapshot.analysis
                if self.is_repaired:
                    found = tuple(self._configuration.choose((*self._gaps, *self._linter.lint(repaired))))
                    self._snapshot = replace(self.snapshot, diagnostics=found)
                return self.is_repaired
            trials = None if trials is None else trials - 1
        return False

    def look_again(self) -> None:
        """Files may have changed on the disk, also such as are none of its own."""
        self._parts = None

    def _own_parts(self) -> frozenset[Path]:
        """The files that the model includes and no other one beside it, as they are on the disk."""
        if self._parts is None:
            path = Path(self.key)
            self._parts = parts_of([path], self._directories) if path.is_absolute() else frozenset()
        return self._parts

    def _parse(self, path: Path, source: Source, dialect: Dialect, is_in_class: bool) -> Parse:
        place = (str(path), dialect, is_in_class)
        known = self._kept.pop(place, None)
        if known is None:
            incremental = Incremental(
                source.name, dialect, CLASS if is_in_class else TOP, self._configuration.most_lexemes
            )
            parse = incremental.update(source.text)
        else:
            incremental, parse = known
            if parse.source.text == source.text and parse.source.name == source.name:
                self._used[place] = known
                return parse
            if parse.source.text != source.text:
                parse = incremental.update(source.text)
        # All spans point into the source that the includes were followed from.
        for piece in parse.pieces:
            piece.anchor.source = source
        parse = replace(parse, source=source)
        self._used[place] = (incremental, parse)
        return parse


def _configuration(root: Path, settings: ServerSettings) -> tuple[Configuration, tuple[Diagnostic, ...]]:
    """What the project of a file asks for, and what its modules hide from somebody who does not run them.

    A configuration with mistakes counts as far as it is understood.
    """
    path = find_configuration(root.parent) if root.is_absolute() else None
    configuration = Configuration() if path is None else read_configuration(path)[0]
    callables, gaps = settings.know(configuration, settings.is_trusted)
    return replace(configuration, callables=callables), gaps
