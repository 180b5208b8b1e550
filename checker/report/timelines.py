"""Two missions beside each other: what held on each timeline over time, as SVG, with the causal chain marked."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from checker.batch.result import MissionResult
from checker.oracle import given_up
from checker.sampling.rendering import number
from checker.steps import StepKind
from checker.story import Story
from runtime.executive.events import heads_of
from runtime.executive.outcome import Event, Outcome
from runtime.view.axis import ticks

_WIDTH, _LABEL, _ROW, _TOP, _FOOT = 420.0, 78.0, 19.0, 22.0, 22.0
_MOST_BARS = 160  # of one timeline; denser ones are drawn as one band
_MOST_TIMELINES = 16
_BEYOND = 6  # share of the failing mission that is shown of the other after its end
_LEAST_NAME = 7.0  # width of a letter


@dataclass(frozen=True, slots=True)
class Pair:
    """A mission that failed and one that passed, both with their events."""

    failing: MissionResult
    passing: MissionResult


@dataclass(frozen=True, slots=True)
class _Stretch:
    """A predicate that held on a timeline."""

    start: int
    end: int
    predicate: str


def pair_plot(pair: Pair, story: Story) -> str:
    """Both missions on one scale, the failing one first, with the steps of the chain as numbered marks.

    Of a passing mission that goes on for long only what is beside the failing one, and a little more.
    """
    outcomes = [one.outcome for one in (pair.failing, pair.passing)]
    assert outcomes[0] is not None
    assert outcomes[1] is not None
    failed_at = outcomes[0].last_tick
    last = max(failed_at, min(outcomes[1].last_tick, failed_at + max(1, failed_at // _BEYOND)))
    names = _timelines(outcomes[0], outcomes[1])
    marks = [(at, step.tick) for at, step in enumerate(story.steps, 1) if step.tick is not None]
    touched = {step.subject.timeline for step in story.steps if isinstance(step.subject, Event)}
    abort = given_up(outcomes[0])
    touched |= set(abort.timelines) if abort is not None else set()
    faulty = {at for at, step in enumerate(story.steps, 1) if step.kind in (StepKind.FAULT, StepKind.ABORT)}
    failing = _mission_plot(outcomes[0], names, last, marks, touched, faulty)
    passing = _mission_plot(outcomes[1], names, last, [], set(), set())
    return (
        '<div class="pair">'
        f"<figure><figcaption>mission {pair.failing.number} fails</figcaption>{failing}</figure>"
        f"<figure><figcaption>mission {pair.passing.number} passes</figcaption>{passing}</figure></div>"
    )


def _timelines(one: Outcome, other: Outcome) -> list[str]:
    """The timelines on which something changed, those with little first: what changes each tick tells least."""
    counts: dict[str, int] = {}
    for outcome in (one, other):
        for _, _, timeline, _ in heads_of(outcome.events):
            counts[timeline] = counts.get(timeline, 0) + 1
    order = list(counts)
    return sorted(counts, key=lambda name: (counts[name] > _MOST_BARS * 2, order.index(name)))[:_MOST_TIMELINES]


def _mission_plot(
    outcome: Outcome,
    names: Sequence[str],
    last: int,
    marks: Sequence[tuple[int, int]],
    touched: set[str],
    faulty: set[int],
) -> str:
    height = _TOP + _ROW * len(names) + _FOOT
    scale = (_WIDTH - _LABEL - 14.0) / max(last, 1)
    caption = "what held on each timeline"
    parts = [f'<svg viewBox="0 0 {_WIDTH:.0f} {height:.0f}" role="img" aria-label="{caption}">']
    held = {name: _until(last, own) for name, own in _stretches(outcome, names).items()}
    colours: dict[str, int] = {}
    for row, name in enumerate(names):
        y = _TOP + row * _ROW
        weight = ' class="name"' if name in touched else ' class="tick"'
        parts.append(
            f'<text{weight} x="{_LABEL - 6:.0f}" y="{y + 13:.1f}" text-anchor="end">{escape(name[:12])}</text>'
        )
        if name in touched:
            width = _WIDTH - _LABEL - 8
            parts.append(f'<rect class="beyond" x="{_LABEL:.0f}" y="{y:.1f}" width="{width:.0f}" height="{_ROW:.0f}"/>')
        parts += _bars(held[name], y, scale, colours)
    foot = _TOP + _ROW * len(names)
    for tick in ticks(0.0, float(last), max(last, 1) / 4.0):
        x = _LABEL + tick * scale
        anchor = "end" if x > _WIDTH - 24 else "middle"
        parts.append(f'<line class="axis" x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP:.0f}" y2="{foot + 4:.1f}"/>')
        parts.append(f'<text class="tick" x="{x:.1f}" y="{foot + 17:.1f}" text-anchor="{anchor}">{number(tick)}</text>')
    if outcome.last_tick <= last and (outcome.last_tick < outcome.final_tick or outcome.abort is not None):
        x = _LABEL + outcome.last_tick * scale
        parts.append(f'<line class="abort" x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP - 4:.0f}" y2="{foot:.1f}"/>')
    shown: dict[int, list[int]] = {}
    for at, tick in marks:
        shown.setdefault(tick, []).append(at)
    reached = -1e9
    for tick, steps in sorted(shown.items()):
        x = _LABEL + tick * scale
        kind = "edge fault" if faulty & set(steps) else "edge"
        parts.append(f'<line class="{kind}" x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP - 4:.0f}" y2="{foot:.1f}"/>')
        text = str(steps[0]) if len(steps) == 1 else f"{steps[0]}–{steps[-1]}"
        if x - reached > 9.0 * len(text):
            anchor = "end" if x > _WIDTH - 30 else "middle"
            title = f"<title>steps {', '.join(map(str, steps))} of the chain, tick {tick}</title>"
            parts.append(f'<text class="label" x="{x:.1f}" y="13" text-anchor="{anchor}">{text}{title}</text>')
            reached = x
    return "\n".join([*parts, "</svg>"])


def _stretches(outcome: Outcome, names: Sequence[str]) -> dict[str, list[_Stretch]]:
    """What held on each timeline, from one observation to the next."""
    found: dict[str, list[_Stretch]] = {name: [] for name in names}
    for _, tick, timeline, predicate in heads_of(outcome.events):
        own = found.get(timeline)
        if own is None:
            continue
        if own and own[-1].end > tick:
            own[-1] = _Stretch(own[-1].start, tick, own[-1].predicate)
        if own and own[-1].predicate == predicate and own[-1].end == tick and len(own) > _MOST_BARS:
            own[-1] = _Stretch(own[-1].start, outcome.last_tick, predicate)
        else:
            own.append(_Stretch(tick, outcome.last_tick, predicate))
    return found


def _until(last: int, held: Sequence[_Stretch]) -> list[_Stretch]:
    """What held up to tick `last`."""
    return [_Stretch(one.start, min(one.end, last), one.predicate) for one in held if one.start <= last]


def _bars(held: Sequence[_Stretch], y: float, scale: float, colours: dict[str, int]) -> list[str]:
    if len(held) > _MOST_BARS:
        x, width = _LABEL + held[0].start * scale, (held[-1].end - held[0].start) * scale
        title = f"<title>{len(held)} changes</title>"
        return [f'<rect class="bar dense" x="{x:.1f}" y="{y + 3:.1f}" width="{width:.1f}" height="13">{title}</rect>']
    parts = []
    for one in held:
        colour = colours.setdefault(one.predicate, len(colours) % 6)
        x, width = _LABEL + one.start * scale, max((one.end - one.start) * scale - 0.6, 0.8)
        title = f"<title>{escape(one.predicate)}, {one.start} to {one.end}</title>"
        parts.append(
            f'<rect class="bar b{colour}" x="{x:.1f}" y="{y + 3:.1f}" width="{width:.1f}" height="13">{title}</rect>'
        )
        letters = int((width - 4.0) / _LEAST_NAME)
        if letters >= 3:
            name = one.predicate if len(one.predicate) <= letters else one.predicate[: letters - 1] + "…"
            parts.append(f'<text class="bar" x="{x + 3:.1f}" y="{y + 13:.1f}">{escape(name)}</text>')
    return parts
