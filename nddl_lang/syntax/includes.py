"""Follow the includes of a text: all statements in the order of their execution, from all files."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

from nddl_lang.syntax.codes import (
    INCLUDE_AGAIN,
    INCLUDE_CYCLE,
    MISSING_FILE,
    NOT_TEXT,
    TOO_DEEP,
    UNREADABLE_FILE,
)
from nddl_lang.syntax.dialect import Dialect, declared_dialect
from nddl_lang.syntax.nodes import ClassDecl, Include, Module, Statement
from nddl_lang.syntax.parser import MOST_LEXEMES, Parse, includes_text, parse, parse_members, too_large
from nddl_lang.syntax.roots import listed_models, model_meant
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.read import decode, is_text, read_named, read_text, real_path
from nddl_lang.text.source import Anchor, Source, Span

# The files that come with the package.
LIBRARY = Path(__file__).parent.parent / "library"

_DEPTH_LIMIT = 100

OpenText = Callable[[Path], str | None]
ParseText = Callable[[Path, Source, Dialect, bool], Parse]


@dataclass(frozen=True, eq=False, slots=True)
class LoadedModules:
    """A text with all that it includes; `module` holds what is executed, with no include left in it.

    `included` tells for each include which text it names, whether it was read there or before. `paths` tells where
    a text was read, so that a link can lead there.
    """

    root: Source
    dialect: Dialect
    module: Module
    sources: tuple[Source, ...]
    diagnostics: tuple[Diagnostic, ...]
    included: Mapping[Include, Source]
    paths: Mapping[Source, Path]
    parses: tuple[Parse, ...]


def load_module_graph(
    root: Path | str | Source,
    include_directories: Sequence[Path | str] = (),
    dialect: Dialect | None = None,
    *,
    open_text: OpenText = read_text,
    parse_text: ParseText | None = None,
    most: int = MOST_LEXEMES,
) -> LoadedModules:
    """Read `root` and all that it includes.

    Each file is read once, known by its resolved path. It is looked for beside the including file, in
    `include_directories`, in the current directory, and in the library. Without `dialect` the first line of `root`
    decides, and where it is silent, nddlc. An editor passes `open_text` to show texts that are not saved yet, and
    `parse_text` to reuse what it has parsed; the source of the parse that it returns counts. A model of more than
    `most` lexemes is one complaint, and has no statements. Raises OSError if `root` itself cannot be read.
    """
    if isinstance(root, Source):
        source = root
    else:
        path = Path(root)
        is_pipe = path.exists() and not path.is_file()  # which the user named; what is included is never one
        text = decode(read_named(path)) if is_pipe else open_text(path)
        if text is None:
            raise FileNotFoundError(f"no file {root}")
        source = Source(str(root), text)
    chosen = dialect or declared_dialect(source.text) or Dialect.NDDLC
    directories = [Path(directory) for directory in include_directories]
    loader = _Loader(directories, chosen, open_text, parse_text or partial(_parse_text, most), most)
    statements = loader.load(source, Path(source.name), False)
    diagnostics = loader.diagnostics if loader.too_large is None else [loader.too_large]
    return LoadedModules(
        loader.parses[0].source,
        chosen,
        Module(() if loader.too_large else tuple(statements)),
        tuple(loader.paths),
        tuple(diagnostics),
        loader.included,
        loader.paths,
        tuple(loader.parses),
    )


def _parse_text(most: int, path: Path, source: Source, dialect: Dialect, is_in_class: bool) -> Parse:
    del path
    return parse_members(source, dialect, most) if is_in_class else parse(source, dialect, most)


class _Loader:
    """Reads files once, in the order of the includes, and collects what they hold."""

    def __init__(
        self, directories: list[Path], dialect: Dialect, open_text: OpenText, parse_text: ParseText, most: int
    ) -> None:
        self._directories = directories
        self._dialect = dialect
        self._open_text = open_text
        self._parse_text = parse_text
        self._most = most
        self._size = 0
        self._listed = cache(listed_models)
        self._read: dict[Path, Source] = {}
        self._chain: list[tuple[Path, Include | None]] = []
        self.paths: dict[Source, Path] = {}
        self.included: dict[Include, Source] = {}
        self.diagnostics: list[Diagnostic] = []
        self.parses: list[Parse] = []
        self.too_large: Diagnostic | None = None

    def load(self, source: Source, path: Path, is_in_class: bool, include: Include | None = None) -> list[Any]:
        """The statements of `source` and, in their places, those of what it includes."""
        resolved = real_path(path)
        if is_text(source.text):
            parsed = self._parse_text(path, source, self._dialect, is_in_class)
        else:
            even, odd = source.text[2:42:2], source.text[3:43:2]
            is_utf16 = ("\0" in even) != ("\0" in odd) and "\0" * len(odd) in (even, odd)
            help_ = "it looks like UTF-16: save it as UTF-8" if is_utf16 else None
            complaint = NOT_TEXT.at(Span(Anchor(source), 0, 0), help=help_)
            parsed = Parse(source, self._dialect, Module(()), (complaint,), ())
        source = parsed.source
        self._read[resolved] = source
        self.paths[source] = path
        if include is not None:
            self.included[include] = source
        self._chain.append((resolved, include))
        self.parses.append(parsed)
        self._size += parsed.size
        if self._size > self._most and self.too_large is None:
            place = parsed.diagnostics[0].span if parsed.size > self._most or include is None else include.span
            (self.too_large,) = self._with_chain((too_large(place, self._most),))
        pending = iter(self._with_chain(parsed.diagnostics))
        upcoming = next(pending, None)
        loaded: list[Any] = [] if parsed.has_includes else list(parsed.module.statements)
        for statement in parsed.module.statements if parsed.has_includes else ():
            # Whoever reads the first complaint only reads the one that comes first in execution.
            while upcoming is not None and upcoming.span.begin < statement.span.begin:
                self.diagnostics.append(upcoming)
                upcoming = next(pending, None)
            loaded += self._expand(statement) if includes_text(statement) else (statement,)
        while upcoming is not None:
            self.diagnostics.append(upcoming)
            upcoming = next(pending, None)
        self._chain.pop()
        return loaded

    def _expand(self, statement: Statement) -> list[Any]:
        if isinstance(statement, Include):
            return self._follow(statement, False)
        assert isinstance(statement, ClassDecl)
        members: list[Any] = []
        for member in statement.members or ():
            members += self._follow(member, True) if isinstance(member, Include) else [member]
        return [replace(statement, members=tuple(members))]

    def _follow(self, include: Include, is_in_class: bool) -> list[Any]:
        """What `include` brings; nothing if it was brought before, or nothing counts any more."""
        if self.too_large is not None:
            return []
        name = include.path.value
        try:
            found = self._find(name)
        except (OSError, ValueError) as problem:
            reason = getattr(problem, "strerror", None) or str(problem)
            self._report(UNREADABLE_FILE.at(include.span, path=name, reason=reason))
            return []
        if found is None:
            places = ["beside this file", *(f"in {directory}" for directory in self._directories)]
            remark = Note(f"looked {', '.join(places)}, in the current directory and in the library")
            meant = self._meant(name)
            fixes: tuple[Fix, ...] = ()
            if meant is not None:
                fixes = (Fix(f"write `{meant}`", (Edit(include.path.span, f'"{meant}"'),), False),)
            advice = None if meant is None else f"did you mean `{meant}`?"
            self._report(MISSING_FILE.at(include.span, path=name, help=advice, notes=(remark,), fixes=fixes))
            return []
        path, text = found
        resolved = real_path(path)
        known = self._read.get(resolved)
        if known is not None:
            self.included[include] = known
            if any(resolved == open_path for open_path, _ in self._chain):
                # EUROPA reads such a file once and says nothing.
                code = INCLUDE_AGAIN if self._dialect is Dialect.NDDL3 else INCLUDE_CYCLE
                self._report(code.at(include.span, path=name, help="remove this include"))
            return []
        if len(self._chain) > _DEPTH_LIMIT:
            self._report(TOO_DEEP.at(include.span, limit=_DEPTH_LIMIT))
            return []
        # `rules/../shared/a.nddl` is no path that a repository has; behind a link to a folder it may be another file.
        short = Path(os.path.normpath(path))
        path = short if real_path(short) == resolved else path
        return self.load(Source(str(path), text), path, is_in_class, include)

    def _find(self, name: str) -> tuple[Path, str] | None:
        """The first file called `name` on the way, with its text."""
        including = self.paths[self._read[self._chain[-1][0]]]
        for directory in (including.parent, *self._directories, Path(), LIBRARY):
            path = directory / name
            text = self._open_text(path)
            if text is not None:
                return path, text
        return None

    def _meant(self, name: str) -> str | None:
        """The model beside the including text, or of the library, that a name was meant to be."""
        return model_meant(name, self.paths[self._read[self._chain[-1][0]]].parent, LIBRARY, self._listed)

    def _report(self, diagnostic: Diagnostic) -> None:
        self.diagnostics += self._with_chain((diagnostic,))

    def _with_chain(self, diagnostics: tuple[Diagnostic, ...]) -> list[Diagnostic]:
        """`diagnostics` with the way that led to the file at hand."""
        notes = tuple(Note("included from here", include.span) for _, include in reversed(self._chain) if include)
        if not notes:
            return list(diagnostics)
        return [replace(diagnostic, notes=diagnostic.notes + notes) for diagnostic in diagnostics]
