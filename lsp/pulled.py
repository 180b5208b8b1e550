"""Pull diagnostics: a file in; what is wrong with it, or that nothing has changed since it was asked last, out."""

from collections.abc import Mapping

from lsprotocol.types import (
    Diagnostic,
    DocumentDiagnosticReport,
    RelatedFullDocumentDiagnosticReport,
    RelatedUnchangedDocumentDiagnosticReport,
    WorkspaceDiagnosticReport,
    WorkspaceFullDocumentDiagnosticReport,
    WorkspaceUnchangedDocumentDiagnosticReport,
)

from lsp.documents import Documents


class PulledDiagnostics:
    """Numbers what it tells about each file, so that the same need not be told twice."""

    def __init__(self, documents: Documents, of_missions: Mapping[str, tuple[Diagnostic, ...]]) -> None:
        self._documents = documents
        self._of_missions = of_missions
        self._count = 0
        self._told: dict[str, tuple[str, tuple[Diagnostic, ...]]] = {}

    def report(self, uri: str, previous: str | None) -> DocumentDiagnosticReport:
        """What is wrong with one file."""
        number, found = self._number(uri)
        if number == previous:
            return RelatedUnchangedDocumentDiagnosticReport(number)
        return RelatedFullDocumentDiagnosticReport(found, result_id=number)

    def workspace_report(self, known: Mapping[str, str]) -> WorkspaceDiagnosticReport:
        """What is wrong with all files of open models, and with those that were asked about before."""
        items: list[WorkspaceFullDocumentDiagnosticReport | WorkspaceUnchangedDocumentDiagnosticReport] = []
        for uri in dict.fromkeys((*self._documents.complained(), *self._of_missions, *known)):
            number, found = self._number(uri)
            document = self._documents.find(uri)
            version = document.version if document is not None else None
            if known.get(uri) == number:
                items.append(WorkspaceUnchangedDocumentDiagnosticReport(uri, number, version))
            else:
                items.append(WorkspaceFullDocumentDiagnosticReport(uri, found, version, result_id=number))
        return WorkspaceDiagnosticReport(items)

    def _number(self, uri: str) -> tuple[str, tuple[Diagnostic, ...]]:
        found = self._of_missions.get(uri) or self._documents.complaints(uri)
        known = self._told.get(uri)
        if known is None or known[1] != found:
            self._count += 1
            known = self._told[uri] = str(self._count), found
        return known
