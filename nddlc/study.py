"""`nddlc study`: fly variants of a mission's models under several samplings, with common seeds; draw Figure 12."""

import time
from contextlib import ExitStack
from pathlib import Path

import click

from checker.batch.connection import StoreError
from checker.batch.store import RunStore, open_store
from checker.campaign import Campaign, Enough, Flown
from checker.mission import read_mission
from checker.pinned import pinned
from checker.report.study import study_data, study_page, study_svg, study_text
from checker.study.cells import StudyCell, campaign_of, cell_of, lay_out, with_beyond
from checker.study.reading import StudyFile, Variant, read_study
from nddl_lang.text.render import render
from nddlc.check import cores
from nddlc.fitting import colours
from nddlc.inputs import STORE, Unusable, readable, write_text
from nddlc.mission_trust import models_of
from nddlc.progress import Display
from nddlc.trust import trust_option

_DONE, _FINDINGS, _SIGNALLED = 0, 1, 128
_OUTPUT = Path("nddlc-study")
_FOLDER = Path(".nddlc/study")


@click.command()
@click.argument("path", metavar="STUDY")
@click.option("--missions", type=click.IntRange(1), help="Fly at most so many of each cell; more may follow later.")
@click.option("--variant", "names", multiple=True, metavar="NAME", help="Only these variants; repeatable.")
@click.option("--sampling", "samplings", multiple=True, metavar="NAME", help='Only these samplings ("uniform inter").')
@click.option("--workers", type=click.IntRange(1), help="Processes to fly with; by default one per core.")
@click.option("--seconds", type=click.FloatRange(0.0, min_open=True), help="End when so much time is over.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where missions are kept.")
@click.option("--output", type=click.Path(path_type=Path), default=_OUTPUT, help="Where figure and table go.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="What to print.")
@click.option("--dry-run", is_flag=True, help="Only look whether the study, its missions and models are in order.")
@trust_option
def command(
    path: str,
    missions: int | None,
    names: tuple[str, ...],
    samplings: tuple[str, ...],
    workers: int | None,
    seconds: float | None,
    store_path: Path,
    output: Path,
    style: str,
    dry_run: bool,
    is_trusted: bool,
) -> int:
    """Fly every variant of a study under every sampling, and say which sampling finds which mistake.

    What is flown is kept: the same command goes on where it ended, and with more --missions it flies only those that
    are missing. Ends with 1 where a rate lies outside of what the study expects, or a mission ended in an ERROR.
    """
    (file,) = readable((path,), ())
    study, found = read_study(file)
    for one in found:
        click.echo(render(one, colour=colours()), err=True)
    if study is None:
        raise Unusable("the study file is in error: nothing was flown")
    _refuse_unknown(names, [one.name for one in study.variants], "variant")
    _refuse_unknown(samplings, list(study.samplings), "sampling")
    chosen = [one for one in study.variants if not names or one.name in names]
    wanted = [one for one in study.samplings if not samplings or one in samplings]
    flight = _Study(study, is_trusted, workers or cores(), None if seconds is None else time.monotonic() + seconds)
    if dry_run:
        for variant in chosen:
            flight.base(variant)
        click.echo(_plan_text(chosen, wanted, missions))
        return _DONE
    try:
        with open_store(store_path) as store:
            cells, ended_by = flight.fly_all(chosen, wanted, missions, store)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    cells = list(with_beyond(cells))
    if ended_by:
        click.echo(study_text(study, cells) if style == "text" else study_data(study, cells), nl=False)
        click.echo(
            "\nended by a signal: the same command goes on, and draws the figure when it comes to its end", err=True
        )
        return _SIGNALLED + ended_by
    reports = {"study.json": study_data(study, cells), "figure12.svg": study_svg(study, cells)}
    for name, text in {**reports, "study.html": study_page(study, cells)}.items():
        write_text(output / name, text, "--output names a folder; what was flown is kept in --store")
    click.echo(study_text(study, cells) if style == "text" else reports["study.json"], nl=False)
    if style == "text":
        click.echo(f"\nfigure: {output / 'study.html'} (beside it figure12.svg, study.json)")
    is_off = any(one.errors or one.is_expected(study.corridor) is False for one in cells)
    return _FINDINGS if is_off else _DONE


def _plan_text(variants: list[Variant], samplings: list[str], missions: int | None) -> str:
    """What would be flown."""
    counts = [min(one.missions, missions or one.missions) * len(samplings) for one in variants]
    names = ", ".join(one.name for one in variants)
    cells = len(variants) * len(samplings)
    return (
        f"{cells} cell{'' if cells == 1 else 's'} ({names}; {', '.join(samplings)}), {sum(counts)} missions; "
        "models are in order; nothing was flown"
    )


def _refuse_unknown(given: tuple[str, ...], known: list[str], what: str) -> None:
    for one in given:
        if one not in known:
            raise Unusable(f"the study has no {what} `{one}`", f"there are: {', '.join(known)}")


class _Study:
    """Flies the cells of a study until its time is over."""

    def __init__(self, study: StudyFile, is_trusted: bool, workers: int, until: float | None) -> None:
        self.study, self.is_trusted, self.workers, self.until = study, is_trusted, workers, until

    def base(self, variant: Variant) -> Campaign:
        """A variant's mission as its file says, with the models checked."""
        file = lay_out(self.study, variant, _FOLDER)
        mission, found = read_mission(file)
        for one in found:
            click.echo(render(one, colour=colours()), err=True)
        if mission is None:
            raise Unusable(f"the mission of variant `{variant.name}` is in error")
        models = models_of(mission, is_trusted=self.is_trusted)
        if models.has_errors:
            for one in models.diagnostics:
                click.echo(render(one, colour=colours()), err=True)
            raise Unusable(f"the models of variant `{variant.name}` are in error")
        return Campaign(mission, models, pinned(models))

    def fly_all(
        self, variants: list[Variant], samplings: list[str], missions: int | None, store: RunStore
    ) -> tuple[list[StudyCell], int]:
        """The cells, up to the one that a signal has ended; the signal, 0 where none came."""
        cells: list[StudyCell] = []
        for variant in variants:
            base = self.base(variant)
            for sampling in samplings:
                cell, ended_by = self._fly(base, variant, sampling, missions, store)
                cells.append(cell)
                if ended_by:
                    return cells, ended_by
        return cells, 0

    def _fly(
        self, base: Campaign, variant: Variant, sampling: str, missions: int | None, store: RunStore
    ) -> tuple[StudyCell, int]:
        """Fly what a cell lacks, unless no time is left; the cell, and the signal that ended it."""
        campaign = campaign_of(self.study, variant, sampling, base)
        left = None if self.until is None else self.until - time.monotonic()
        if left is not None and left <= 0.0:
            return cell_of(variant, sampling, variant.missions, store.results(campaign.run.id)), 0
        enough = Enough(seconds=left, missions=missions)
        with ExitStack() as stack:
            click.echo(f"{variant.name}, {sampling}", err=True)
            show = stack.enter_context(Display(self.study.confidence))
            flown: Flown = campaign.fly(self.workers, store, enough=enough, progress=show, keeps_failures=False)
        planned = min(variant.missions, missions or variant.missions)
        return cell_of(variant, sampling, planned, flown.results), int(flown.ended_by or 0)
