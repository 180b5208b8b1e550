"""What the script of a model wants (`goal`, `rejectable`): told when it is done or given up, as what others ask for."""

from runtime.executive.outcome import EventKind, Reason, ReasonKind
from runtime.executive.trace import Trace
from runtime.executive.workbench import Workbench
from runtime.plan.tags import FLAG_REJECTABLE, INFINITY


class Wishes:
    """The tokens that the script of one reactor's model asks for; nobody else waits for them."""

    def __init__(self, name: str, bench: Workbench, trace: Trace) -> None:
        self.name = name
        self.bench = bench
        self.trace = trace
        self.open = [(token, bench.key(token)) for token in bench.adopt_script()]

    def close(self, tick: int) -> list[int]:
        """Tell of those that are over, or can begin no more; the latter are to leave the plan."""
        bench, left, late = self.bench, [], []
        for token, key in self.open:
            if not bench.is_alive(token, key):
                continue
            if bench.is_over(token, tick):
                self._tell(EventKind.ACHIEVED, token, None)
            elif bench.rows.flags[token] & FLAG_REJECTABLE and bench.is_missed(token, tick):
                kind = ReasonKind.REJECTED if bench.is_rejected(token) else ReasonKind.TOO_LATE
                self._tell(EventKind.REJECT, token, Reason(kind))
                late.append(token)
            else:
                left.append((token, key))
        self.open = left
        return late

    def next_expiry(self) -> float:
        """The first tick at which one without a place in the plan can begin no more."""
        bench, found = self.bench, float(INFINITY)
        for token, key in self.open:
            if bench.is_alive(token, key) and not bench.is_active(token) and not bench.is_merged(token):
                found = min(found, bench.upper(bench.start(token)))
        return found

    def _tell(self, kind: EventKind, token: int, reason: Reason | None) -> None:
        bench = self.bench
        o = bench.object_of(token)
        line = bench.database.objects.names[o] if o >= 0 else ""
        what = (line, bench.short_name(token), bench.arguments(token))
        self.trace.record(kind, self.name, *what, token=bench.name_of(token), reason=reason)
