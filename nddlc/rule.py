"""`nddlc rule`: what a code means, why it is complained about, and an example of either kind."""

import textwrap
from collections.abc import Iterator

import click

from checker import mission_codes
from nddl_lang.lint import configuration as configuration_codes
from nddl_lang.rulebook import PAGES, configuration, readable
from nddl_lang.syntax import codes as syntax_codes
from nddl_lang.text.diagnostic import Code
from nddl_lang.text.nearest import nearest
from nddlc.inputs import Unusable
from runtime.plan import faults
from runtime.solver import complaints

WIDTH = 100


@click.command()
@click.argument("code", required=False)
@click.option("--list", "is_list", is_flag=True, help="List all codes, as without a code.")
def command(code: str | None, is_list: bool) -> None:
    """Explain a code that a message carries; without a code, list them all."""
    known = {each.id: each for each in _codes()}
    if code is None or is_list:
        for each in known.values():
            click.echo(f"{each.id}  {each.severity.value:<7}  {readable(each)}")
        return
    found = known.get(code.upper())
    if found is None:
        meant = nearest(code.upper(), known)
        raise Unusable(f"there is no code `{code}`", f"did you mean `{meant}`?" if meant else "`nddlc rule` lists them")
    click.echo("\n".join(_page(found)))


def _codes() -> list[Code]:
    """All codes, by number."""
    found = {page.code.id: page.code for page in PAGES.values()}
    for module in (syntax_codes, configuration_codes, faults, complaints, mission_codes):
        found |= {each.id: each for each in vars(module).values() if isinstance(each, Code)}
    return [found[name] for name in sorted(found)]


def _page(code: Code) -> Iterator[str]:
    yield f"{code.id} ({code.severity.value}): {readable(code)}"
    page = PAGES.get(code.id)
    if page is None:
        return
    for paragraph in (page.what, page.why):
        yield ""
        yield from textwrap.wrap(paragraph, WIDTH)
    for caption, example in (("Instead of", page.bad), ("write", page.good)):
        yield ""
        yield caption
        yield ""
        yield textwrap.indent(example.rstrip("\n"), "    ")
    for paragraph in configuration(code):
        yield ""
        yield from textwrap.wrap(paragraph, WIDTH)
