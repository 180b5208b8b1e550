"""Take back findings that a comment in the text asks to leave out.

`// nddlc: ignore NDDL501` holds for its line, or, alone on a line, for the next; `// nddlc: ignore-file NDDL501` for
its file. Several codes stand with commas, also in brackets; a shorter one stands for all that begin so; without codes
all findings are meant. Errors cannot be ignored.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain

from nddl_lang.analysis import Analysis
from nddl_lang.lint.codes import NO_SUCH_CODE, UNUSED_SUPPRESSION
from nddl_lang.syntax.removal import removal
from nddl_lang.text.diagnostic import Diagnostic, Fix, Severity
from nddl_lang.text.source import Source, Span

_COMMENT = re.compile(r"nddlc:[ \t]*ignore(?P<file>-file)?\b[ \t]*(?P<codes>\[[^\]\n]*\]|[^\n]*)")
_CODE = re.compile(r"NDDL\d{0,3}\Z")


@dataclass(eq=False, slots=True)
class _Suppression:
    """One comment; `line` is the line that it holds for, None for the whole file."""

    span: Span
    line: int | None
    codes: tuple[str, ...]
    used: set[str]

    def matches(self, finding: Diagnostic) -> bool:
        """Whether the comment takes back a finding of its line; which of its codes did is noted."""
        if not self.codes:
            self.used.add("")
            return True
        matching = [code for code in self.codes if finding.code.id.startswith(code)]
        self.used.update(matching)
        return bool(matching)


_Asked = dict[Source, dict[int | None, list[_Suppression]]]  # by line, so that many comments cost no more than few


def suppress(analysis: Analysis, findings: tuple[Diagnostic, ...], *, is_linted: bool) -> tuple[Diagnostic, ...]:
    """The findings that no comment takes back, and complaints about comments that take nothing back."""
    asked: _Asked = {}
    complaints: list[Diagnostic] = []
    for parse in analysis.loaded.parses:
        source = parse.source
        if "nddlc:" not in source.text:
            continue
        for span in parse.comments:
            suppression = _read(span, complaints)
            if suppression is not None:
                asked.setdefault(source, {}).setdefault(suppression.line, []).append(suppression)
    if not asked and not complaints:
        return findings
    kept = [finding for finding in findings if not _is_taken_back(finding, asked)]
    if is_linted:
        root = analysis.loaded.root
        kept += (each for each in complaints if each.span.source is root)
        of_root = chain.from_iterable(asked.get(root, {}).values())
        kept += (each for each in _unused(of_root) if not _is_taken_back(each, asked))
    return tuple(kept)


def _read(span: Span, complaints: list[Diagnostic]) -> _Suppression | None:
    text = span.text
    match = _COMMENT.search(text)
    if match is None or text[: match.start()].strip(" \t/*"):
        return None
    codes: list[str] = []
    words = match["codes"].split("--")[0].replace("*/", "").strip(" \t[]\r")
    for code in re.split(r"[,\s]+", words) if words else ():
        if _CODE.match(code):
            codes.append(code)
        elif code.upper().startswith("NDDL"):
            complaints.append(NO_SUCH_CODE.at(span, help="a code is `NDDL` and three digits", text=code))
            return None
        else:
            break  # words that say why
    line: int | None = None
    if match["file"] is None:
        source = span.source
        line, column = source.locate(span.begin)
        if not source.line(line)[: column - 1].strip():
            line = source.locate(span.finish)[0] + 1
    return _Suppression(span, line, tuple(codes), set())


def _is_taken_back(finding: Diagnostic, asked: _Asked) -> bool:
    lines = asked.get(finding.span.source)
    if finding.severity is Severity.ERROR or lines is None:
        return False
    near = (*lines.get(None, ()), *lines.get(finding.span.line, ()))
    matching = [each for each in near if each.matches(finding)]
    return bool(matching)


def _unused(suppressions: Iterable[_Suppression]) -> Iterator[Diagnostic]:
    for each in suppressions:
        left = [code for code in each.codes if code not in each.used]
        if UNUSED_SUPPRESSION.id in each.codes:
            continue
        if (not each.codes and not each.used) or (each.codes and len(left) == len(each.codes)):
            fix = Fix("remove the comment", (removal(each.span),))
            yield UNUSED_SUPPRESSION.at(each.span, fixes=(fix,), what="")
        elif left:
            yield UNUSED_SUPPRESSION.at(each.span, what=" with the code " + " or ".join(f"`{code}`" for code in left))
