"""What `run`, `replay` and `gold` share: a mission file read and its models checked, and values for parameters."""

import re
from pathlib import Path

import click

from checker.mission import Mission, read_mission
from checker.mission_table import HELD, is_held
from checker.models import ModelSet
from checker.names import relative_name
from checker.sampling.rendering import describe
from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.nearest import nearest
from nddl_lang.text.printable import counted
from nddl_lang.text.render import render
from nddlc.fitting import colours, columns, fitted
from nddlc.inputs import Unusable, readable
from nddlc.mission_trust import models_of
from runtime.executive.configuration import ParameterConfiguration

_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
_MOST_WARNINGS = 3  # that are shown before a flight


def prepare(
    path: str, *, is_trusted: bool, is_named: bool = True, is_linted: bool = False
) -> tuple[Path, Mission, ModelSet]:
    """Read a mission and its models; what is wrong with them is told, and an error ends the command.

    `is_named`: the command line names the mission, not a file that the command line names. `is_linted`: what lint warns
    of is told, too, in short.
    """
    (file,) = readable((path,), ())
    if file.suffix not in MISSION_SUFFIXES:
        raise Unusable(f"`{path}` is no mission file (.toml, or T-REX's .xml or .cfg)")
    mission, found = read_mission(file)
    if mission is None:
        _tell(found)
        raise Unusable("the mission file is in error: nothing was flown")
    models = models_of(mission, is_trusted=is_trusted, is_named=is_named, is_linted=is_linted)
    _tell(untold((*found, *models.diagnostics), models))
    if models.has_errors:
        raise Unusable("the models are in error: nothing was flown")
    click.echo(fitted(warnings_page(models), columns()), nl=False, err=True)
    return file, mission, models


def _tell(diagnostics: tuple[Diagnostic, ...]) -> None:
    for one in diagnostics:
        if one.severity in (Severity.ERROR, Severity.WARNING):
            click.echo(fitted(render(one, colour=colours()), columns()), err=True)


def untold(found: tuple[Diagnostic, ...], models: ModelSet) -> tuple[Diagnostic, ...]:
    """What is to be told in full: all but what `warnings_page` tells in short."""
    if models.has_errors:
        return found
    told = {(one.span.source.name, one.span.begin, one.code.id) for one in models.findings[:_MOST_WARNINGS]}
    return tuple(one for one in found if (one.span.source.name, one.span.begin, one.code.id) not in told)


def warnings_page(models: ModelSet) -> str:
    """What lint warns of in the models of a mission, in short: how much it is, and the first few."""
    findings = models.findings
    if not findings:
        return ""
    root = Path(models.agent.root)
    lines = [f"{counted(len(findings), 'warning')} about these models (`nddlc lint` shows them in full):"]
    for one in findings[:_MOST_WARNINGS]:
        line, column = one.span.source.locate(one.span.begin)
        name = relative_name(one.span.source.name, root)
        lines.append(f"  {name}:{line}:{column}: {one.message} [{one.code.id}]")
    lines += [f"  and {len(findings) - _MOST_WARNINGS} more"] if len(findings) > _MOST_WARNINGS else []
    return "\n".join(lines) + "\n"


def _may_be_drawn(parameter: ParameterConfiguration, value: float) -> bool:
    """Whether a draw of a parameter may have a value; of those with open ends or an expression nothing is said."""
    if parameter.values:
        return value in parameter.values
    return parameter.distribution != "uniform" or parameter.lower <= value <= parameter.upper


def values_of(given: tuple[str, ...], models: ModelSet) -> dict[str, float]:
    """Values for parameters, from `NAME=VALUE`."""
    known = [parameter.name for parameter in models.agent.parameters]
    values: dict[str, float] = {}
    for one in given:
        name, _, text = one.partition("=")
        if name not in known:
            meant = nearest(name, known)
            advice = f"did you mean `{meant}`?" if meant is not None else f"there are: {', '.join(known) or 'none'}"
            raise Unusable(f"the models sample no parameter `{name}`", advice)
        is_number = _NUMBER.fullmatch(text) is not None
        if not is_number or not is_held(float(text)):
            wanted = f"a number {HELD}" if is_number else "a number"
            problem = f"`{name}` takes {wanted}, not `{text}`" if text else f"`{one}` gives no value"
            raise Unusable(problem, f"write `{name}=` and a number")
        values[name] = float(text)
        parameter = next(one for one in models.agent.parameters if one.name == name)
        if parameter.is_whole and not values[name].is_integer():
            raise Unusable(f"`{name}` takes a whole number, not `{text}`", f"it is {describe(parameter)}")
        if not _may_be_drawn(parameter, values[name]):
            click.echo(f"note: {text} is never drawn: {name} is {describe(parameter)}", err=True)
    return values
