"""What the agent asks of a reactor, whatever it is made of: a plan, compiled rules, Python code, a log."""

from dataclasses import dataclass

from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Conflict, Deadlock, OpenGoal, Reason
from runtime.plan.readout.names import VariableName

_NEVER = 2**62


@dataclass(frozen=True, slots=True)
class Watched:
    """Element `number` of a conflict says what `variable` is by the word of another reactor.

    That is how long an observed token has been put off, or when another reactor asked for one to be carried out.
    """

    number: int
    variable: VariableName
    source: Observation | Request


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a reactor cannot go on; `conflict` is what broke first, `repairs` what stopped each repair."""

    code: str
    reason: Reason
    timelines: tuple[str, ...]
    conflict: Conflict | None
    relaxes: int
    repairs: tuple[Conflict, ...] = ()
    causes: tuple[int, ...] = ()
    watched: tuple[Watched, ...] = ()
    deadlock: Deadlock | None = None


@dataclass(frozen=True, slots=True)
class SyncFailure:
    """The present cannot be explained: the failure code, where, why, and the conflict."""

    code: str
    timelines: tuple[str, ...]
    reason: Reason
    conflict: Conflict | None
    deadlock: Deadlock | None = None


def code_of_news(news: Observation | None) -> str:
    """The failure where news do not fit: F8 if they say that the owner died, else F2."""
    return "F8" if news is not None and news.predicate == "Failed" else "F2"


@dataclass(frozen=True, slots=True)
class Refusal:
    """The owner will not do what it was asked for; `event` is where the trace says why."""

    request: Request
    event: int
    is_done: bool = (
        False  # all the same, only that it ends at another time: whether that will do is the sender's to say
    )


class TeleoReactor:
    """A controller that owns timelines and uses those of others (T-REX 1.1); this one plans, asks and refuses nothing.

    In a tick the agent calls `start_tick`, `synchronise` and `observations` of each reactor that is due, owners before
    users; then `step` of whoever has work, the most urgent first, and, as soon as one has none left, its `recalls`,
    `requests` and `refusals`; at last `next_tick`. What happens in the deliberation of a tick comes true at the next
    one at the earliest. A reactor that is not due is asleep: nothing may happen there before `due` but by `notify`,
    `accept` and `recall`. Each call must give the same answer in the same mission.
    """

    def __init__(
        self, name: str, internal: tuple[str, ...], external: tuple[str, ...], latency: int, lookahead: int
    ) -> None:
        self.name = name
        self.internal = internal
        self.external = external
        self.latency = latency
        self.lookahead = lookahead
        self.due = 0  # the next tick at which it has something to do; earlier ones cost nothing
        self.missed = _NEVER  # the tick in which the mission ended before its turn came
        self.decisions_made = 0  # in this tick
        self.place = 0  # among all, in the order of synchronising
        self.lacking: list[Refusal] = []  # of requests: over in this tick, without what they needed of others
        self.is_metered = False  # whether the clock grants so many steps a tick
        self.runs_ahead = False  # whether it carries out ticks before the agent comes to them; then it is never asleep

    def set_owners(self, windows: dict[str, tuple[int, int]], execution_latency: int) -> None:
        """Take note of the execution latency and look-ahead of the owner of each timeline, and of its own."""

    def untold(self) -> int:
        """The first tick of what it has carried out ahead and not put on record."""
        return _NEVER

    def pass_over(self, tick: int) -> None:
        """Put on record what it has carried out ahead, up to a tick that has passed."""

    def start_tick(self, tick: int) -> None:
        """Set "now"."""

    def next_tick(self, tick: int) -> int:
        """The next tick at which something can happen without news from outside."""
        return _NEVER

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published this tick; it is due then."""

    def synchronise(self, tick: int) -> Failure | None:
        """Make the plan agree with the world at `tick`, or say why that is impossible."""
        return None

    def observations(self, tick: int) -> list[Observation]:
        """What its own timelines have begun to hold at `tick`."""
        return []

    def urgency(self, tick: int) -> float:
        """How soon it should be given a step: the largest comes first (T-REX 1.3)."""
        return 0.0

    def step(self, tick: int) -> bool:
        """Take in what was asked, or make one planning decision; False if there is nothing left to do."""
        return False

    def has_work(self, tick: int) -> bool:
        """Whether it has something to decide."""
        return False

    def halt(self) -> None:
        """The clock grants no more steps in this tick: what is undecided stays so until the next one."""

    def failure(self) -> Failure | None:
        """Why planning has failed for good, if it has."""
        return None

    def requests(self, tick: int) -> list[Request]:
        """What is to be asked of owners now."""
        return []

    def has_turns(self) -> bool:
        """Whether it has more to ask or take back in this tick, and waits for others."""
        return False

    def recalls(self) -> list[int]:
        """Numbers of the requests that are taken back."""
        return []

    def open_requests(self) -> list[int]:
        """Numbers of the requests that it has made and that are not over."""
        return []

    def refusals(self) -> list[Refusal]:
        """Which of the requests made to it have been refused, rejected or given up since this was last asked."""
        return []

    def refused(self, refusal: Refusal) -> None:
        """Take note that an owner will not do what it was asked for."""

    def accept(self, request: Request) -> None:
        """Queue a request for one of its timelines; it is looked at in the next `step`."""

    def recall(self, number: int) -> None:
        """Queue that a request is taken back, begun or not."""

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were not achieved."""
        return []

    def why_it_lasts(self, token: int, key: int, least: float) -> tuple[VariableName, Conflict] | None:
        """The name of the end of one of its tokens, and what sets it, or makes it `least` or later (-1: it is over)."""
        return None

    def why_asked(self, number: int, name: str, side: int) -> tuple[VariableName, float, Conflict] | None:
        """A time of a token that it has asked for by a request: its name, its bound now, and what sets that."""
        return None

    def hangs_on(self, conflict: Conflict | None) -> tuple[Watched, ...]:
        """The elements of a conflict of its plan that other reactors have to answer for."""
        return ()


def conflicts_beside(first: Conflict | None, failures: list[SyncFailure]) -> tuple[Conflict, ...]:
    """The conflicts of later attempts that differ from the first."""
    found: list[Conflict] = []
    for failure in failures:
        if failure.conflict is not None and failure.conflict != first and failure.conflict not in found:
            found.append(failure.conflict)
    return tuple(found)
