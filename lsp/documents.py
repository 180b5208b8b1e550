"""Keep what is open in the editor, and the models that these texts belong to; say what is wrong with each file."""

from collections.abc import Callable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from lsprotocol.types import Diagnostic as Shown
from lsprotocol.types import Range

from lsp.diagnostics import Conversion
from lsp.open_text import Document, DocumentContext, Publication
from lsp.positions import Encoding, Lines, replaced
from lsp.project import Project, ServerSettings, Snapshot
from lsp.roots import all_roots, root_of
from lsp.shown_text import ShownText, show
from lsp.uris import key_of, path_of, uri_of
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.read import read_text
from nddl_lang.text.source import Source

_T = TypeVar("_T")


class Documents:
    """The open texts. Each belongs to at least one project: its own, or those of texts that include it.

    Methods that change something return what the editor must be told, each file that changed once.
    """

    def __init__(self, settings: ServerSettings | None = None, encoding: Encoding = Encoding.UTF16) -> None:
        self.encoding = encoding
        self.settings = settings or ServerSettings()
        self._open: dict[str, Document] = {}  # by key, in order of opening
        self._uris: dict[str, str] = {}  # of what is open: URI -> key
        self.folders: tuple[Path, ...] = ()  # of the workspace
        self._projects: dict[str, Project] = {}
        self._edited: dict[str, None] = {}  # keys of texts that were edited and not analysed since
        self._closed: dict[str, Project] = {}  # models of which no text is open, read when somebody asks
        self._found: dict[str, dict[str, tuple[Shown, ...]]] = {}  # project -> URI -> complaints
        self._shown: dict[str, dict[str, ShownText]] = {}  # project -> name of a source -> what became of it
        # What else is wrong with files, beside what their texts tell: by URI.
        self.others: Callable[[], Mapping[str, tuple[Shown, ...]]] = dict
        self._published: dict[str, tuple[Shown, ...]] = {}

    # ---- what the editor does ----

    def open(self, uri: str, version: int, text: str) -> list[Publication]:
        """A text is open now."""
        path = path_of(uri)
        name = str(path) if path is not None else _plain(uri)
        key = key_of(path) if path is not None else name
        if (other := self._open.pop(key, None)) is not None:
            self._uris.pop(other.uri, None)
        self._open[key] = Document(uri, key, name, path, version, Lines(text, self.encoding))
        self._uris[uri] = key
        self._shown.clear()  # the editor may call the file otherwise
        return self._follow({key}, key)

    def edit(self, uri: str, version: int, edits: list[tuple[Range | None, str]]) -> bool:
        """A text was edited: each edit stands in the text that the ones before left; without a range it is all.

        It is analysed when somebody asks: `analyse`. Whether there is such a text.
        """
        document = self.find(uri)
        if document is None:
            return False
        for place, text in edits:
            whole = text if place is None else replaced(document.lines, place, text)
            document.lines = Lines(whole, self.encoding)
        document.version = version
        self._edited[document.key] = None
        return True

    def analyse(self) -> list[Publication]:
        """Analyse what was edited since; of several edits only the newest text counts."""
        return self._follow(set(), None) if self._edited else []

    def change(self, uri: str, version: int, edits: list[tuple[Range | None, str]]) -> list[Publication]:
        """A text was edited, and is analysed at once."""
        self.edit(uri, version, edits)
        return self.analyse()

    @property
    def is_in_repair(self) -> bool:
        """Whether `repair` has something left to do."""
        return any(project.is_in_repair for project in self._projects.values())

    def repair(self, trials: int | None = None) -> list[Publication]:
        """Try so many of the edits that may mend models with errors, or all of them; nothing after an edit."""
        found = []
        for project in () if self._edited else self._projects.values():
            if project.is_in_repair:
                if project.repair(trials):
                    self._found[project.key] = self._complaints(project)
                    found.append(project)
                if trials is not None:
                    break
        return list(self._news([])) if found else []

    def save(self, uri: str) -> list[Publication]:
        """A text was saved; other files may have changed as well."""
        del uri
        return self.refresh()

    def refresh(self) -> list[Publication]:
        """Files may have changed on the disk."""
        for project in self._projects.values():
            project.look_again()
        return self._follow({member for project in self._projects.values() for member in project.members}, None)

    def configure(self, settings: ServerSettings) -> list[Publication]:
        """Other settings hold from now on: all models are read anew."""
        if settings == self.settings:
            return []
        self.settings = settings
        self._closed.clear()
        for key in list(self._projects):
            self._drop(key)
        return self._follow(set(), None)

    def close(self, uri: str) -> list[Publication]:
        """A text is no longer open: what is on the disk counts from now on."""
        document = self.find(uri)
        if document is None:
            return []
        del self._open[document.key], self._uris[document.uri]
        self._shown.clear()
        # What was understood as a part of it looks for its model afresh.
        self._drop(document.key)
        return self._follow({document.key}, None)

    # ---- what requests ask ----

    def find(self, uri: str) -> Document | None:
        """The open text that the editor calls `uri`."""
        key = self._uris.get(uri)
        return self._open[key] if key is not None else None

    def view(self, uri: str) -> DocumentContext | None:
        """The open text with the model that it belongs to."""
        document = self.find(uri)
        return self._context(document) if document is not None else None

    def context(self, uri: str) -> DocumentContext | None:
        """Like `view`, also for a text that is not open, as part of an open model or of a closed one."""
        document = self.find(uri)
        if document is not None:
            return self._context(document)
        path = path_of(uri)
        if path is None:
            return None
        key = key_of(path)
        around = (project.snapshot for project in chain(self._around(key), self.holders(key)))
        snapshot = next(around, None) or self.model(path)
        if snapshot is None or key not in snapshot.parses:
            return None
        parse = snapshot.parses[key]
        document = Document(uri, key, str(path), path, 0, Lines(parse.source.text, self.encoding))
        return DocumentContext(document, snapshot, parse)

    def _context(self, document: Document) -> DocumentContext | None:
        for project in self._around(document.key):
            return DocumentContext(document, project.snapshot, project.snapshot.parses[document.key])
        return None

    def complaints(self, uri: str) -> tuple[Shown, ...]:
        """What is wrong with a file now."""
        return self._published.get(uri, ())

    def shown_uris(self) -> set[str]:
        """The files of open models with which something is wrong, or was before an error took the findings back."""
        return {each.uri for shown in self._shown.values() for each in shown.values()}

    def complained(self) -> list[str]:
        """The files with which something is wrong."""
        return list(self._published)

    def open_documents(self) -> list[Document]:
        """The open texts, in order of opening."""
        return list(self._open.values())

    def text(self, key: str) -> str | None:
        """The text of the file at `key`: as it is open, or on the disk; None without such a file."""
        document = self._open.get(key)
        if document is not None:
            return document.lines.text
        try:
            return read_text(Path(key))
        except (OSError, ValueError):
            return None

    def snapshots(self) -> list[Snapshot]:
        """The models of the open texts."""
        return [project.snapshot for project in self._projects.values()]

    def lines_of(self, key: str) -> tuple[str, Lines]:
        """What the editor calls the file at `key`, and its lines: as they are open, or on the disk."""
        document = self._open.get(key)
        if document is not None:
            return document.uri, document.lines
        return uri_of(Path(key)), Lines(read_text(Path(key)) or "", self.encoding)

    def uri(self, source: Source) -> str:
        """What the editor calls the file that `source` was read from."""
        key = key_of(Path(source.name))
        document = self._open.get(source.name) or self._open.get(key)
        return document.uri if document is not None else uri_of(Path(source.name))

    # ---- projects ----

    def holders(self, key: str) -> list[Project]:
        """The models that the file at `key` is a part of: those of open texts, and closed ones in the workspace."""
        found = [project for project in self._projects.values() if key in project.snapshot.parses]
        known = {project.key for project in found}
        for root in all_roots(key, self.folders):
            name = key_of(root)
            if name in known or name in self._projects:
                continue
            project = self._closed.get(name)
            if project is None:
                project = self._closed[name] = Project(name, self.settings)
            self._read(project)
            if key in project.snapshot.parses:
                found.append(project)
        return found

    def model(self, path: Path) -> Snapshot | None:
        """The model whose root is the file at `path`, with texts as they are open; None where there is no such file."""
        key = key_of(path)
        project = self._projects.get(key) or self._closed.get(key)
        if project is None:
            if not path.is_file():
                return None
            project = self._closed[key] = Project(key, self.settings)
        if key not in self._projects:
            self._read(project)
        return project.snapshot

    def probe(self, key: str, text: str) -> Snapshot:
        """The model that the text at `key` belongs to, read from the beginning, as if that text read `text`."""
        root = next(self._around(key), None)
        project = Project(root.key if root is not None else key, self.settings)
        self._read(project, {key: text})
        return project.snapshot

    def trial(self, project: Project, texts: Mapping[str, str], look: Callable[[Snapshot], _T]) -> _T:
        """What `look` sees of a model whose texts read otherwise; afterwards all is as it was."""
        is_repaired = project.is_repaired
        try:
            self._read(project, texts)
            return look(project.snapshot)
        finally:
            self._read(project)
            if is_repaired:
                project.repair()

    def _around(self, key: str) -> Iterator[Project]:
        """The projects that a text belongs to; first those whose own text is open."""
        around = [project for project in self._projects.values() if key in project.snapshot.parses]
        yield from sorted(around, key=lambda project: project.key not in self._open)

    def _follow(self, changed: set[str], edited: str | None) -> list[Publication]:
        """Analyse again what a change of these texts touches, and tell what is new."""
        told = [*self._edited, *([edited] if edited is not None else ())]
        changed.update(self._edited)
        self._edited.clear()
        for project in list(self._projects.values()):
            if not changed.isdisjoint(project.snapshot.parses):
                self._analyse(project)
        self._found_projects()
        self._drop_projects()
        self._found_projects()
        return list(self._news(told))

    def _found_projects(self) -> None:
        """Give each open text that belongs to no project one."""
        for document in list(self._open.values()):
            if next(self._around(document.key), None) is None:
                self._found_project(document)

    def _found_project(self, document: Document) -> None:
        """Give a text a model: the one that it is a part of on the disk, or one of its own."""
        root = root_of(document.path) if document.path is not None else None
        # A model that is open already does not hold the text as it stands: its include is being written.
        if root is not None and key_of(root) not in self._projects:
            project = Project(key_of(root), self.settings)
            if self._analyse(project) and document.key in project.snapshot.parses:
                self._projects[project.key] = project
                return
            self._found.pop(project.key, None)
        project = Project(document.key, self.settings)
        self._analyse(project)
        self._projects[project.key] = project

    def _drop_projects(self) -> None:
        """Drop the projects whose texts all belong to others, or are all closed."""
        for project in list(self._projects.values()):
            others = [other for other in self._projects.values() if other is not project]
            mine = [key for key in project.snapshot.parses if key in self._open]
            if project.key in self._open:
                is_needed = not any(project.key in other.snapshot.parses for other in others)
            else:
                is_needed = not all(self._is_held(key, others) for key in mine)
            if not is_needed:
                self._drop(project.key)

    def _drop(self, key: str) -> None:
        self._projects.pop(key, None)
        self._found.pop(key, None)
        self._shown.pop(key, None)

    def _is_held(self, key: str, projects: list[Project]) -> bool:
        return any(key in project.snapshot.parses and project.key in self._open for project in projects)

    def _analyse(self, project: Project) -> bool:
        """Take a new snapshot of a project; whether its text could be read."""
        is_readable = self._read(project)
        self._found[project.key] = self._complaints(project)
        return is_readable

    def _read(self, project: Project, texts: Mapping[str, str] = MappingProxyType({})) -> bool:
        """Take a new snapshot of a project, with `texts` in place of those of the same key; whether it has a text."""

        def text_of(path: Path) -> str | None:
            key = key_of(path)
            if (given := texts.get(key)) is not None:
                return given
            document = self._open.get(key)
            return document.lines.text if document is not None else read_text(path)

        document = self._open.get(project.key)
        name = document.name if document is not None else project.key
        text = texts.get(project.key)
        if text is None and document is not None:
            text = document.lines.text
        if text is None:
            try:
                text = read_text(Path(name)) or ""
            except (OSError, ValueError):
                text = ""
        project.analyse(name, text, text_of)
        return bool(text)

    # ---- complaints ----

    def conversion(self) -> Conversion:
        """What turns our places into the editor's."""
        return Conversion(self.encoding, self.uri, {one.uri: one.lines for one in self._open.values()})

    def _complaints(self, project: Project) -> dict[str, tuple[Shown, ...]]:
        """What the editor shows of each file; of files that stay as they are it is what it showed before."""
        by_source: dict[Source, list[Diagnostic]] = {}
        for diagnostic in project.snapshot.diagnostics:
            by_source.setdefault(diagnostic.span.source, []).append(diagnostic)
        # What is shown of a file is kept while nothing is wrong with it: an error elsewhere hides it for a moment.
        sources = {source.name for source in project.snapshot.analysis.loaded.sources}
        before = self._shown.get(project.key, {})
        known = {name: old for name, old in before.items() if name in sources}
        merged: dict[str, tuple[Shown, ...]] = {}
        conversion = self.conversion()
        for source, found in by_source.items():
            known[source.name] = each = show(source, found, conversion, before.get(source.name))
            merged[each.uri] = (*merged.get(each.uri, ()), *each.shown)
        self._shown[project.key] = known
        return merged

    def _news(self, edited: list[str]) -> Iterator[Publication]:
        """What differs from what the editor was told; of texts that were edited always, for their versions."""
        merged: dict[str, tuple[Shown, ...]] = {}
        for project in self._projects.values():
            for uri, complaints in self._found[project.key].items():
                before = merged.get(uri, ())
                merged[uri] = (*before, *(each for each in complaints if each not in before)) if before else complaints
        for uri, complaints in self.others().items():
            merged[uri] = (*merged.get(uri, ()), *complaints)
        told = dict.fromkeys(document.uri for key in edited if (document := self._open.get(key)) is not None)
        for uri in dict.fromkeys([*told, *merged, *self._published]):
            complaints = merged.get(uri, ())
            if complaints == self._published.get(uri, ()) and uri not in told:
                continue
            document = self.find(uri)
            yield Publication(uri, document.version if document is not None else None, complaints)
        self._published = merged


def _plain(uri: str) -> str:
    """`uri` without what the name of a file cannot hold."""
    return uri.replace("\0", "").encode("utf-8", "replace").decode("utf-8")
