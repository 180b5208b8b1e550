"""Sequential stopping: a rule such as `p<0.01@95%` in, whether missions so far have shown or refuted it out."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from checker.betting import log_stake, log_wealth
from checker.rate import rate_interval
from checker.sampling.sampler import MissionRole, SamplePoint

_RULE = re.compile(r"\s*p\s*([<>])\s*([0-9.]+(?:e-?[0-9]+)?)\s*(%?)\s*@\s*([0-9.]+)\s*%\s*", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class StopRule:
    """End when a confidence sequence at `confidence` lies wholly below `rate`, or wholly above it."""

    text: str
    is_below: bool
    rate: float
    confidence: float

    def outcome(self, flown: Sequence[tuple[bool, SamplePoint]], most_weight: float) -> bool | None:
        """True: shown; False: the opposite is shown; None: still open."""
        counted = [(failed, point) for failed, point in flown if point.role is not MissionRole.DESIGNED]
        if any(point.role is MissionRole.WEIGHTED for _, point in counted):
            values = [point.weight if failed else 0.0 for failed, point in counted]
            above, below = log_wealth(values, max(most_weight, 1.0), self.rate)
            needed = log_stake(self.confidence)
            if below[-1] >= needed:
                return self.is_below
            return not self.is_below if above[-1] >= needed else None
        interval, _ = rate_interval(flown, self.confidence, most_weight=most_weight, is_sequential=True)
        if interval is None:
            return None
        if interval[1] <= self.rate:
            return self.is_below
        return not self.is_below if interval[0] >= self.rate else None


def parse_rule(text: str) -> StopRule | None:
    """Read a rule; None where it is none."""
    match = _RULE.fullmatch(text)
    if match is None:
        return None
    try:
        rate = float(match[2]) / (100.0 if match[3] else 1.0)
        confidence = float(match[4]) / 100.0
    except ValueError:
        return None
    if not (0.0 < rate < 1.0 and 0.5 <= confidence < 1.0):
        return None
    return StopRule(" ".join(text.split()), match[1] == "<", rate, confidence)
