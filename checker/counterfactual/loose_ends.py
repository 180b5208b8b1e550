"""Candidates in, loose ends out, the likeliest first: where a line of a rule may be missing, though nothing was flown.

A variable that too few lines speak of is one, and so is a constant that somebody declared and nothing reads: it is
missed in the rule that its name speaks of. A constant that lines read and nothing sets may be any number, and so may
a local variable.
"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from checker.counterfactual.branches import uneven_branches
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.dependence import Dependence, LooseEnd
from checker.counterfactual.tried import Loose
from checker.counterfactual.usage import Usage
from checker.mutation.edits import EditSite

_NOT_LOCAL = 2.0  # how much farther off a parameter counts than a local variable, and a time
_SET_ELSEWHERE = 3.0  # how much farther off a variable is that other rules set
_UNEVEN = -2.5  # and what only one branch of a condition sets
_UNREAD = -4.0  # and a constant that bears the name of a rule: it seldom is declared for nothing
_UNSET = -3.0  # and a constant or local variable that nothing sets
_UNPLACED = 3.0  # of one whose rule its name does not tell

_BARE = re.compile(r"\w+\s+\w+\s*;")  # a declaration without a value


def loose_ends(graph: Dependence, candidates: Sequence[Candidate], usage: Usage) -> tuple[Loose, ...]:
    """The loose ends near what ended the mission."""
    near = {candidate.site: candidate for candidate in candidates}
    found = [
        (near[site].far + _looseness(one), Loose(near[site], one.variable, is_uneven=one.is_uneven))
        for one in (*uneven_branches(graph), *graph.loose_ends())
        if (site := graph.sites[one.site]) in near
    ]
    found += _unread(graph.sites, near, usage)
    found += _unset(graph.sites, near, usage)
    return tuple(replace(loose, doubt=doubt) for doubt, loose in sorted(found, key=lambda one: one[0]))


def _looseness(end: LooseEnd) -> float:
    """How much farther off a loose end counts that others may set: a local variable is its own rule's alone."""
    if end.is_uneven:
        return _UNEVEN
    return _SET_ELSEWHERE * end.is_set_elsewhere + _NOT_LOCAL * (not end.is_local)


def _unread(sites: Sequence[EditSite], near: dict[EditSite, Candidate], usage: Usage) -> Iterator[tuple[float, Loose]]:
    """The numbers that nothing reads, each with the rule that its name is about, else with its own line."""
    for constant in sites:
        if not (constant.is_number and usage.is_idle(constant.named)):
            continue
        heads = [one for one in near.values() if one.site.is_rule]
        heads = [one for one in heads if one.site.file == constant.file] or heads
        heads += [
            Candidate(one, _UNPLACED, Suspicion.DEPENDENCE)
            for one in sites
            if one.is_rule and one.file == constant.file and one not in near
            if usage.affinity.shared(constant.named, one, sites)
        ]
        named = {one: usage.affinity.shared(constant.named, one.site, sites) for one in heads}
        most = max(named.values(), default=0)
        heads = sorted((one for one in heads if named[one] == most), key=lambda one: one.far)
        if heads:
            nearness = _UNREAD * (most > 0)
            yield heads[0].far + nearness, Loose(heads[0], constant.named, is_unread=True)
        else:
            own = Candidate(constant, 0.0, Suspicion.DEPENDENCE)
            yield _UNPLACED, Loose(own, constant.named, is_unread=True)


def _unset(sites: Sequence[EditSite], near: dict[EditSite, Candidate], usage: Usage) -> Iterator[tuple[float, Loose]]:
    """The numbers and local variables that lines read and nothing sets, each where it is declared."""
    lines = Counter(one.named for one in sites if one.is_number)
    rules = {(one.file, one.scope) for one in sites if one.is_rule}
    for site in sites:
        is_local = (site.file, site.scope) in rules  # what a predicate declares is a parameter: who asks for it sets it
        if is_local and (name := usage.mentions.unset_local(site)):
            candidate = near.get(site) or Candidate(site, _UNPLACED, Suspicion.DEPENDENCE)
            yield candidate.far + _UNSET, Loose(candidate, name, is_unset=True)
        is_bare = _BARE.fullmatch(site.text) is not None
        if site in near and site.is_number and is_bare and lines[site.named] == 1 and not usage.is_idle(site.named):
            yield near[site].far + _UNSET, Loose(near[site], site.named, is_unset=True)
