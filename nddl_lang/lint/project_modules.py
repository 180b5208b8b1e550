"""The constraints of a project's Python modules, read and not run: settings in; what models may call, and gaps, out."""

from dataclasses import replace

from nddl_lang.lint.codes import UNREAD_MODULE
from nddl_lang.lint.python_module import Gap, read_module
from nddl_lang.lint.settings import ProjectModule, Settings
from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.semantics.described import Description, DescriptionError, described
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.read import read_text
from nddl_lang.text.source import Anchor, Source, Span

_HELP = "`--trust` runs it; in an editor, trust the workspace"
_REFUSED = "every command that runs it ends with that: mend the module"


def read_callables(
    settings: Settings, native: Callables = NATIVE_CALLABLES
) -> tuple[Callables, tuple[Diagnostic, ...]]:
    """What models of a project may call beside `native`, from the texts of its modules.

    Where something cannot be read, a name that nobody knows may be there: it is not complained about.
    """
    found: list[tuple[str, Description]] = []
    gaps: list[Diagnostic] = []
    for module in {each.path: each for each in settings.modules}.values():
        try:
            source = Source(str(module.path), read_text(module.path) or "")
        except OSError as problem:
            gaps.append(_gap(module, Source(str(module.path), ""), Gap(1, str(problem.strerror or problem))))
            continue
        read = read_module(source.text)
        gaps += [_gap(module, source, gap) for gap in read.gaps[:1]]
        for line, description in read.found:
            try:
                described(native, [*found, (module.path.as_posix(), description)])
            except DescriptionError as problem:
                gaps.append(_gap(module, source, Gap(line, str(problem)), _REFUSED))
            else:
                found.append((module.path.as_posix(), description))
    callables = described(native, found)
    return (replace(callables, has_gaps=True) if gaps else callables), tuple(gaps)


def _gap(module: ProjectModule, source: Source, gap: Gap, help_: str = _HELP) -> Diagnostic:
    lines = source.text.splitlines(keepends=True)
    begin = sum(len(line) for line in lines[: gap.line - 1])
    finish = begin + len(lines[gap.line - 1].rstrip()) if gap.line <= len(lines) else begin
    note = Note("here", Span(Anchor(source), begin, finish)) if lines else None
    return UNREAD_MODULE.at(
        module.span, help=help_, notes=() if note is None else (note,), path=module.path.name, reason=gap.reason
    )
