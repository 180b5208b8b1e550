"""Findings with their stories in, the pages of `nddlc explain` for the example of each fault out, to be kept."""

import time
from collections.abc import Sequence
from functools import partial

from checker.batch.explanations import Explanation, Sources
from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.campaign import Campaign
from checker.contrast import Contrast, Trace
from checker.counterfactual.effort import Stopwatch
from checker.counterfactual.ranking import Causes
from checker.counterfactual.tried import TrialsEnd
from checker.excerpts import Excerpts
from checker.explain import page_text
from checker.faults import Interruptible
from checker.findings import Fault, Findings
from checker.oracle import Verdict
from checker.story import Story
from runtime.executive.configuration import AgentConfiguration

_MOST_SECONDS = 10.0  # of the processor, for what sets the examples apart, which is flown


def explanations(
    campaign: Campaign,
    findings: Findings,
    results: Sequence[MissionResult],
    stories: Sequence[Story | None],
    sources: Sources,
    excerpts: Excerpts,
    let: Interruptible,
) -> list[Explanation]:
    """The pages; `results` are all that the store has of the run. What the time does not suffice for is left out."""
    by_number = {one.number: one for one in results}
    first = min((one.number for one in results if one.verdict is Verdict.FAIL), default=0)
    found: list[Explanation] = []
    with Flyer(campaign.load, campaign.models.agent, campaign.mission.check.time_limit) as flyer:
        watch = Stopwatch(lambda: time.process_time() + flyer.processor_seconds)

        def trace(agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
            if watch.has_passed(_MOST_SECONDS):
                return by_number[number]  # what comes of it is not kept
            left = _MOST_SECONDS - watch.seconds
            return campaign.judged(flyer.fly(agent, number, seed, keeps_trace=True, most_seconds=left))

        for fault, story in zip(findings.faults, stories, strict=True):
            if story is None or not _is_sought(fault.causes):
                continue
            example = by_number[fault.bucket.example]
            told = let(partial(_told, campaign, example, results, fault, trace))
            if told is None:
                flyer.dismiss()  # it may be in the middle of a flight
            if told is None or watch.has_passed(_MOST_SECONDS):
                break
            flights = None if fault.causes.ended is TrialsEnd.COMPLETE else fault.causes.flights - fault.causes.beyond
            again = campaign.story(example, fault, results, told[0])
            page = page_text(again, told[0], findings.run_id, excerpts)
            found.append(Explanation(example.number, example.number == first, flights, sources, page))
    return found


def _told(
    campaign: Campaign, example: MissionResult, results: Sequence[MissionResult], fault: Fault, trace: Trace
) -> tuple[Contrast | None]:
    """What sets an example apart, if anything does, once it is known."""
    return (campaign.contrast(example, results, fault, trace),)


def _is_sought(causes: Causes) -> bool:
    return causes.is_sought and causes.ended in (TrialsEnd.COMPLETE, TrialsEnd.FLIGHTS)
