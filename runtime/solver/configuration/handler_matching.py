"""Handler matching: the filters and handlers of a configuration for a kind of token, a variable or a resource.

What depends on names and classes only is decided here, once per kind; what changes during search (horizon, guards)
is handed on as codes.
"""

from dataclasses import dataclass

from compiler.program import FIRST_PARAMETER, OBJECT, START, STATE, TOKEN_VARIABLES, ClassCode, PredicateCode, Program
from runtime.solver.configuration.configuration import Configuration, FlawHandler, Match
from runtime.solver.configuration.words import FILTERS, POLICIES, STANDARD
from runtime.solver.tags import (
    FILTER_GOALS,
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_INFINITE,
    FILTER_LOCAL,
    FILTER_NOT_ASSIGNED,
    FILTER_NOT_GOALS,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_PARAMETER,
    FILTER_PARENT_NOT_ASSIGNED,
    FILTER_STATIC,
    MANAGER_NAMES,
    NONE,
)

_GOAL_FILTERS = (FILTER_GOALS, FILTER_NOT_GOALS)
_TOKEN_FILTERS = (FILTER_HORIZON, FILTER_PARENT_NOT_ASSIGNED)
_VARIABLE_FILTERS = (
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_GUARD,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_INFINITE,
    FILTER_NOT_ASSIGNED,
)
_COUNTED = "CBReusable"  # is used without tokens
_SIMILAR_RELATIONS = {"before": ("before", "meets"), "after": ("after", "met_by")}


@dataclass(frozen=True, slots=True)
class TokenKind:
    """What a configuration can match of a token before search: full predicate names, relation, name, whether it is a
    goal that may be rejected."""

    predicate: str
    parent_predicate: str | None = None
    relation: str | None = None
    name: str = ""
    is_rejectable: bool = False


@dataclass(frozen=True, slots=True)
class HandlerRow:
    """The filters and handlers of a manager for a kind of flaw.

    `filters` are pairs (code, policy) that are tested at every step: the flaw waits while one of them holds.
    `handlers` are indices into `HandlerMatching.handlers`, best first; those with guards may not apply.
    """

    filters: tuple[tuple[int, int], ...]
    handlers: tuple[int, ...]


class HandlerMatching:
    """A configuration matched with the classes and predicates of a program."""

    def __init__(self, configuration: Configuration, program: Program) -> None:
        self.filters = configuration.filters
        self.managers = configuration.managers
        self.manager_kinds = tuple(MANAGER_NAMES.index(manager.component) for manager in configuration.managers)
        self.classes: dict[str, ClassCode] = {code.name: code for code in program.classes}
        self.predicates: dict[str, PredicateCode] = {code.name: code for code in program.predicates}
        self.handlers: list[FlawHandler] = []
        self.handlers_of: list[list[int]] = []  # of each manager, best first
        for kind, manager in zip(self.manager_kinds, configuration.managers, strict=True):
            last = FlawHandler(STANDARD[kind], priority=manager.handlers[0].priority if manager.handlers else 0.0)
            first = len(self.handlers)
            self.handlers += [last, *manager.handlers]
            # The most specific first, then the lowest priority, then the last in the text; the standard one at the end.
            given = sorted(range(first + 1, len(self.handlers)), key=self._rank)
            self.handlers_of.append([*given, first])

    def _rank(self, handler: int) -> tuple[int, float, int]:
        return (-self.handlers[handler].specificity, self.handlers[handler].priority, -handler)

    @property
    def is_by_predicate(self) -> bool:
        """Whether no filter or handler matches the parent of a token, its name, or whether it is a goal."""
        filters = (*self.filters, *(one for manager in self.managers for one in manager.filters))
        if any(FILTERS[one.component] in _GOAL_FILTERS for one in filters):
            return False
        matches = [*(one.match for one in filters), *(one.match for one in self.handlers)]
        if any(match.parent_class or match.parent_predicate or match.parent_relation for match in matches):
            return False
        return all(match.token_name is None for match in matches)

    def token(self, manager: int, token: TokenKind) -> HandlerRow | None:
        """The row of a manager for an open or unordered token; None: a filter excludes it."""
        return self._match(manager, token, None, None, _TOKEN_FILTERS)

    def token_variable(self, manager: int, token: TokenKind, variable: str, is_local: bool) -> HandlerRow | None:
        """The row of a manager for a variable of a token, or a local one of its rules."""
        own = FILTER_LOCAL if is_local else FILTER_PARAMETER
        return self._match(manager, token, None, variable, (*_VARIABLE_FILTERS, own))

    def variable_text(self, predicate: str, number: int) -> str | None:
        """The name of variable `number` of a token; None for those that nobody decides.

        An event has one time, which both its start and its end are, and no duration.
        """
        code = self.predicates[predicate]
        if number >= FIRST_PARAMETER:
            return code.parameters[number - FIRST_PARAMETER].name
        if number == START and code.is_event:
            return "time"
        if number == STATE or (code.is_event and number != OBJECT):
            return None
        return TOKEN_VARIABLES[number]

    def variable_number(self, predicate: str, name: str) -> int:
        """The number of the variable of a token that is called `name`; NONE if none is."""
        if name in TOKEN_VARIABLES:
            return TOKEN_VARIABLES.index(name)
        code = self.predicates[predicate]
        if name == "time" and code.is_event:
            return START
        names = [parameter.name for parameter in code.parameters]
        return FIRST_PARAMETER + names.index(name) if name in names else NONE

    def lasting_variable(self, manager: int, owner: str | None, variable: str) -> HandlerRow | None:
        """The row of a manager for a member of an object of class `owner`, or a global variable (None)."""
        return self._match(manager, None, owner, variable, _VARIABLE_FILTERS)

    def resource(self, manager: int, owner: str) -> HandlerRow | None:
        """The row of a manager for a resource of a class; filters count only in a manager that stands `for_tokens`."""
        if self.managers[manager].for_tokens:
            is_counted = _COUNTED in self._ancestry(owner)
            return None if is_counted else self._match(manager, None, owner, None, _TOKEN_FILTERS)
        fitting = [h for h in self.handlers_of[manager] if self._fits(self.handlers[h].match, None, owner, None)]
        return HandlerRow((), tuple(fitting))

    def _match(
        self, manager: int, token: TokenKind | None, owner: str | None, variable: str | None, tested: tuple[int, ...]
    ) -> HandlerRow | None:
        dynamic = []
        for one in (*self.filters, *self.managers[manager].filters):
            if not self._fits(one.match, token, owner, variable):
                continue
            code = FILTERS[one.component]
            if code in _GOAL_FILTERS and token is not None and token.is_rejectable is (code == FILTER_GOALS):
                return None
            if code == FILTER_STATIC or (code in (FILTER_LOCAL, FILTER_PARAMETER) and code in tested):
                return None
            if code in tested:
                dynamic.append((code, POLICIES.index(one.policy)))
        fitting = [h for h in self.handlers_of[manager] if self._fits(self.handlers[h].match, token, owner, variable)]
        return HandlerRow(tuple(dict.fromkeys(dynamic)), tuple(fitting))

    def _fits(self, match: Match, token: TokenKind | None, owner: str | None, variable: str | None) -> bool:
        """Whether all that `match` gives holds."""
        if token is not None:
            owner = self.predicates[token.predicate].class_name
        elif match.predicate or match.token_name is not None or match.parent_relation:
            return False
        if match.class_name is not None and (owner is None or match.class_name not in self._ancestry(owner)):
            return False
        if match.variable is not None and match.variable != variable:
            return False
        if token is None:
            return not (match.parent_class or match.parent_predicate)
        if match.predicate is not None and match.predicate not in _spellings(token.predicate):
            return False
        if match.token_name is not None and match.token_name not in token.name:
            return False
        return self._fits_parent(match, token)

    def _fits_parent(self, match: Match, token: TokenKind) -> bool:
        """Whether all that `match` gives about the parent holds."""
        parent = token.parent_predicate
        relation = token.relation if parent is not None and token.relation is not None else "none"
        if match.parent_relation is not None:
            wanted = _SIMILAR_RELATIONS.get(match.parent_relation, (match.parent_relation,))
            if relation not in wanted:
                return False
        if parent is None:
            return match.parent_class is None and match.parent_predicate is None
        if match.parent_class not in (None, *self._ancestry(self.predicates[parent].class_name)):
            return False
        return match.parent_predicate in (None, *_spellings(parent))

    def _ancestry(self, name: str) -> list[str]:
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


def _spellings(predicate: str) -> tuple[str, str]:
    """The ways to name a predicate in a configuration: alone, or with its class."""
    return predicate, predicate.rpartition(".")[2]
