"""Say what came of a search, as a modeler wants to read it: the drawing, the tokens, the verdict."""

from collections.abc import Iterator, Mapping, Sequence

from nddlc.gantt import Drawing, chart, short, span
from nddlc.load import table
from nddlc.loading import Facts
from runtime.solver.configuration.limits import Limits

HEAD = ("token", "predicate", "state", "object", "start", "duration", "end", "parameters")
VARIABLES = ("variable", "value")
DISPENSABLE = ("parameters", "duration", "predicate", "state", "object")  # the first first
READABLE = 24  # characters of a cell that should be seen
USUAL_WIDTH = 100
MOST_NAMES = 8
INTERRUPTED = "interrupted"


def lines(
    told: Facts,
    drawn: Drawing,
    limits: Limits,
    named: Sequence[str],
    found: Sequence[tuple[str, str]],
    width: int | None,
) -> Iterator[str]:
    """Everything, line by line; `named` are the tokens that the model names, `found` variables and values."""
    drawing = list(chart(drawn, width or USUAL_WIDTH)) if told["solve"]["result"] != "exhausted" else []
    yield from drawing
    if drawing:
        yield ""
    shown = tokens_shown(told, named)
    if shown:
        yield from table(*_fitting(list(map(token_cells, shown)), width), width)
    if hidden := hidden_text(told, shown):
        yield hidden
    if shown or hidden:
        yield ""
    if found:
        yield from table(VARIABLES, found, width)
        yield ""
    yield from verdict(told, limits, named)


def _fitting(rows: list[tuple[str, ...]], room: int | None) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Head and rows with as many columns as can be read side by side in that room."""
    places = list(range(len(HEAD)))
    widths = [min(max(len(row[place]) for row in [HEAD, *rows]), READABLE) for place in places]
    for name in DISPENSABLE:
        if room is None or sum(widths[place] + 2 for place in places) - 2 <= room:
            break
        places.remove(HEAD.index(name))
    return tuple(HEAD[place] for place in places), [tuple(row[place] for place in places) for row in rows]


def tokens_shown(told: Facts, named: Sequence[str]) -> list[Facts]:
    """What is worth a line: what the model names, and what is part of the plan; that by time."""
    own = set(named)
    shown = [token for token in told["tokens"] if token["id"] in own or token["state"] not in ("MERGED", "INACTIVE")]
    return sorted(shown, key=_time)


def _time(token: Facts) -> tuple[float, ...]:
    bounds = [bound for key in ("start", "end") for bound in token.get(key) or ("+inf",)]
    return tuple(bound if isinstance(bound, int) else float(bound) for bound in bounds)


def token_cells(token: Facts) -> tuple[str, ...]:
    """The cells of one token; of what is settled only the value."""
    parameters = ", ".join(f"{name}={short(domain)}" for name, domain in (token.get("params") or {}).items())
    times = [span(token[key]) if token.get(key) else "" for key in ("start", "duration", "end")]
    state = token["state"] if token.get("merged_into") is None else f"{token['state']} {token['merged_into']}"
    return (token["id"], token["predicate"], state, short(token.get("object") or ""), *times, parameters)


def found_values(told: Facts, before: Mapping[str, str]) -> list[tuple[str, str]]:
    """The variables of the model, not of tokens, that the search has narrowed, and what is left of them."""
    tokens = {token["id"] for token in told["tokens"]}
    return [
        (name, short(domain))
        for name, domain in told["domains"].items()
        if before.get(name) != domain and "::" not in name and name.partition(".")[0] not in tokens
    ]


def hidden_text(told: Facts, shown: Sequence[Facts]) -> str:
    """How many tokens are not shown."""
    seen = {token["id"] for token in shown}
    states = [token["state"] for token in told["tokens"] if token["id"] not in seen]
    counts = [f"{states.count(state)} {state.lower()}" for state in dict.fromkeys(states)]
    return f"not shown, as rules made them: {' and '.join(counts)} (--json has all)" if counts else ""


def verdict(told: Facts, limits: Limits, named: Sequence[str]) -> Iterator[str]:
    """How it ended, and what became of goals that are not part of the plan."""
    if told["solve"]["result"] == "plan":
        tokens = {token["id"]: token for token in told["tokens"]}
        own = [tokens[name] for name in named if name in tokens and not tokens[name]["fact"]]
        left = [token for token in own if token["state"] == "INACTIVE" and token["master"] is None]
        beyond = [token["id"] for token in left if not _is_within(token, limits)]
        others = [token["id"] for token in left if _is_within(token, limits)]
        if beyond:
            where = f"may lie outside the horizon from {limits.start} to {limits.end}, see --horizon"
            yield f"not planned, since they {where}: {_listed(beyond)}"
        if others:
            yield f"not planned, since nothing asks for it: {_listed(others)}"
        rejected = [token["id"] for token in own if token["state"] == "REJECTED"]
        if rejected:
            advice = "" if "explanation" in told else " (--explain says why)"
            yield f"rejected: {_listed(rejected)}{advice}"
    yield ending(told)


def _is_within(token: Mapping[str, list[object]], limits: Limits) -> bool:
    start, end = token["start"][0], token["end"][1]
    return isinstance(start, int) and isinstance(end, int) and limits.start <= start and end <= limits.end


def _listed(names: Sequence[str]) -> str:
    more = len(names) - MOST_NAMES
    return ", ".join(names[:MOST_NAMES]) + (f" and {more} more" if more > 0 else "")


def ending(told: Facts) -> str:
    """How the search ended, in one line."""
    solve = told["solve"]
    count = f"{solve['steps']} step{'' if solve['steps'] == 1 else 's'}"
    force = f"{solve['depth']} decision{'' if solve['depth'] == 1 else 's'} in force"
    match solve["result"]:
        case "plan":
            return f"plan found after {count}, {force}"
        case "timeout":
            return f"no plan found yet: stopped after {count}, {force}"
        case "interrupted":
            return f"no plan found yet: interrupted after {count}, {force}"
    if told["consistent"] is False:
        return "no plan exists: the model contradicts itself before any decision"
    return f"no plan exists: all choices fail, after {count}"
