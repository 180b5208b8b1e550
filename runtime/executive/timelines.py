"""What a reactor knows of each of its timelines: who owns it, what holds on it now, what was asked for."""

from runtime.executive.messages import Observation, Request

NOTHING = -1


class TimelineState:
    """One timeline of one reactor; `current` is the token that holds now, NOTHING before the first."""

    def __init__(self, name: str, object_id: int, is_internal: bool, default: int, predicates: dict[str, int]) -> None:
        self.name = name
        self.object_id = object_id
        self.is_internal = is_internal
        self.default = default
        self.predicates = predicates
        # What an internal timeline may hold when nothing else explains now (T-REX 1.4, choice OTHER).
        self.others = [p for name, p in predicates.items() if p != default and name not in ("undefined", "Failed")]
        self.planned: set[int] = set()  # its predicates, and those that they inherit: what a plan may call its tokens
        self.accepts_requests = False  # whether its users may ask for tokens, by the model
        self.is_early = False  # whether what is planned starts as soon as it may, though nobody asked for it
        self.is_late = False  # whether what nobody asked for starts only when it must
        self.current = NOTHING
        self.event = NOTHING
        self.news: Observation | None = None
        self.source: Observation | None = None  # what the current token of another reactor's timeline came from


class Goal:
    """A request that its owner has turned into a token."""

    def __init__(self, request: Request, token: int, token_key: int) -> None:
        self.request = request
        self.token = token
        self.token_key = token_key
        self.is_closed = False
        self.is_rejected = False  # the planner could not insert it, so far
        self.is_loose = False  # it runs, and what was asked of its end cannot be met
        self.failed_starts = 0  # how often the present failed when what it had asked for began
