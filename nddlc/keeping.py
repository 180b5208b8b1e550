"""Findings of `nddlc check` in, kept with their run in the store, so that `nddlc explain` need not fly for them.

Where that fails, nothing is lost: `explain` finds out anew.
"""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from checker.batch.connection import StoreError
from checker.batch.result import write_record
from checker.batch.store import open_store
from checker.campaign import Campaign, Flown
from checker.conditions.record import write_condition
from checker.excerpts import Excerpts
from checker.faults import Interruptible, Sought
from checker.findings import Ending, Findings
from checker.names import as_named
from checker.pages import explanations
from checker.sought import read_sought, write_sought
from checker.sources import sources_of
from checker.story import Story


def sought_before(flown: Flown, run_id: str, seal: str, store_path: Path) -> tuple[Sought, ...] | None:
    """All that was found of the faults of a run that is flown again as it was; None where they must be sought."""
    if flown.ending is Ending.SIGNAL:
        return None
    with suppress(StoreError), open_store(store_path) as store:
        text = store.sought(run_id, seal)
        return None if text is None else read_sought(text)
    return None


def keep_findings(findings: Findings, seal: str, store_path: Path) -> None:
    """Have the store remember conditions and causes, and all together for who checks the same again."""
    whole = write_sought(findings)
    faults = [fault for fault in findings.faults if not fault.is_cut]
    known = {fault.bucket.example: write_condition(fault.condition) for fault in faults}
    known |= {part: write_condition(one.bucket.example) for one in faults for part in one.bucket.parts[1:]}
    causes = {fault.bucket.example: write_record(fault.causes) for fault in faults if fault.causes.is_sought}
    with suppress(StoreError), open_store(store_path) as store:
        store.keep_conditions(findings.run_id, known)
        store.keep_causes(findings.run_id, causes)
        if whole is not None:
            store.keep_sought(findings.run_id, seal, whole)


def keep_pages(
    campaign: Campaign,
    flown: Flown,
    findings: Findings,
    stories: Sequence[Story | None],
    store_path: Path,
    let: Interruptible,
) -> None:
    """Have the store remember what there is to tell of the example of each fault of a run that came to its end."""
    sources = sources_of(campaign.mission, campaign.models)
    if sources is None or findings.ending is not Ending.COMPLETE or findings.is_cut:
        return
    stored = [*flown.results, *(one.result for one in flown.cases if not one.case.is_promoted)]
    stored.sort(key=lambda one: one.number)
    excerpts = Excerpts(as_named(campaign.run.mission_file).parent)
    pages = explanations(campaign, findings, stored, stories, sources, excerpts, let)
    with suppress(StoreError), open_store(store_path) as store:
        store.keep_explanations(findings.run_id, pages)
