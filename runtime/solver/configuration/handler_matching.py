"""Say which filters and handlers of a configuration concern a token, a variable or a resource, from names alone.

What depends on names and classes only is settled here, once per kind of token; what changes during search (horizon,
guards) is handed on as numbers.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from compiler.program import FIRST_PARAMETER, OBJECT, START, STATE, ClassCode, PredicateCode, Program
from runtime.solver.configuration.configuration import Configuration, FlawFilter, FlawHandler, Match
from runtime.solver.tags import (
    ACTIVATE_FIRST,
    ACTIVATE_ONLY,
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_INFINITE,
    FILTER_LOCAL,
    FILTER_MASTER_LOOSE,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_PARAMETER,
    FILTER_STATIC,
    FILTER_TOKEN_LOOSE,
    HANDLER_BASIC,
    HANDLER_HSTS,
    HANDLER_HSTS_THREAT,
    HANDLER_LISTED,
    HANDLER_MAX,
    HANDLER_MIN,
    HANDLER_RANDOM,
    HANDLER_RESOURCE,
    HANDLER_SUPPORT,
    HANDLER_THREAT,
    MANAGER_NAMES,
    MERGE_FIRST,
    MERGE_ONLY,
    NONE,
    OPEN_CONDITION,
    ORDER_EARLY,
    ORDER_FAR,
    ORDER_KEY,
    ORDER_LATE,
    ORDER_NEAR,
    POLICY_PARTIAL,
    POLICY_POSSIBLE,
    POLICY_TOTAL,
    RESOURCE_THREAT,
    THREAT,
    UNBOUND_VARIABLE,
)

FILTER_CODES = {
    "FlawFilter": FILTER_STATIC,
    "HorizonFilter": FILTER_HORIZON,
    "HorizonVariableFilter": FILTER_HORIZON_VARIABLE,
    "GuardFilter": FILTER_GUARD,
    "NotGuardFilter": FILTER_NOT_GUARD,
    "ParameterFilter": FILTER_PARAMETER,
    "LocalVariableFilter": FILTER_LOCAL,
    "Singleton": FILTER_NOT_SINGLETON,
    "InfiniteDynamicFilter": FILTER_INFINITE,
    "MasterMustBeInsertedFilter": FILTER_MASTER_LOOSE,
    "TokenMustBeAssignedFilter": FILTER_TOKEN_LOOSE,
    "ParentMustBeInsertedFilter": FILTER_TOKEN_LOOSE,
}
POLICY_CODES = {
    "PartiallyContained": POLICY_PARTIAL,
    "PossiblyContained": POLICY_POSSIBLE,
    "TotallyContained": POLICY_TOTAL,
}
HANDLER_CODES = {
    "StandardVariableHandler": HANDLER_MIN,
    "Min": HANDLER_MIN,
    "Max": HANDLER_MAX,
    "Random": HANDLER_RANDOM,
    "ValEnum": HANDLER_LISTED,
    "StandardOpenConditionHandler": HANDLER_SUPPORT,
    "SupportedOpenConditionHandler": HANDLER_SUPPORT,
    "BasicOpenConditionHandler": HANDLER_BASIC,
    "HSTSOpenConditionDecisionPoint": HANDLER_HSTS,
    "StandardThreatHandler": HANDLER_THREAT,
    "HSTSThreatDecisionPoint": HANDLER_HSTS_THREAT,
    "ResourceThreatHandler": HANDLER_RESOURCE,
}
ORDER_CODES = {
    "early": ORDER_EARLY,
    "late": ORDER_LATE,
    "near": ORDER_NEAR,
    "far": ORDER_FAR,
    "ascendingKey": ORDER_KEY,
}
CHOICE_CODES = {
    "mergeFirst": MERGE_FIRST,
    "activateFirst": ACTIVATE_FIRST,
    "mergeOnly": MERGE_ONLY,
    "activateOnly": ACTIVATE_ONLY,
}
TOKEN_FILTERS = (FILTER_HORIZON, FILTER_MASTER_LOOSE)
VARIABLE_FILTERS = (
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_GUARD,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_INFINITE,
    FILTER_TOKEN_LOOSE,
)
STANDARD = {
    THREAT: "StandardThreatHandler",
    OPEN_CONDITION: "StandardOpenConditionHandler",
    UNBOUND_VARIABLE: "StandardVariableHandler",
    RESOURCE_THREAT: "ResourceThreatHandler",
}
COUNTED = "CBReusable"  # is used without tokens
BUILT_IN = ("state", "object", "duration", "start", "end")  # variables of every token, in order
SIMILAR_RELATIONS = {"before": ("before", "meets"), "after": ("after", "met_by")}


@dataclass(frozen=True, slots=True)
class TokenKind:
    """All that a configuration can know of a token before search: full predicate names, relation, name."""

    predicate: str
    master_predicate: str | None = None
    relation: str | None = None
    name: str = ""


@dataclass(frozen=True, slots=True)
class Treatment:
    """What a manager does about a kind of flaw.

    `filters` are pairs (code, policy) that are tested at every step: the flaw waits while one of them holds.
    `handlers` are indices into `Matching.handlers`, the one to take first; those with guards may not apply.
    """

    filters: tuple[tuple[int, int], ...]
    handlers: tuple[int, ...]


class Matching:
    """A configuration seen with the classes and predicates of a program."""

    def __init__(self, configuration: Configuration, program: Program) -> None:
        self.filters = configuration.filters
        self.managers = configuration.managers
        self.manager_kinds = tuple(MANAGER_NAMES.index(manager.component) for manager in configuration.managers)
        self.classes: dict[str, ClassCode] = {code.name: code for code in program.classes}
        self.predicates: dict[str, PredicateCode] = {code.name: code for code in program.predicates}
        self.handlers: list[FlawHandler] = []
        self.handlers_of: list[list[int]] = []
        for kind, manager in zip(self.manager_kinds, configuration.managers, strict=True):
            last = FlawHandler(STANDARD[kind], priority=manager.handlers[0].priority if manager.handlers else 0.0)
            first = len(self.handlers)
            self.handlers += [last, *manager.handlers]
            self.handlers_of.append(list(range(first, len(self.handlers))))

    @property
    def reads_masters(self) -> bool:
        """Whether any filter or handler asks for the parent of a token."""
        return any(match.master_class or match.master_predicate or match.master_relation for match in self.matches())

    @property
    def reads_names(self) -> bool:
        """Whether any filter or handler asks for the name of a token."""
        return any(match.token_name is not None for match in self.matches())

    def matches(self) -> Iterator[Match]:
        """All match attributes of the configuration."""
        yield from (one.match for one in self.filters)
        yield from (one.match for manager in self.managers for one in manager.filters)
        yield from (one.match for one in self.handlers)

    def token(self, manager: int, token: TokenKind) -> Treatment | None:
        """What manager number `manager` does about a token that is open or not ordered; None: nothing."""
        return self.treat(manager, token, None, None, TOKEN_FILTERS)

    def token_variable(self, manager: int, token: TokenKind, variable: str, is_local: bool) -> Treatment | None:
        """What manager number `manager` does about a variable of a token, or of a rule instance of it."""
        place = FILTER_LOCAL if is_local else FILTER_PARAMETER
        return self.treat(manager, token, None, variable, (*VARIABLE_FILTERS, place))

    def variable_text(self, predicate: str, place: int) -> str | None:
        """What variable number `place` of a token is called; None for those that nobody decides.

        An event has one time, which both its start and its end are, and no duration.
        """
        code = self.predicates[predicate]
        if place >= FIRST_PARAMETER:
            return code.parameters[place - FIRST_PARAMETER].name
        if place == START and code.is_event:
            return "time"
        if place == STATE or (code.is_event and place != OBJECT):
            return None
        return BUILT_IN[place]

    def place_of(self, predicate: str, name: str) -> int:
        """Which variable of a token is called `name`; NONE if none."""
        if name in BUILT_IN:
            return BUILT_IN.index(name)
        code = self.predicates[predicate]
        if name == "time" and code.is_event:
            return START
        names = [parameter.name for parameter in code.parameters]
        return FIRST_PARAMETER + names.index(name) if name in names else NONE

    def member(self, manager: int, owner: str, variable: str) -> Treatment | None:
        """What manager number `manager` does about a member of an object of class `owner`."""
        return self.treat(manager, None, owner, variable, VARIABLE_FILTERS)

    def global_variable(self, manager: int, variable: str) -> Treatment | None:
        """What manager number `manager` does about a global variable."""
        return self.treat(manager, None, None, variable, VARIABLE_FILTERS)

    def instant(self, manager: int, resource: str) -> Treatment | None:
        """What manager number `manager` does about a resource of class `resource`; mostly filters do not concern it."""
        if self.managers[manager].for_tokens:
            return (
                None if COUNTED in self.ancestry(resource) else self.treat(manager, None, resource, None, TOKEN_FILTERS)
            )
        fitting = [h for h in self.handlers_of[manager] if self.fits(self.handlers[h].match, None, resource, None)]
        return Treatment((), self.sorted(fitting))

    def treat(
        self, manager: int, token: TokenKind | None, owner: str | None, variable: str | None, tested: tuple[int, ...]
    ) -> Treatment | None:
        dynamic = []
        for one in (*self.filters, *self.managers[manager].filters):
            if not self.fits(one.match, token, owner, variable):
                continue
            code = FILTER_CODES[one.component]
            if code == FILTER_STATIC or (code in (FILTER_LOCAL, FILTER_PARAMETER) and code in tested):
                return None
            if code in tested:
                dynamic.append((code, policy(one)))
        fitting = [h for h in self.handlers_of[manager] if self.fits(self.handlers[h].match, token, owner, variable)]
        return Treatment(tuple(dict.fromkeys(dynamic)), self.sorted(fitting))

    def sorted(self, handlers: list[int]) -> tuple[int, ...]:
        """The most specific first, then the lowest priority, then the last in the text; the standard one at the end."""
        own, *given = handlers
        given.sort(key=lambda h: (-self.handlers[h].specificity, self.handlers[h].priority, -h))
        return (*given, own)

    def fits(self, match: Match, token: TokenKind | None, owner: str | None, variable: str | None) -> bool:
        """Whether all that `match` gives holds."""
        if token is not None:
            owner = self.predicates[token.predicate].class_name
        elif match.predicate or match.token_name is not None or match.master_relation:
            return False
        if match.class_name is not None and (owner is None or match.class_name not in self.ancestry(owner)):
            return False
        if match.variable is not None and match.variable != variable:
            return False
        if token is None:
            return not (match.master_class or match.master_predicate)
        if match.predicate is not None and match.predicate not in spellings(token.predicate):
            return False
        if match.token_name is not None and match.token_name not in token.name:
            return False
        return self.fits_master(match, token)

    def fits_master(self, match: Match, token: TokenKind) -> bool:
        """Whether all that `match` gives about the parent holds."""
        master = token.master_predicate
        relation = token.relation if master is not None and token.relation is not None else "none"
        if match.master_relation is not None:
            wanted = SIMILAR_RELATIONS.get(match.master_relation, (match.master_relation,))
            if relation not in wanted:
                return False
        if match.master_class is None and match.master_predicate is None:
            return True
        if master is None:
            return False
        if match.master_class is not None:
            return match.master_class in self.ancestry(self.predicates[master].class_name) and (
                match.master_predicate is None or match.master_predicate in spellings(master)
            )
        return match.master_predicate in spellings(master)

    def ancestry(self, name: str) -> list[str]:
        """A class and all it extends."""
        found = []
        current: str | None = name
        while current is not None:
            found.append(current)
            code = self.classes.get(current)
            current = code.base if code is not None else None
        if "Object" not in found:
            found.append("Object")
        return found


def spellings(predicate: str) -> tuple[str, str]:
    """The ways to name a predicate in a configuration: alone, or with its class."""
    return predicate, predicate.rpartition(".")[2]


def policy(one: FlawFilter) -> int:
    """The policy of a horizon filter; 0 for others."""
    is_horizon = one.component in ("HorizonFilter", "HorizonVariableFilter")
    return POLICY_CODES[one.policy] if is_horizon else 0
