"""`nddlc lint`: everything that is wrong with models, and the mending of what can be mended."""

import difflib
import gc
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import click

from nddl_lang.lint.check import Checker
from nddl_lang.lint.configuration import NAME, PROJECT, is_code, read_configuration
from nddl_lang.lint.settings import Settings, at_least
from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.github import github_line
from nddl_lang.text.junit import junit_of
from nddl_lang.text.printable import counted
from nddl_lang.text.read import read_source
from nddl_lang.text.render import as_dict, render
from nddl_lang.text.sarif import sarif_of
from nddl_lang.text.source import Span
from nddl_lang.text.values import json_text
from nddlc.fitting import colours, say
from nddlc.fixes_left import fixes_left
from nddlc.inputs import (
    Unusable,
    chosen_dialect,
    configured,
    missions_below,
    model_paths,
    models_in,
    parts_in,
    write_text,
)
from nddlc.known import known_callables
from nddlc.main import named
from nddlc.mended_files import MendedFile, mended_files, mended_parts, mission_findings
from nddlc.watch import WatchedCommand

_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "remark", Severity.HINT: "hint"}
_LEVELS = [severity.value for severity in Severity]
_STYLES = ["text", "json", "sarif", "github", "junit"]


@click.command(cls=WatchedCommand)
@model_paths
@click.option("--select", multiple=True, metavar="CODES", help="Report only these: codes, or how they begin.")
@click.option("--ignore", multiple=True, metavar="CODES", help="Do not report these: codes, or how they begin.")
@click.option("--fix", is_flag=True, help="Mend what can be mended without a change of meaning.")
@click.option("--unsafe-fixes", is_flag=True, help="Mend also where the meaning must be looked at.")
@click.option("--diff", "only_show", is_flag=True, help="Show what --fix would change; change nothing.")
@click.option("--level", type=click.Choice(_LEVELS), default="info", help="The least that is reported (info).")
@click.option("--fail-on", type=click.Choice([*_LEVELS, "never"]), help="The least that makes it end with 1 (warning).")
@click.option("--prove", "is_proved", is_flag=True, help="Let z3 look for rules and branches that are impossible.")
@click.option("--statistics", is_flag=True, help="Tell how often each code was found.")
@click.option("--format", "style", type=click.Choice(_STYLES), default="text", help="How to print findings.")
@click.option("--trust", "is_trusted", is_flag=True, help="Run the project's modules instead of reading them.")
@click.pass_context
def command(
    ctx: click.Context,
    files: tuple[str, ...],
    directories: tuple[str, ...],
    dialect: str | None,
    select: tuple[str, ...],
    ignore: tuple[str, ...],
    fix: bool,
    unsafe_fixes: bool,
    only_show: bool,
    level: str,
    fail_on: str | None,
    is_proved: bool,
    statistics: bool,
    style: str,
    is_trusted: bool,
) -> int:
    """Report everything that is wrong with models.

    FILE is a model, a mission file (.toml, or T-REX's .xml or .cfg), or a directory with models and missions; of
    the models, files that others include are looked at as parts of them. Without one it is the folder of the
    project's settings, or this one. Errors stop a model, warnings are very likely mistakes, remarks are worth a
    look. Settings stand in nddlc.toml or in [tool.nddlc] of pyproject.toml, upwards from each file. Ends with 0 if
    nothing weighs as much as --fail-on, with 1 otherwise.
    """
    paths = [*models_in(files, directories), *missions_below(files)]
    # What one run makes lives to its end: looking for garbage would only cost, the more the larger the model.
    gc.disable()
    ctx.call_on_close(gc.enable)
    codes = {name: tuple(_codes(given, name)) for name, given in (("select", select), ("ignore", ignore))}
    parts = parts_in(files, paths, directories)
    checker = Checker(tuple(Path(directory) for directory in directories), chosen_dialect(ctx, dialect), parts)
    checked: list[tuple[Settings, tuple[Diagnostic, ...]]] = []
    found: list[Diagnostic] = []
    seen = set()  # a file that several models include is complained about once
    has_failed = False
    mended = 0
    set_up = [(path, *_settings(path, codes, fail_on, is_trusted)) for path in paths]
    # All is mended before anything is looked at: a mission or a model has part in what is mended in another file.
    is_mended = fix or unsafe_fixes or only_show
    mendable = set(paths)
    for path, settings, _ in set_up if is_mended else ():
        for changed in mended_files(checker, path, settings, unsafe=unsafe_fixes):
            mendable.add(changed.path)
            mended += _mend(changed, only_show=only_show, is_text=style == "text")
    for changed in mended_parts(checker, unsafe=unsafe_fixes) if is_mended else ():
        mendable.add(changed.path)
        mended += _mend(changed, only_show=only_show, is_text=style == "text")
    if only_show:
        return int(mended > 0)
    for path, settings, gaps in set_up:
        findings = _check(checker, path, settings)
        if is_proved and path.suffix not in MISSION_SUFFIXES:
            directories_of = (*(Path(each) for each in directories), *settings.directories)
            findings += _proved(path, settings, directories_of, chosen_dialect(ctx, dialect), findings)
        checked.append((settings, (*settings.choose(gaps), *findings)))
    for settings, findings in checked:
        for each in findings:
            key = (each.span.source.name, each.span.begin, each.code.id, each.message)
            if key in seen or not at_least(each.severity, Severity(level)) or not checker.is_agreed(each):
                continue
            seen.add(key)
            found.append(each)
            has_failed |= settings.fail_on is not None and at_least(each.severity, settings.fail_on)
    found = list(checker.gathered(found))
    left = fixes_left(found, mendable, unsafe=unsafe_fixes) if is_mended else []
    _tell(found, [str(path) for path in paths], style, mended, statistics, left)
    return int(has_failed)


def _check(checker: Checker, path: Path, settings: Settings) -> tuple[Diagnostic, ...]:
    """All that is wrong with a model, a configuration, or a mission file and the models that it names."""
    if path.suffix not in MISSION_SUFFIXES:
        return checker.check(path, settings)
    if path.name in (NAME, PROJECT):
        return tuple(read_configuration(path)[1])
    return tuple(settings.choose(mission_findings(read_source(path), path.parent)))


def _proved(
    path: Path,
    settings: Settings,
    directories: tuple[Path, ...],
    dialect: Dialect | None,
    known: tuple[Diagnostic, ...],
) -> tuple[Diagnostic, ...]:
    """What z3 proves to be impossible, but for what is known already."""
    found = named("checker.proofs.lint:prove_model")(path, directories, dialect or settings.dialect, settings.callables)
    told = [each.span for each in known]
    return tuple(
        each
        for each in settings.choose(found)
        if not any(_overlap(span, other) for span in (each.span, *(note.span for note in each.notes)) for other in told)
    )


def _overlap(one: Span | None, other: Span) -> bool:
    """Whether two spans share a character."""
    if one is None or one.source.name != other.source.name:
        return False
    return one.begin < other.begin + len(other.text) and other.begin < one.begin + len(one.text)


def _codes(given: tuple[str, ...], option: str) -> Iterator[str]:
    for code in ",".join(given).replace(" ", ",").split(","):
        if code and not is_code(code.upper()):
            raise Unusable(f"`{code}` in --{option} is no code", "a code is `NDDL` and up to three digits, as NDDL501")
        if code:
            yield code.upper()


def _settings(
    path: Path, codes: dict[str, tuple[str, ...]], fail_on: str | None, is_trusted: bool
) -> tuple[Settings, tuple[Diagnostic, ...]]:
    """The settings of a file's project, with what the command line adds; and what its modules hide."""
    settings = configured(path)
    callables, gaps = known_callables(settings, is_trusted=is_trusted)
    settings = replace(settings, callables=callables)
    if codes["select"]:
        settings = replace(settings, select=codes["select"])
    if codes["ignore"]:
        settings = replace(settings, ignore=(*settings.ignore, *codes["ignore"]))
    if fail_on is not None:
        settings = replace(settings, fail_on=None if fail_on == "never" else Severity(fail_on))
    return settings, gaps


def _mend(changed: MendedFile, *, only_show: bool, is_text: bool) -> int:
    """Write one file with its fixes, or show how it would be; how many fixes that took."""
    if changed.mended is None:
        click.echo(f"nddlc: `{changed.path}` is not UTF-8 text and is left as it is", err=True)
        return 0
    name, before, after = str(changed.path), changed.before, changed.mended.text
    if after == before:
        return 0
    if not only_show:
        write_text(changed.path, after)
    elif is_text:
        for line in difflib.unified_diff(before.splitlines(keepends=True), after.splitlines(keepends=True), name, name):
            click.echo(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n", nl=False)
    return changed.mended.count


def _tell(
    found: list[Diagnostic], files: list[str], style: str, mended: int, statistics: bool, left: Sequence[str]
) -> None:
    match style:
        case "json":
            click.echo(json_text({"files": files, "diagnostics": [as_dict(each) for each in found]}))
        case "sarif":
            click.echo(sarif_of(found), nl=False)
        case "junit":
            click.echo(junit_of(files, found, Severity.WARNING), nl=False)
        case "github":
            for each in found:
                click.echo(github_line(each))
        case _:
            colour = colours()
            for each in found:
                say(f"{render(each, colour=colour)}\n")
            if statistics:
                for (code, message), count in Counter(
                    (each.code.id, each.code.template) for each in found
                ).most_common():
                    say(f"{count:6}  {code}  {message}\n")
            if mended:
                click.echo(f"{counted(mended, 'fix', 'fixes')} carried out")
            for line in left:
                say(f"{line}\n")
            say(f"{_summary(found, files)}\n")


def _summary(found: Sequence[Diagnostic], files: Sequence[str]) -> str:
    """How many findings of each weight there are, in one line; of a mission file alone, what was not looked for."""
    counts = Counter(each.severity for each in found)
    words = [counted(counts[severity], _WORDS[severity]) for severity in Severity if counts[severity]]
    paths = [Path(each) for each in files]
    missions = [each for each in paths if each.suffix in MISSION_SUFFIXES and each.name not in (NAME, PROJECT)]
    more = ""
    are_missions = all(
        each.suffix in MISSION_SUFFIXES for each in (*paths, *(Path(one.span.source.name) for one in found))
    )
    if missions and not counts[Severity.ERROR] and are_missions:
        more = f" (of its models only errors are told; `nddlc lint {missions[0].parent}` has their warnings)"
    return f"{', '.join(words) or 'nothing wrong'} in {counted(len(files), 'file')}{more}"
