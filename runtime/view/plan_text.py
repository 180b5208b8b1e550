"""Result of a search as text: the chart, the tokens, the values found, the verdict."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from runtime.plan.readout.open_levels import OpenLevel
from runtime.plan.readout.state import PlanState, TokenState
from runtime.plan.store.domain_texts import DomainText
from runtime.solver.configuration.limits import Limits
from runtime.view.drawing import Drawing, interval_text, readable
from runtime.view.gantt import chart
from runtime.view.table import table

HEAD = ("token", "predicate", "state", "object", "start", "duration", "end", "parameters")
VARIABLES = ("variable", "value")
INTERRUPTED = "interrupted"
_DISPENSABLE = ("parameters", "duration", "predicate", "state", "object")  # the first first
_READABLE = 24  # characters of a cell that should be seen
_USUAL_WIDTH = 100
_MOST_NAMES = 8


@dataclass(frozen=True, slots=True)
class PlanReport:
    """What came of a search: the plan as it is, how the search ended, and which tokens the model itself names."""

    plan: PlanState
    result: str
    steps: int
    depth: int
    limits: Limits
    named: frozenset[str]
    values: Sequence[tuple[str, str]]  # variables of the model that the search has narrowed
    was_consistent: bool  # before the search
    is_complete: bool  # whether a search that found nothing tried all there is
    is_europa: bool
    goals: frozenset[str]  # what was asked for and may not be given up
    is_explained: bool
    creeping: Sequence[str]  # places of constraints whose bounds still move: nobody knows whether values remain
    open_levels: Sequence[OpenLevel]  # of a plan that was found

    @property
    def is_exhausted(self) -> bool:
        """Whether there is no plan."""
        return self.result == "exhausted"

    @property
    def shown(self) -> list[TokenState]:
        """What is worth a line: what the model names, and what is part of the plan; that by time."""
        tokens = self.plan.tokens
        shown = [each for each in tokens if each.name in self.named or each.state not in ("MERGED", "INACTIVE")]
        return sorted(shown, key=_times)

    def beyond(self) -> list[str]:
        """The goals that are not planned since they may lie outside the horizon, or whose own subgoals are not."""
        waiting = {each.parent for each in self.plan.tokens if each.state == "INACTIVE" and not self.is_within(each)}
        left = [each for each in self.plan.tokens if each.name in self.goals and not self.is_within(each)]
        return [each.name for each in left if each.state == "INACTIVE" or each.name in waiting]

    def is_within(self, token: TokenState) -> bool:
        """Whether a token lies in the horizon, whatever its times come to be."""
        own = token.extent
        return own is not None and self.limits.start <= own.start[0] and own.end[1] <= self.limits.end

    def hidden_text(self) -> str:
        """How many tokens are not shown."""
        seen = {token.name for token in self.shown}
        states = [token.state for token in self.plan.tokens if token.name not in seen]
        counts = [f"{states.count(state)} {state.lower()}" for state in dict.fromkeys(states)]
        return f"not shown, as rules made them: {' and '.join(counts)} (--json has all)" if counts else ""


def lines(report: PlanReport, drawn: Drawing, width: int | None) -> Iterator[str]:
    """Everything, line by line."""
    drawing = [] if report.is_exhausted else list(chart(drawn, width or _USUAL_WIDTH))
    yield from drawing
    if drawing:
        yield ""
    shown = report.shown
    if shown:
        yield from table(*_fitting(list(map(token_cells, shown)), width), width)
    if hidden := report.hidden_text():
        yield hidden
    if shown or hidden:
        yield ""
    if report.values:
        yield from table(VARIABLES, report.values, width)
        yield ""
    yield from verdict(report)


def _fitting(rows: list[tuple[str, ...]], room: int | None) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Head and rows with as many columns as can be read side by side in that room."""
    kept = list(range(len(HEAD)))
    widths = [min(max(len(row[column]) for row in [HEAD, *rows]), _READABLE) for column in kept]
    for name in _DISPENSABLE:
        if room is None or sum(widths[column] + 2 for column in kept) - 2 <= room:
            break
        kept.remove(HEAD.index(name))
    return tuple(HEAD[column] for column in kept), [tuple(row[column] for column in kept) for row in rows]


def _times(token: TokenState) -> tuple[float, ...]:
    return (float("inf"),) * 2 if token.extent is None else (*token.extent.start, *token.extent.end)


def token_cells(token: TokenState, *, is_full: bool = False) -> tuple[str, ...]:
    """The cells of one token; of a domain with one value only that value, unless domains are shown in full."""
    state = token.state if token.merged_into is None else f"{token.state} {token.merged_into}"
    own = token.extent
    if own is None:
        return (token.name, token.predicate, state, "", "", "", "", "")
    shown = [f"{name} {each}" if is_full else f"{name}={readable(each.brief)}" for name, each in own.parameters.items()]
    times = (interval_text(own.start), interval_text(own.duration), interval_text(own.end))
    holder = str(own.object) if is_full else own.object.brief
    return (token.name, token.predicate, state, holder, *times, ", ".join(shown))


def found_values(plan: PlanState, before: Mapping[str, DomainText]) -> list[tuple[str, str]]:
    """The variables of the model, not of tokens, that the search has narrowed, and what is left of them."""
    return [(name, readable(domain.brief)) for name, domain in plan.variables.items() if before.get(name) != domain]


def verdict(report: PlanReport) -> Iterator[str]:
    """How it ended, and what became of goals that are not part of the plan."""
    if report.result == "plan":
        own = [token for token in report.plan.tokens if token.name in report.named and not token.is_fact]
        left = [token for token in own if token.state == "INACTIVE" and token.parent is None]
        named = report.beyond()
        active = [token.name for token in own if token.state == "ACTIVE" and token.name in named]
        beyond = [name for name in named if name not in active]
        beyond += [token.name for token in left if not report.is_within(token) and token.name not in beyond]
        others = [token.name for token in left if report.is_within(token)]
        where = f"may lie outside the horizon from {report.limits.start} to {report.limits.end}, see --horizon"
        if beyond:
            yield f"not planned, since they {where}: {_listed(beyond)}"
        if active:
            yield f"nothing planned of what these ask for, since they {where}: {_listed(active)}"
        if others:
            yield f"not planned, since nothing asks for it: {_listed(others)}"
        rejected = [token.name for token in own if token.state == "REJECTED"]
        if rejected:
            advice = "" if report.is_explained else " (--explain says why)"
            yield f"rejected: {_listed(rejected)}{advice}"
        for each in report.open_levels:
            yield f"not decided: {each.text()}; a ResourceThreatManager in --config mends this"
    yield _ending(report)


def _listed(names: Sequence[str]) -> str:
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "")


def _ending(report: PlanReport) -> str:
    """How the search ended, in one line."""
    count = f"{report.steps} step{'' if report.steps == 1 else 's'}"
    force = f"{report.depth} decision{'' if report.depth == 1 else 's'} in force"
    match report.result:
        case "plan":
            if left := len(report.beyond()):
                return f"plan found after {count}, {force}, but {left} goal{'' if left == 1 else 's'} left out"
            if report.creeping:
                yet = f"bounds still move at {_listed(report.creeping)}, so values may not exist"
                return f"no plan known: all flaws are resolved after {count}, {force}, but {yet}"
            if loose := len(report.open_levels):
                may = f"{loose} resource{'' if loose == 1 else 's'} may leave {'its' if loose == 1 else 'their'} limits"
                return f"plan found after {count}, {force}, but {may}"
            if not report.steps and not report.plan.tokens:
                return f"plan found after {count}, {force}: no goal asks for anything, so there was nothing to plan"
            return f"plan found after {count}, {force}"
        case "timeout":
            return f"no plan found yet: stopped after {count}, {force}"
        case "interrupted":
            return f"no plan found yet: interrupted after {count}, {force}"
    if report.is_europa and not report.is_complete:
        return f"EUROPA's search finds no plan: all its choices fail, after {count}; `--strategy nddlc` tries more"
    if not report.is_complete:
        return f"no plan found: all choices of this search fail, after {count}; it does not try all there are"
    if not report.was_consistent:
        return "no plan exists: the model contradicts itself before any decision"
    return f"no plan exists: all choices fail, after {count}"
