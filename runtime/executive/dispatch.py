"""Decide which planned tokens are asked of the owners of their timelines, and when requests are taken back."""

from runtime.executive.holding import (
    begin_together,
    due_start,
    follows_late,
    free_at,
    hangs_on_action,
    is_tied,
    keeps_next,
)
from runtime.executive.messages import Request
from runtime.executive.outcome import EventKind, TimeBounds
from runtime.executive.timelines import NOTHING, TimelineState
from runtime.executive.trace import Trace
from runtime.executive.view import whole_bound
from runtime.executive.workbench import Workbench
from runtime.plan.tags import FLAG_SENT, INFINITY


class Dispatch:
    """What one reactor has asked of others."""

    def __init__(self, name: str, bench: Workbench, timelines: list[TimelineState], trace: Trace) -> None:
        self.name = name
        self.bench = bench
        self.timelines = timelines
        self.trace = trace
        self.owner_windows: dict[str, tuple[int, int]] = {}  # execution latency and look-ahead, by timeline
        self.sent: dict[int, Request] = {}  # by the key of the token that was sent, until it is over
        self.sent_tokens: dict[int, int] = {}
        self.refused: dict[int, int] = {}  # by number: the event in which an owner gave a request up
        self.begun: dict[int, None] = {}  # numbers of requests whose owners have begun what they were asked for
        self.over: dict[int, None] = {}  # of these, what something else has followed: there is nothing to take back
        self.is_repaired = False  # the plan was repaired since requests were last compared with it
        bench.asked = self.sent
        bench.defaults = {line.object_id: line.default for line in timelines}

    def is_asked(self, token: int) -> bool:
        """Whether the owner has been asked for a token that is not over."""
        return self.bench.key(token) in self.sent

    def is_refused(self, token: int) -> bool:
        """Whether the owner will not do what it was asked for."""
        request = self.sent.get(self.bench.key(token))
        return request is not None and request.number in self.refused

    def is_answered(self, token: int, event: int) -> bool:
        """Whether what was published in `event` is what a token was asked for."""
        request = self.sent.get(self.bench.key(token))
        return request is not None and request.event in self.trace.events.causes_at(event)

    def answered(self) -> list[int]:
        """The tokens whose owners have just begun what they were asked for."""
        news = [line.news.event for line in self.timelines if line.news is not None]
        tokens = [self.sent_tokens[key] for key in self.sent if self.bench.is_alive(self.sent_tokens[key], key)]
        return [token for token in tokens if any(self.is_answered(token, event) for event in news)]

    def note_begun(self) -> int:
        """Note what owners begin of what they were asked for; if it had been refused, there was room for it again."""
        if not self.sent:
            return 0
        asked = {request.timeline for request in self.sent.values()}
        for line in self.timelines:
            if line.news is not None and line.name in asked:
                for request in self.sent.values():
                    if request.timeline == line.name and request.number in self.begun:
                        self.over[request.number] = None
                for cause in self.trace.events.causes_at(line.news.event):
                    for request in self.sent.values():
                        if request.event == cause:
                            self.begun[request.number] = None
                            self.refused.pop(request.number, None)
        return 0

    def refusals(self) -> tuple[int, ...]:
        """The events in which owners gave up what still is in the plan."""
        return tuple([self.refused[one.number] for one in self.sent.values() if one.number in self.refused])

    def is_cut_off(self, token: int) -> bool:
        """Whether an owner has given up what `token` needs, begun or not."""
        for key, request in self.sent.items():
            t = self.sent_tokens[key]
            if request.number in self.refused and self.bench.is_alive(t, key):
                while t >= 0 and t != token:
                    t = self.bench.parent(t)
                if t == token:
                    return True
        return False

    def notice(self, line: TimelineState) -> int:
        """How many ticks ahead the owner of a timeline is asked: its window begins that much later (T-REX 1.1)."""
        latency, lookahead = self.owner_windows.get(line.name, (0, 1))
        return latency + lookahead

    def takes_requests(self, line: TimelineState) -> bool:
        """Whether the owner of a timeline may be asked: the model must allow it, and who looks ahead by 0 never is."""
        return line.accepts_requests and self.owner_windows.get(line.name, (0, 1))[1] > 0

    def requests(self, tick: int, final_tick: int) -> list[Request]:
        """Planned tokens on others' timelines that are due to be asked for (T-REX 1.8).

        They are asked for one after the other: what the plan puts behind a token whose end is still to be observed
        waits. What cannot begin before the mission ends is not asked.
        """
        asked = []
        for line in self.timelines:
            if line.is_internal or not self.takes_requests(line):
                continue
            while (token := self.next_request(line)) != NOTHING and self._is_due(line, token, tick, final_tick):
                request = self._ask(line, token, tick)
                asked.append(request)
                self._note_sent(request, token)
        return asked

    def _is_due(self, line: TimelineState, token: int, tick: int, final_tick: int) -> bool:
        """Whether a token is to be asked for now."""
        if self.bench.lower(self.bench.start(token)) >= final_tick or self.due_time(line, token, tick) > tick:
            return False
        return self._free_at(line, token, tick) <= tick

    def _free_at(self, line: TimelineState, token: int, tick: int) -> float:
        """The first tick at which nothing holds back `token`, nor what is to be asked for with it, if nothing happens.

        Two commands for one tick are given together: if one owner began sooner, both would be asked for in vain.
        """
        free = self._freed_at(line, token, tick)
        for other in self.timelines:
            if free <= tick and other is not line and not other.is_internal and self.takes_requests(other):
                mate = self.bench.next_of(other.object_id, other.current)
                while mate != NOTHING and not begin_together(self.bench, token, mate):
                    mate = self.bench.following(mate)
                if mate != NOTHING and self.is_refused(mate):
                    return INFINITY
                if mate != NOTHING and not self.is_asked(mate):
                    free = self._freed_at(other, mate, tick)
        return free

    def _freed_at(self, line: TimelineState, token: int, tick: int) -> float:
        """The first tick at which nothing holds `token` back, if nothing happens until then."""
        bench = self.bench
        # What an action needs is not waited with: often the world changes by that alone (T-REX 1.8).
        if hangs_on_action(bench, token):
            return tick
        if token != self.next_request(line):
            return self._waits_until(line, tick)
        free = free_at(bench, token, line.current, tick)
        return free if free == INFINITY else max(free, follows_late(bench, token, tick))

    def due_time(self, line: TimelineState, token: int, tick: int) -> float:
        """The tick at which the owner is to be asked for a token (T-REX 1.8).

        That is as soon as its earliest start, or the later one that counts for it, is in the owner's window.
        """
        time = due_start(self.bench, token, tick)
        # What has not started may do so from the next tick on.
        return time - max(self.notice(line), 1)

    def next_due(self, line: TimelineState, tick: int) -> float:
        """The next tick at which something may have to be asked for on a timeline, if nothing happens until then."""
        if (token := self.next_request(line)) != NOTHING:
            return max(self.due_time(line, token, tick), self._free_at(line, token, tick))
        return self._waits_until(line, tick)

    def _waits_until(self, line: TimelineState, tick: int) -> float:
        """The tick at which what waits for the end of what is open on a timeline cannot wait any more."""
        bench, before = self.bench, self.open_now(line)
        token = bench.next_of(line.object_id, line.current)
        while token != NOTHING:
            if before != NOTHING and not is_tied(bench, bench.end(before), bench.start(token)):
                return tick + bench.upper(bench.start(token)) - bench.lower(bench.end(before))
            before, token = token, bench.following(token)
        return INFINITY

    def open_now(self, line: TimelineState) -> int:
        """The current token of a timeline if that was asked for, and what comes next waits for its end; or NOTHING."""
        return line.current if line.current != NOTHING and keeps_next(self.bench, line.current) else NOTHING

    def next_request(self, line: TimelineState) -> int:
        """The planned token that is to be asked for next; NOTHING while another is open, or where none is planned.

        What must begin as the open one ends cannot wait until that was seen: then nothing could begin in time.
        """
        bench = self.bench
        before = self.open_now(line)
        token = bench.next_of(line.object_id, line.current)
        while token != NOTHING:
            if before != NOTHING:
                if self.is_refused(before) or not is_tied(bench, bench.end(before), bench.start(token)):
                    return NOTHING
            if not self.is_asked(token):
                return token
            before = token
            token = bench.following(token)
        return NOTHING

    def _ask(self, line: TimelineState, token: int, tick: int) -> Request:
        bench = self.bench
        predicate = bench.short_name(token)
        arguments = bench.arguments(token)
        causes = tuple([other.event for other in self.timelines if not other.is_internal and other.event != NOTHING])
        bounds = self._bounds(line.name, token, tick)
        event = self.trace.record(
            EventKind.REQUEST,
            self.name,
            line.name,
            predicate,
            arguments,
            causes[:1],
            token=bench.name_of(token),
            request=len(self.trace.events),
            bounds=bounds,
        )
        return Request(
            event, line.name, predicate, arguments, bounds.start, bounds.end, bounds.duration, self.name, event
        )

    def _bounds(self, timeline: str, token: int, tick: int) -> TimeBounds:
        """When the owner of a timeline may carry out a token, and how long.

        To the world a request is a command: when to begin is the sender's business, how long it takes is not.
        """
        bench = self.bench
        earliest = max(tick + 1, whole_bound(bench.lower(bench.start(token))))
        start = (earliest, whole_bound(bench.upper(bench.start(token))))
        if self.owner_windows.get(timeline, (0, 1))[1] <= 1:
            return TimeBounds(start, (-INFINITY, INFINITY), (1, INFINITY))
        end, length = bench.end(token), bench.duration(token)
        duration = (whole_bound(bench.lower(length)), whole_bound(bench.upper(length)))
        return TimeBounds(start, (whole_bound(bench.lower(end)), whole_bound(bench.upper(end))), duration)

    def open_requests(self) -> list[int]:
        """Numbers of the requests that have been made and are not over."""
        return [request.number for request in self.sent.values()]

    def recalls(self, tick: int) -> list[int]:
        """Numbers of the requests that the plan does not wait for any more, begun or not; what is over is forgotten."""
        numbers, apart = [], self._come_apart(tick)
        for key, request in list(self.sent.items()):
            token = self.sent_tokens[key]
            is_done = request.number in self.over
            if not self.bench.is_alive(token, key) and self._hand_on(request, key, tick):
                continue
            if not is_done and (key in apart or self._is_void(request, token, key, tick)):
                self.trace.record(
                    EventKind.RECALL,
                    self.name,
                    request.timeline,
                    request.predicate,
                    request.arguments,
                    request=request.number,
                )
                numbers.append(request.number)
            elif not is_done and not self.bench.is_over(token, tick):
                continue
            self.refused.pop(request.number, None)
            self.begun.pop(request.number, None)
            self.over.pop(request.number, None)
            del self.sent[key]
            del self.sent_tokens[key]
            if self.bench.is_alive(token, key):
                self.bench.rows.set_flag(token, FLAG_SENT, False)
        self.is_repaired = False
        return numbers

    def _come_apart(self, tick: int) -> list[int]:
        """The keys of tokens that still wait for what runs, when another, which is to begin with them, has begun alone.

        What has gone on so holds back what is planned next: asked for at once they would only come apart again.
        """
        bench, apart = self.bench, []
        for key, request in self.sent.items():
            token = self.sent_tokens[key]
            if request.number not in self.begun or not bench.is_alive(token, key) or bench.is_started(token, tick):
                continue
            for line in self.timelines:
                if line.current == NOTHING or bench.is_met_by(bench.predicate_of(line.current), line.default):
                    continue
                mate = bench.next_of(line.object_id, line.current)
                other = self.sent.get(bench.key(mate)) if mate != NOTHING else None
                if other is None or other.number in self.begun or other.start[0] > tick:
                    continue
                if bench.is_active(token) and begin_together(bench, token, mate):
                    bench.lasting[line.object_id] = bench.key(line.current)
                    apart.append(bench.key(mate))
        return apart

    def _hand_on(self, request: Request, key: int, tick: int) -> bool:
        """Have a request stand for what the plan wants in just its place; what leaves it in a repair is recalled."""
        if self.is_repaired or request.number in self.begun or request.number in self.refused:
            return False
        for line in self.timelines:
            token = NOTHING if line.name != request.timeline else self.bench.next_of(line.object_id, line.current)
            while token != NOTHING:
                if not self.is_asked(token) and self.bench.short_name(token) == request.predicate:
                    if self._is_as_asked(request, token, tick):
                        del self.sent[key], self.sent_tokens[key]
                        self._note_sent(request, token)
                        return True
                token = self.bench.following(token)
        return False

    def _note_sent(self, request: Request, token: int) -> None:
        self.sent[self.bench.key(token)] = request
        self.sent_tokens[self.bench.key(token)] = token
        self.bench.rows.set_flag(token, FLAG_SENT, True)

    def _is_as_asked(self, request: Request, token: int, tick: int) -> bool:
        """Whether a planned token has the times and arguments that its owner was asked for."""
        now = self._bounds(request.timeline, token, tick)
        earliest = max(tick + 1, request.start[0])  # as time goes on, a request bears later times by itself
        first_end = -INFINITY if request.end[0] == -INFINITY else max(earliest + request.duration[0], request.end[0])
        asked = ((earliest, request.start[1]), (first_end, request.end[1]), request.duration)
        is_timely = (now.start, now.end, now.duration) == asked
        return is_timely and self.bench.arguments(token) == request.arguments

    def _is_void(self, request: Request, token: int, key: int, tick: int) -> bool:
        """Whether the plan does not wait for a request: its token is gone, or is to begin anew or otherwise.

        A repair may have cut a token loose from the observation that it had met, or planned it for another time. What
        an owner gave up is asked for anew where the plan leaves it more room than it did.
        """
        bench = self.bench
        if not bench.is_alive(token, key):
            return True
        if not bench.is_active(token):  # after a repair it may stand for what its owner had begun
            has_met = bench.is_merged(token) and bench.is_fact(bench.stands_for(token))
            return not (has_met and request.number in self.begun)
        if bench.is_started(token, tick):
            return False
        if request.number in self.begun or self._is_overtaken(request.timeline, token):
            return True
        if request.number in self.refused:
            now = self._bounds(request.timeline, token, tick)
            if _is_wider((now.start, now.end, now.duration), (request.start, request.end, request.duration)):
                return True
        return self.is_repaired and not self._is_as_asked(request, token, tick)

    def _is_overtaken(self, timeline: str, token: int) -> bool:
        """Whether the plan has come to put before a token what its owner has not been asked for yet."""
        for line in self.timelines:
            if line.name == timeline:
                other = self.bench.next_of(line.object_id, line.current)
                while other not in (NOTHING, token):
                    if not self.is_asked(other):
                        return True
                    other = self.bench.following(other)
        return False


def _is_wider(one: tuple[tuple[int, int], ...], other: tuple[tuple[int, int], ...]) -> bool:
    """Whether one of some intervals reaches beyond its like of the other ones."""
    return any(low < least or high > most for (low, high), (least, most) in zip(one, other, strict=True))
