"""Conditions of rules in; out: what one branch sets and the other does not, as a line may be missing there."""

import re
from collections.abc import Iterator

from checker.counterfactual.dependence import Dependence, LooseEnd
from checker.counterfactual.instructions import flat
from compiler.program import Child, Guard, Instruction, RuleCode
from nddl_lang.text.source import Span

_SAYS = re.compile(r"\s*([A-Za-z_][\w.]*)\s*([<>=!]=?)")
_MOMENT = re.compile(r"(?:\w+\.)?(?:start|end)")
_EMPTY_ELSE = re.compile(r"\}\s*else\s*\{\s*\}\s*$")


def uneven_branches(graph: Dependence) -> list[LooseEnd]:
    """What lines of one branch alone begin with, each with the site of its condition."""
    found: dict[LooseEnd, None] = {}
    for program in graph.programs:
        for rule in program.rules:
            for guard in (step for step in flat(rule.body) if isinstance(step, Guard)):
                sites = [one for one in graph.at_span(guard.span) if not graph.sites[one].is_rule]
                for name in sorted(_uneven(guard, rule, graph)) if sites else ():
                    found[LooseEnd(sites[0], name, is_local=True, is_uneven=True)] = None
    return list(found)


def _uneven(guard: Guard, rule: RuleCode, graph: Dependence) -> Iterator[str]:
    branches = [guard.then, guard.otherwise]
    if not guard.otherwise and not _EMPTY_ELSE.search(guard.span.text):
        return  # nothing is said of the other case
    elsewhere = _names(_outside(rule, guard), graph)
    for one, other in (branches, branches[::-1]):
        own = {step.label for step in flat(one) if isinstance(step, Child)}
        spans = [step.span for step in flat(one)]
        for name in _names(spans, graph, sets=True) - _names([step.span for step in flat(other)], graph):
            if name not in elsewhere and name.partition(".")[0] not in own:
                yield name


def _outside(rule: RuleCode, guard: Guard) -> list[Span]:
    inside: set[Instruction] = {*flat(guard.then), *flat(guard.otherwise)}
    return [step.span for step in flat(rule.body) if step not in inside and not isinstance(step, Guard)]


def _names(spans: list[Span], graph: Dependence, *, sets: bool = False) -> set[str]:
    """What lines set or bound: the names that they begin with.

    With `sets` without what is no more than a deadline, or a time to wait for: one branch alone may well have one.
    """
    texts = {graph.sites[one].text for span in spans for one in graph.at_span(span)}
    said = [found.groups() for text in texts if (found := _SAYS.match(text))]
    return {name for name, sign in said if not (sets and sign != "==" and _MOMENT.fullmatch(name))}
