"""Programs and sites in, a dependence graph out: which lines bear on which, within a rule and across reactors.

Two lines hang together by a variable: a local one, a global one, or the parameters and times of a predicate. The last
are the same in the reactor that publishes a token, in those that see it, and in those that ask for it: so an observed
argument leads to the line that sets it, and a request to its sender.
"""

import heapq
import re
from collections import defaultdict
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from checker.counterfactual.affinity import WORD
from checker.counterfactual.instructions import is_shared, pairs_in
from checker.counterfactual.links import DURATION_NAME, TIMES, Key, Links
from checker.mutation.edits import EditSite
from checker.named_objects import RESOURCES
from compiler.program import Program
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span

_MOST_BESIDE = 12  # lines that speak of a variable which still says that they hang together
_PASSING = re.compile(r"\s*([A-Za-z_][\w.]*)\s*==\s*([A-Za-z_][\w.]*)\s*;")
_CROWD = 0.05  # what each further line that bears on a variable adds to the way through it


@dataclass(frozen=True, slots=True)
class LooseEnd:
    """A variable of a rule that at most one line speaks of, or the times of its token: one more line may be missing.

    `site` is the number of the line that declares it, of the child whose parameter it is, or of the head of the rule.
    `is_local`: it is declared in the rule itself, so that nothing else can say what it is. `is_uneven`: the other
    branch of a condition sets it.
    """

    site: int
    variable: str
    is_set_elsewhere: bool = False  # by other rules of the same model
    is_local: bool = False
    is_uneven: bool = False


class Dependence:
    """The sites of some programs by number, and the variables that join them."""

    def __init__(self, programs: Sequence[Program], sites: Sequence[EditSite]) -> None:
        self.sites = sites
        self._at: dict[tuple[str, int], list[int]] = defaultdict(list)
        for number, site in enumerate(sites):
            for line in range(site.first, site.last + 1):
                self._at[site.file, line].append(number)
        self._keys: dict[int, set[Key]] = defaultdict(set)
        self._users: dict[Key, set[int]] = defaultdict(set)
        self._paths: dict[str, str] = {}
        self._named = {site.named for site in sites if site.named}
        self.programs = programs
        for number, program in enumerate(programs):
            for span, keys in Links(number, program).all():
                for one in self._at.get(self._line(span), ()):
                    self._keys[one].update(keys)
                    for key in keys:
                        self._users[key].add(one)

    def at(self, file: str, line: int) -> Sequence[int]:
        """The sites at a line."""
        return self._at.get((file, line), ())

    def at_span(self, span: Span) -> Sequence[int]:
        """The sites in the line where something is written."""
        return self.at(*self._line(span))

    def within(self, span: Span) -> Iterator[int]:
        """The sites in the lines of a rule or a branch."""
        file, first = self._line(span)
        last = span.source.locate(max(span.begin, span.finish - 1))[0]
        for line in range(first, last + 1):
            yield from self._at.get((file, line), ())

    def of_predicate(self, predicate: str, variable: str = "") -> Iterable[int]:
        """The sites that bear on a token of a predicate, whatever its class; or on one parameter of it."""
        for key in self._users:
            if key[0] == "token" and str(key[1]).rpartition(".")[2] == predicate and variable in ("", key[2]):
                yield from self._users[key]

    def of_resource(self, predicate: str) -> Iterator[int]:
        """The sites that bear on an event of a resource, and where that is made; none for other predicates."""
        native = any(
            one.name == predicate.rpartition(".")[0] and one.native in RESOURCES
            for program in self.programs
            for one in program.classes
        )
        for key in self._users if native else ():
            if key[:2] == ("token", predicate):
                yield from self._users[key]

    def of_level(self, resource: str) -> Iterator[int]:
        """The sites that make a resource, or bear on what changes its level."""
        for number, site in enumerate(self.sites):
            if site.named == resource.rpartition(".")[2]:
                yield number
                for key in sorted((one for one in self._keys[number] if one[0] == "token"), key=str):
                    yield from self._users[key]

    def supplying(self, lacking: Collection[tuple[str, str]]) -> frozenset[str]:
        """The predicates, without their classes, whose rules have an event of a resource; `lacking` names both."""
        sites = [self.sites[number] for name, _ in lacking for number in self.of_level(name)]
        events = {event for _, event in lacking}
        return frozenset(
            one.rule.rpartition(".")[2] for one in sites if one.rule and events & set(WORD.findall(one.text))
        )

    def setting(self, predicate: str, variable: str) -> Iterator[int]:
        """The sites in the rule of a predicate that bear on a parameter of its token, or on how long that lasts."""
        key = ("token", predicate, TIMES if variable in (DURATION_NAME, "end") else variable)
        yield from sorted(one for one in self._users.get(key, ()) if self.sites[one].rule == predicate)

    def lasting(self, predicate: str) -> Iterator[int]:
        """The sites in the rules of a predicate, whatever its class, that say with `==` how long its tokens last."""
        for key in [key for key in self._users if key[0] == "token" and key[2] == TIMES]:
            if str(key[1]).rpartition(".")[2] == predicate:
                yield from (one for one in self.setting(str(key[1]), DURATION_NAME) if self._is_duration(one))

    def children(self, predicate: str) -> set[str]:
        """The predicates, without their classes, that a predicate's rule relates in time, and the rules of these."""
        found, waiting = set[str](), [predicate]
        while waiting:
            rule = waiting.pop()
            sites = [number for number, site in enumerate(self.sites) if site.rule == rule]
            new = self.tokens_at(sites) - found - {predicate}
            found |= new
            waiting += sorted(new)
        return {name.rpartition(".")[2] for name in found}

    def lengthening(self, predicate: str) -> Iterator[tuple[int, int]]:
        """The sites of `lasting`, those behind them by local variables, and by which others ask for what these read.

        Each with how many steps away it is.
        """
        lasting = list(self.lasting(predicate))
        for rule in sorted({self.sites[one].rule for one in lasting}):
            lines = dict(self._by_locals([one for one in lasting if self.sites[one].rule == rule], rule))
            yield from lines.items()
            for site, steps in lines.items():
                for key in sorted((one for one in self._keys[site] if one[:2] == ("token", rule)), key=str):
                    if key[2] != TIMES:
                        yield from ((one, steps + 1) for one in self.asking(rule, str(key[2])))

    def _is_duration(self, site: int) -> bool:
        return re.match(rf"\s*{DURATION_NAME}\s*==", self.sites[site].text) is not None

    def behind(self, predicate: str, variable: str) -> Iterator[tuple[int, int]]:
        """The sites of `setting`, and those behind them by local variables of the rule, each with how many steps."""
        yield from self._by_locals(self.setting(predicate, variable), predicate)

    def choosing(self, predicate: str) -> Iterator[tuple[int, int]]:
        """The conditions under which other rules ask for a predicate, and what is behind them, as `behind` has it."""
        asking = [one for one in self._users.get(("token", predicate, TIMES), ()) if self.sites[one].rule != predicate]
        rules: dict[str, set[int]] = defaultdict(set)
        for condition in (one for site in asking for one in self.conditions(site)):
            rules[self.sites[condition].rule].add(condition)
        for rule, conditions in sorted(rules.items()):
            yield from self._by_locals(sorted(conditions), rule)

    def _by_locals(self, sites: Iterable[int], rule: str) -> Iterator[tuple[int, int]]:
        """Some sites of a rule, and those behind them by its local variables, each with how many steps."""
        found = dict.fromkeys(sites, 0)
        waiting = list(found)
        while waiting:
            site = waiting.pop(0)
            shared = {key for key in self._keys[site] if key[0] == "rule" and "local" in key}
            for other in sorted({one for key in shared for one in self._users[key]} - found.keys()):
                if self.sites[other].rule == rule:
                    found[other] = found[site] + 1
                    waiting.append(other)
        yield from found.items()

    def asking(self, predicate: str, variable: str = TIMES) -> Iterator[int]:
        """The sites by which other rules bound a parameter, or the times, of the tokens of a predicate."""
        name = TIMES if variable in (DURATION_NAME, "start", "end") else variable
        for key in [key for key in self._users if key[0] == "token" and key[2] == name]:
            if predicate in (key[1], str(key[1]).rpartition(".")[2]):
                yield from sorted(one for one in self._users[key] if self.sites[one].rule not in ("", key[1]))

    def tokens_at(self, sites: Iterable[int]) -> set[str]:
        """The predicates of the tokens whose times lines speak of."""
        return {str(key[1]) for one in sites for key in self._keys[one] if key[0] == "token" and key[2] == TIMES}

    def expected_with(self, sites: Iterable[int], held: Container[str]) -> set[str]:
        """The predicates that never held, of those that lines speak of, and of what is to be related to these in time.

        Names come without their classes. What should have begun waits for what it is related to.
        """
        waiting = self.tokens_at(sites)
        related: dict[str, set[str]] = defaultdict(set)
        shared: set[str] = set()
        for program in self.programs:
            shared |= {each.name for each in program.predicates if is_shared(each.class_name, program)}
            for rule in program.rules:
                for one, other in pairs_in(rule):
                    related[one].add(other)
                    related[other].add(one)
        found: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in shared and name not in found and name.rpartition(".")[2] not in held:
                found.add(name)
                waiting |= related[name]
        return {name.rpartition(".")[2] for name in found}

    def proven(self, over: Container[str]) -> set[int]:
        """The numbers that are read by rules of predicates alone whose tokens came to an `over`, whatever their branch.

        What is read under a condition may have been read by none of these.
        """
        found = set()
        for key, users in self._users.items():
            readers = [one for one in users if not self.sites[one].is_number]
            if key[0] == "global" and readers and all(self._has_held(one, over) for one in readers):
                found |= users.difference(readers)
        return found

    def _has_held(self, site: int, over: Container[str]) -> bool:
        is_guarded = any("guard" in key for key in self._keys[site])
        return not is_guarded and self.sites[site].rule.rpartition(".")[2] in over

    def beside(self, site: EditSite) -> set[EditSite]:
        """The other lines that speak of a variable of a line, where few do.

        Also the numbers that these read, and the conditions that they stand under.
        """
        numbers = [one for one in self.at(site.file, site.first) if self.sites[one] is site]
        groups = [self._users[key] for one in numbers for key in self._keys[one]]
        found = {one for group in groups if len(group) <= _MOST_BESIDE for one in group}
        read = {key for one in found for key in self._keys[one] if key[0] == "global" or "guard" in key}
        found |= {one for key in read for one in self._users[key] if self._is_behind(one, key)}
        return {self.sites[one] for one in found} - {site}

    def conditions(self, site: int) -> Iterator[int]:
        """The conditions that a line stands under."""
        for key in sorted((one for one in self._keys[site] if "guard" in one), key=str):
            yield from sorted(one for one in self._users[key] if one != site and self._is_behind(one, key))

    def _is_behind(self, site: int, key: Key) -> bool:
        """Whether a site is the number that lines read by a key, or the condition that they stand under."""
        return self.sites[site].is_number if key[0] == "global" else not self.sites[site].text.endswith(";")

    def distances(self, roots: Mapping[int, float], through: float = 1.0) -> dict[int, float]:
        """How far each site is from the nearest root, whose own distance is given: shortest ways through variables.

        A way is so long `through` a line that passes a value on, and nothing more.
        """
        found: dict[int, float] = {}
        passed: set[Key] = set()
        queue = [(far, site) for site, far in roots.items()]
        heapq.heapify(queue)
        while queue:
            far, site = heapq.heappop(queue)
            if site in found:
                continue
            found[site] = far
            for key in self._keys[site] - passed:
                passed.add(key)
                step = (through if self._is_passing(site) else 1.0) + _CROWD * len(self._users[key])
                for other in self._users[key]:
                    if other not in found:
                        heapq.heappush(queue, (far + step, other))
        return found

    def _is_passing(self, site: int) -> bool:
        """Whether a line says no more than that two variables are equal."""
        sides = _PASSING.fullmatch(self.sites[site].text)
        return sides is not None and all(side.partition(".")[0] not in self._named for side in sides.groups())

    def loose_ends(self) -> list[LooseEnd]:
        """The loose ends of all rules: locals, parameters of the own token and of children, and times.

        Of an observed token the reactor that owns it says how long it lasts.
        """
        found: dict[LooseEnd, None] = {}
        timed = {
            rule.predicate
            for number, program in enumerate(self.programs)
            for index, rule in enumerate(program.rules)
            if all(one != DURATION_NAME for _, one, _, _ in Links(number, program).loose(rule, ("rule", number, index)))
        }
        for number, program in enumerate(self.programs):
            for index, rule in enumerate(program.rules):
                file, line = self._line(rule.span)
                heads = [one for one in self.at(file, line) if self.sites[one].is_rule]
                if not heads:
                    continue
                links = Links(number, program)
                for span, variable, key, is_local in links.loose(rule, ("rule", number, index)):
                    if variable == DURATION_NAME and rule.predicate in timed:
                        continue
                    declared = [one for one in self.at(*self._line(span)) if not self.sites[one].is_rule]
                    site = declared[0] if span is not rule.span and declared else heads[0]
                    found[LooseEnd(site, variable, bool(self._users.get(key)), is_local)] = None
        return list(found)

    def _line(self, span: Span) -> tuple[str, int]:
        name = span.source.name
        if name not in self._paths:
            self._paths[name] = str(real_path(Path(name)))
        return self._paths[name], span.line
