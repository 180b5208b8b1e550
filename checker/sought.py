"""What was sought of the faults of a run and found, kept with the run: who checks again what is stored need not fly.

It holds for the same results, sought in the same way by the same nddlc; then the reports are the same, byte by byte.
"""

import hashlib
import json
from collections.abc import Sequence

from checker.batch.engine import engine_digest
from checker.batch.result import MissionResult, read_record, write_record
from checker.conditions.record import read_condition, write_condition
from checker.counterfactual.ranking import Causes
from checker.counterfactual.tried import TrialsEnd
from checker.faults import Sought
from checker.findings import Ending, Findings

_WHOLE = (TrialsEnd.COMPLETE, TrialsEnd.FLIGHTS)  # more time would show no more


def seal_of(results: Sequence[MissionResult], flights: int, confidence: float, *, tests_conditions: bool) -> str:
    """The SHA-256 of all that findings depend on beside the run itself."""
    told = [(one.number, one.verdict.value, one.judgement.code) for one in results]
    content = json.dumps([engine_digest(), sorted(told), flights, confidence, tests_conditions])
    return hashlib.sha256(content.encode()).hexdigest()


def write_sought(findings: Findings) -> str | None:
    """What was found, as a line of JSON; None where a signal or the clock ended the search, or the run."""
    if findings.ending is Ending.SIGNAL or findings.is_cut:
        return None
    if any(fault.causes.ended not in _WHOLE for fault in findings.faults):
        return None
    return json.dumps(
        [
            [fault.bucket.parts, write_record(fault.causes), write_condition(fault.condition)]
            for fault in findings.faults
        ]
    )


def read_sought(text: str) -> tuple[Sought, ...]:
    """What `write_sought` wrote."""
    found = []
    for parts, causes, condition in json.loads(text):
        known = read_condition(condition)
        assert not isinstance(known, int)
        found.append(Sought(tuple(parts), read_record(Causes, causes), known))
    return tuple(found)
