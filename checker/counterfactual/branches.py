"""Conditions of rules in; out: what one branch sets and the other does not, as a line may be missing there."""

import re
from collections.abc import Iterator

from checker.counterfactual.dependence import Dependence, LooseEnd
from compiler.instructions import all_instructions
from compiler.program import Child, Guard, Instruction, NewVariable, RuleCode
from nddl_lang.text.source import Span

_SAYS = re.compile(r"\s*([A-Za-z_][\w.]*)\s*([<>=!]=?)\s*([A-Za-z_][\w.]*\s*;)?")
_MOMENT = re.compile(r"(?:\w+\.)?(?:start|end)")
_DECLARED = re.compile(r"\w+\s+\w+\s*;")
_EMPTY_ELSE = re.compile(r"\}\s*else\s*\{\s*\}\s*$")


def uneven_branches(graph: Dependence) -> list[LooseEnd]:
    """What lines of one branch alone begin with, each with the site of its condition."""
    found: dict[LooseEnd, None] = {}
    for program in graph.programs:
        for rule in program.rules:
            for guard in (step for step in all_instructions(rule.body) if isinstance(step, Guard)):
                sites = [one for one in graph.at_span(guard.span) if not graph.sites[one].is_rule]
                for name in sorted(set(_uneven(guard, rule, graph))) if sites else ():
                    found[LooseEnd(sites[0], name, is_local=True, is_uneven=True)] = None
    return list(found)


def _uneven(guard: Guard, rule: RuleCode, graph: Dependence) -> Iterator[str]:
    branches = [guard.then, guard.otherwise]
    outside = _outside(rule, guard)
    elsewhere = {name for name, _, _ in _said(outside, graph)}
    if not guard.otherwise and not _EMPTY_ELSE.search(guard.span.text):
        # Nothing is said of the other case, in which a variable of the rule stays open that other lines read.
        for name, sign, _ in _said([step.span for step in all_instructions(guard.then)], graph):
            if sign == "==" and name in _open(rule) - elsewhere and _is_read(name, outside, graph):
                yield name
        return
    for one, other in (branches, branches[::-1]):
        steps = list(all_instructions(one))  # what a branch declares is its own
        own = {step.label for step in steps if isinstance(step, Child)}
        own |= {step.name for step in steps if isinstance(step, NewVariable)}
        chosen = {step.name for step in all_instructions(rule.body) if isinstance(step, NewVariable)}
        there = _said([step.span for step in all_instructions(other)], graph)
        known = elsewhere | {name for name, _, same in there for name in (name, same)}
        for name, sign, same in _said([step.span for step in all_instructions(one)], graph):
            is_limit = sign != "==" and _MOMENT.fullmatch(name) is not None  # a deadline, which one branch may have
            is_limit |= sign != "==" and "." in name and name.partition(".")[0] in chosen  # what an object must be like
            if not is_limit and not known & {name, same} and name.partition(".")[0] not in own:
                yield name


def _open(rule: RuleCode) -> set[str]:
    """The variables that a rule declares without a value."""
    steps = [step for step in all_instructions(rule.body) if isinstance(step, NewVariable) and step.copy_of is None]
    return {step.name for step in steps if step.name is not None}


def _is_read(name: str, spans: list[Span], graph: Dependence) -> bool:
    """Whether a line speaks of a variable that does not declare it."""
    texts = {graph.sites[one].text for span in spans for one in graph.at_span(span) if not graph.sites[one].is_rule}
    return any(re.search(rf"(?<![\w.]){name}\b", text) and not _DECLARED.fullmatch(text) for text in texts)


def _outside(rule: RuleCode, guard: Guard) -> list[Span]:
    inside: set[Instruction] = {*all_instructions(guard.then), *all_instructions(guard.otherwise)}
    return [step.span for step in all_instructions(rule.body) if step not in inside and not isinstance(step, Guard)]


def _said(spans: list[Span], graph: Dependence) -> set[tuple[str, str, str]]:
    """What lines set or bound: the name that each begins with, its sign, and after `==` the name that is the same.

    Where one branch says `bake.end == end`, and the other `retract.end == end`, both say what `end` is.
    """
    texts = {graph.sites[one].text for span in spans for one in graph.at_span(span)}
    found = [match.groups("") for text in texts if (match := _SAYS.match(text))]
    return {(name, sign, same.rstrip("; ") if sign == "==" and same else name) for name, sign, same in found}
