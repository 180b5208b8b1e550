"""`nddlc rule`: what a code means, why it is complained about, and an example of either kind."""

import textwrap
from collections.abc import Iterator

import click

from checker.rulebook import PAGES
from nddl_lang.rulebook import configuration, readable
from nddl_lang.text.nearest import nearest
from nddl_lang.text.page import RulePage
from nddlc.inputs import Unusable

_WIDTH = 100


@click.command()
@click.argument("code", required=False)
@click.option("--list", "is_list", is_flag=True, help="List all codes, as without a code.")
def command(code: str | None, is_list: bool) -> None:
    """Explain a code that a message carries; without a code, list them all."""
    if code is None or is_list:
        for page in PAGES.values():
            click.echo(f"{page.code.id}  {page.code.severity.value:<7}  {readable(page.code)}")
        return
    found = PAGES.get(code.upper())
    if found is None:
        whole = f"NDDL{code}"
        meant = whole if whole in PAGES else nearest(code.upper(), PAGES)
        raise Unusable(f"there is no code `{code}`", f"did you mean `{meant}`?" if meant else "`nddlc rule` lists them")
    click.echo("\n".join(_page(found)))


def _page(page: RulePage) -> Iterator[str]:
    code = page.code
    yield f"{code.id} ({code.severity.value}): {readable(code)}"
    for paragraph in (page.what, page.why):
        yield ""
        yield from textwrap.wrap(paragraph, _WIDTH)
    for caption, example in (("Instead of", page.bad), ("write", page.good)):
        yield ""
        yield caption
        yield ""
        yield textwrap.indent(example.rstrip("\n"), "    ")
    for paragraph in configuration(code):
        yield ""
        yield from textwrap.wrap(paragraph, _WIDTH)
