"""A flown mission in, its structure out: tokens, order, branches and relations, as demands on free times and values."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf

import z3

from checker.judge.goals import has_arguments
from checker.judge.values import ends_of
from checker.proofs.claims import Number
from checker.proofs.demands import Demand, RunReader, equal, gap
from checker.proofs.operands import ProgramNames, Symbols, names_of, token_number
from compiler.program import END, FIRST_PARAMETER, START, NewGlobal, Program
from nddl_lang.text.source import Span
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, ReactorConfiguration
from runtime.executive.record import NOBODY, MissionRecord, ReactorRecord, TokenRecord, Value

_MOST_MERGES = 16


@dataclass(frozen=True, eq=False, slots=True)
class Structure:
    """What is fixed of a flight, and what is free.

    `values` are the values of the flight by variable; `times` are those of tokens, `earliest` the ticks
    before which the mission file asks for nothing; `untold` counts what has no translation.
    """

    demands: list[Demand] = field(default_factory=list)
    values: dict[str, Value] = field(default_factory=dict)
    variables: dict[str, Number] = field(default_factory=dict)
    times: list[tuple[str, str, str]] = field(default_factory=list)  # start, end and duration of each token
    asked: list[tuple[str, str, str]] = field(default_factory=list)  # reactor, variables and name of what it asked for
    observed: set[str] = field(default_factory=set)  # variables of what others did, and nobody here asked for
    lasting: set[str] = field(default_factory=set)  # of what its owner has no rule for: until something else is asked
    arguments: dict[str, tuple[Value, ...]] = field(default_factory=dict)  # of that, by its variables
    earliest: dict[str, int] = field(default_factory=dict)  # starts that the mission file asks for
    draws: dict[str, dict[str, None]] = field(default_factory=dict)  # variables of each sampled parameter
    untold: dict[str, int] = field(default_factory=dict)
    silent: dict[str, Span | None] = field(default_factory=dict)  # of these constraints, those z3 has no word for
    lost: dict[str, Span | None] = field(default_factory=dict)  # those about what a repair cut off
    symbols: Symbols = field(default_factory=Symbols)


def structure_of(agent: AgentConfiguration, programs: Sequence[Program], record: MissionRecord) -> Structure:
    """The structure of a flown mission."""
    found = Structure()
    symbols = found.symbols
    redrawn = frozenset(each.name for each in agent.parameters if each.mode == "intra")
    readers = []
    by_name = {each.reactor: each for each in record.reactors}
    for configuration, program in zip(agent.reactors, programs, strict=True):
        written = by_name.get(configuration.name)
        if written is not None:
            readers.append(_ReactorReader(configuration, program, written, symbols, found, redrawn, agent.final_tick))
    for reader in readers:
        reader.read()
    for reader in readers:
        reader.link(readers)
        reader.ask(agent.goals)
    return found


class _ReactorReader:
    """One reactor's part of a structure."""

    def __init__(
        self,
        configuration: ReactorConfiguration,
        program: Program,
        record: ReactorRecord,
        symbols: Symbols,
        found: Structure,
        redrawn: frozenset[str],
        final_tick: int,
    ) -> None:
        self.configuration = configuration
        self.names: ProgramNames = names_of(program)
        self.record = record
        self.symbols = symbols
        self.found = found
        self.redrawn = redrawn
        self.final_tick = final_tick
        self.tokens: dict[int, TokenRecord] = {each.key: each for each in record.tokens}
        self.flown = {
            each.key: each
            for each in record.tokens
            if each.state == "active"
            and each.fate != "cut"
            and isinstance(each.start, int)
            and each.start < record.last_tick
        }

    def read(self) -> None:
        """Tokens, rules, timelines and the script."""
        wanted = {each.merged_into for each in self.tokens.values()}
        for key, token in self.flown.items():
            if token.origin == "observation" and str(token.object) in self.configuration.external and key not in wanted:
                self.found.observed.add(f"{self.configuration.name}:{key}")
        for token in self.flown.values():
            self._token(token)
        self._worlds()
        standing = {key: self._standing(key) for key in self.tokens}
        predicates = {key: self.flown[to].predicate for key, to in standing.items() if to in self.flown}
        objects = {each.name: each for each in self.record.objects}
        reader = RunReader(
            self.names,
            self.symbols,
            self.configuration.name,
            predicates,
            objects,
            self.found.values,
            self.redrawn,
            self.found.draws,
        )
        program = self.names.program
        self._add(reader.bare(program.script, NOBODY))
        for token in self.flown.values():
            reader.token_name = f"{token.predicate}#{token.key}"
            self._add(reader.bare(self.names.predicates[token.predicate].body, token.key))
            for run in token.runs:
                self._add(reader.follow(program.rules[run.rule].body, run, token.key))
        for name, span in reader.silent.items():
            self.found.silent.setdefault(name, span)
        for name, span in reader.lost.items():
            self.found.lost.setdefault(name, span)
        for name, count in reader.untold.items():
            self.found.untold[name] = self.found.untold.get(name, 0) + count
        self._alias(standing)
        self._order()

    def _add(self, demands: Iterator[Demand]) -> None:
        """Add the demands of a body."""
        self.found.demands.extend(demands)

    def _standing(self, key: int) -> int:
        for _ in range(_MOST_MERGES):
            token = self.tokens.get(key)
            if token is None or token.merged_into == NOBODY:
                break
            key = token.merged_into
        return key

    def number(self, key: int, variable: int) -> Number:
        """A variable of a token."""
        predicate = self.tokens[key].predicate
        found = token_number(f"{self.configuration.name}:{key}", predicate, variable, self.names, self.symbols)
        assert found is not None
        return found

    def _token(self, token: TokenRecord) -> None:
        start, end = self.number(token.key, START), self.number(token.key, END)
        length = self.symbols.variable(f"{self.configuration.name}:{token.key}.duration", "int")
        self._value(start, token.start)
        self._value(end, token.end)
        self._value(length, token.duration)
        self._value(self.symbols.variable(f"{self.configuration.name}:{token.key}.object", "object"), token.object)
        name = f"{token.predicate}#{token.key}"
        self.found.demands.append(Demand("temporalDistance", (start, length, end), end - start == length, None, name))
        shortest = 0 if self.names.predicates[token.predicate].is_event else 1
        self.found.demands.append(gap(start, end, shortest, inf, None, name, self.configuration.name))
        if isinstance(token.end, int):  # what goes on when the mission ends does so in all of the structure
            goes_on = token.end > self.final_tick
            least, most = (self.final_tick, inf) if goes_on else (-inf, self.final_tick)
            self.found.demands.append(gap(z3.IntVal(0), end, least, most, None, name, self.configuration.name))
        code = self.names.predicates[token.predicate]
        for k, parameter in enumerate(code.parameters):
            target = self.number(token.key, FIRST_PARAMETER + k)
            if k < len(token.arguments):
                self._value(target, token.arguments[k])
            domains = [each for each in (parameter.type.domain, parameter.domain) if each is not None]
            if domains:
                claim = z3.And(*[self.symbols.within(target, each) for each in domains])
                self.found.demands.append(Demand("", (target,), claim, parameter.span, name, self.configuration.name))
        if (
            token.origin != "observation"
            and str(token.object) in self.configuration.external
            and isinstance(token.end, int)
        ):
            variables = f"{self.configuration.name}:{token.key}"
            self.found.asked.append((self.configuration.name, variables, name))
            self.found.arguments[variables] = token.arguments
        times = (end, length) if isinstance(token.end, int) else (None, None)
        name_of_end, name_of_length = (self.symbols.name_of(each) for each in times)
        self.found.times.append((self.symbols.name_of(start), name_of_end, name_of_length))

    def _value(self, variable: Number, value: Value) -> None:
        self.found.variables[self.symbols.name_of(variable)] = variable
        if not isinstance(value, tuple):
            self.found.values[self.symbols.name_of(variable)] = value

    def _worlds(self) -> None:
        """Values of global variables that no line of the script sets by itself."""
        names = [name for name, _ in self.names.program.globals]
        for (name, code), value in zip(self.names.program.globals, self.record.globals, strict=True):
            if name != "AGENT_CLOCK":
                self._value(self.symbols.variable(f"{self.configuration.name}:{name}", code.kind), value)
        for made in self.names.program.script:
            if isinstance(made, NewGlobal) and made.domain is not None and names[made.index] != "AGENT_CLOCK":
                target = self.symbols.variable(f"{self.configuration.name}:{made.name}", made.type.kind)
                values = made.domain.values
                if values is not None and len(values) == 1:
                    value = self.symbols.constant(values[0], made.domain.kind)
                    self.found.demands.append(Demand("eq", (target, value), target == value, made.span))

    def _alias(self, standing: Mapping[int, int]) -> None:
        """A merged token is the one that stands for it."""
        for key, to in standing.items():
            if key == to or to not in self.flown:
                continue
            for variable in (START, END):
                first = token_number(
                    f"{self.configuration.name}:{key}", self.flown[to].predicate, variable, self.names, self.symbols
                )
                self._equal(first, self.number(to, variable))
            code = self.names.predicates[self.flown[to].predicate]
            for k in range(len(code.parameters)):
                first = token_number(
                    f"{self.configuration.name}:{key}",
                    self.flown[to].predicate,
                    FIRST_PARAMETER + k,
                    self.names,
                    self.symbols,
                )
                self._equal(first, self.number(to, FIRST_PARAMETER + k))
            length = self.symbols.variable(f"{self.configuration.name}:{key}.duration", "int")
            self._equal(length, self.symbols.variable(f"{self.configuration.name}:{to}.duration", "int"))

    def _equal(self, a: Number, b: Number) -> None:
        self.found.variables[self.symbols.name_of(a)] = a
        value = self.found.values.get(self.symbols.name_of(b))
        if value is not None:
            self.found.values[self.symbols.name_of(a)] = value
        self.found.demands.append(equal(a, b))

    def _order(self) -> None:
        """One token after the other on each timeline; what followed at once follows at once."""
        timelines: dict[str, list[TokenRecord]] = {}
        for token in self.flown.values():
            timelines.setdefault(str(token.object), []).append(token)
        for name in (*self.configuration.internal, *self.configuration.external):
            tokens = sorted(timelines.get(name, ()), key=lambda one: (ends_of(one.start)[0], one.key))
            for first, second in pairwise(tokens):
                if first.end == second.start:
                    self.found.demands.append(
                        equal(self.number(first.key, END), self.number(second.key, START), is_structure=True)
                    )
                else:
                    ends = self.number(first.key, END), self.number(second.key, START)
                    self.found.demands.append(gap(*ends, 0, inf, None))

    def link(self, others: "Sequence[_ReactorReader]") -> None:
        """What is observed is what its owner does."""
        for other in others:
            shared = set(self.configuration.external) & set(other.configuration.internal)
            owned = {(str(each.object), each.start): each for each in other.flown.values()}
            for token in self.flown.values():
                theirs = owned.get((str(token.object), token.start))
                if str(token.object) not in shared or theirs is None or theirs.predicate != token.predicate:
                    continue
                if not theirs.runs:
                    self.found.lasting.add(f"{self.configuration.name}:{token.key}")
                pairs = [START, END] if theirs.end == token.end else [START]
                count = len(self.names.predicates[token.predicate].parameters)
                for variable in (*pairs, *range(FIRST_PARAMETER, FIRST_PARAMETER + count)):
                    self.found.demands.append(
                        equal(self.number(token.key, variable), other.number(theirs.key, variable), is_structure=True)
                    )

    def ask(self, goals: Sequence[GoalConfiguration]) -> None:
        """Tokens that the mission file asks for start no earlier than it says; goals of other arguments are others'."""
        for token in self.flown.values():
            if token.origin == "rule" or str(token.object) not in self.configuration.internal:
                continue
            own = token.predicate.rpartition(".")[2]
            for goal in goals:
                if goal.timeline != str(token.object) or goal.predicate != own or goal.start is None:
                    continue
                lower, upper = goal.start
                if isinstance(token.start, int) and lower <= token.start <= upper and self._is_of(token, goal):
                    start = self.number(token.key, START)
                    self.found.demands.append(gap(z3.IntVal(0), start, lower, min(upper, self.final_tick), None))
                    self._arguments(token, goal)
                    known = self.found.earliest.get(self.symbols.name_of(start), -1)
                    self.found.earliest[self.symbols.name_of(start)] = max(known, int(lower))

    def _is_of(self, token: TokenRecord, goal: GoalConfiguration) -> bool:
        """Whether a token has the arguments that a goal asks for."""
        names = [parameter.name for parameter in self.names.predicates[token.predicate].parameters]
        return has_arguments(names, token.arguments, goal)

    def _arguments(self, token: TokenRecord, goal: GoalConfiguration) -> None:
        """What the mission file says of a goal's arguments."""
        code = self.names.predicates[token.predicate]
        for k, parameter in enumerate(code.parameters):
            for name, value in goal.parameters:
                if name == parameter.name and not isinstance(value, tuple):
                    target = self.number(token.key, FIRST_PARAMETER + k)
                    given = self.symbols.constant(value, parameter.type.kind)
                    self.found.demands.append(Demand("eq", (target, given), target == given, None))
