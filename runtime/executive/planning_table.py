"""The solver's table of a reactor in; out: what its solver reads, and which tokens are left out of planning alone.

A filter says what is not to be planned. What holds now is settled whole: the rules of a token that has begun ask for
what they ask for, whatever the table says of its class.
"""

from dataclasses import replace

from runtime.executive.view import PlanView
from runtime.plan.tags import FLAG_REJECTABLE, INACTIVE, LIST_THREAT, LISTS, NONE
from runtime.solver.configuration.configuration import (
    Configuration,
    FlawFilter,
    FlawManager,
    Match,
    default_configuration,
    with_resources,
)
from runtime.solver.configuration.handler_matching import HandlerMatching
from runtime.solver.configuration.handler_table import HandlerTable

_TIMES = (
    *[Match(variable=name) for name in ("start", "end", "duration")],
    *[Match(class_name=owner, variable="time") for owner in ("Resource", "Reservoir")],
)
_OPEN, _ORDER = "OpenConditionManager", "ThreatManager"
_OF_TOKENS = (_OPEN, _ORDER)  # of open tokens, and of those that are in no sequence


class LeftOut:
    """The tokens, open or in no sequence yet, that the table leaves out of planning."""

    def __init__(self, view: PlanView, configuration: Configuration) -> None:
        self.rows = view.rows
        common = tuple([each for each in configuration.filters if _is_of_tokens(each)])
        given = [each for each in configuration.managers if each.component == _OPEN]
        own = [each for one in given for each in one.filters if _is_of_tokens(each)] if given else [FlawFilter()]
        managers = [FlawManager(_OF_TOKENS[0], (*common, *own)), FlawManager(_OF_TOKENS[1], common)]
        self.is_empty = not any(manager.filters for manager in managers)
        matching = HandlerMatching(Configuration("", (), tuple(managers)), view.database.program)
        self.table = HandlerTable(matching, view.database)

    def has(self, t: int) -> bool:
        """Whether `t` is still to be decided, or to be put in a sequence, and is not to be planned."""
        rows = self.rows
        is_open = rows.status[t] == INACTIVE
        if not is_open and rows.link_head[LISTS * t + LIST_THREAT] < 0:
            return False
        parent = rows.parent[t]
        asker = rows.predicate[parent] if parent >= 0 else NONE
        rejectable = rows.flags[t] & FLAG_REJECTABLE != 0
        kind = self.table.token_kind(rows.predicate[t], asker, rows.relation[t], rows.label[t], rejectable)
        return self.table.token_row(0 if is_open else 1, kind) == NONE


def plans_ahead(configuration: Configuration) -> bool:
    """Whether the table leaves anything to plan: it does not leave out everything (T-REX 1)."""
    everything = (Match(), Match(class_name="Object"))
    return not any(each.component == "FlawFilter" and each.match in everything for each in configuration.filters)


def within_window(configuration: Configuration, has_resources: bool) -> Configuration:
    """The table as a reactor's solver has it: the window replaces the horizon, and what is left out of planning alone.

    Times are left to the execution, but for those that a handler names. What is planned on a timeline is always put in
    order there, for nothing begins that has no place.
    """
    common = [each for each in configuration.filters if _is_of_tokens(each)]
    given = with_resources(configuration) if has_resources else configuration  # whose filters count for resources
    managers = []
    for each in given.managers:
        filters = tuple([one for one in each.filters if one.component != "HorizonFilter"])
        if each.component in _OF_TOKENS:
            filters = tuple([one for one in filters if not _is_of_tokens(one)])
        elif not each.for_tokens:
            filters = (*common, *filters)
        managers.append(_without_times(replace(each, filters=filters)))
    if all(each.component != _ORDER for each in managers):
        usual = next(one for one in default_configuration().managers if one.component == _ORDER)
        managers.insert(0, replace(usual, handlers=()))  # its filters leave resources alone
    if all(each.component != _OPEN for each in managers):
        managers.append(FlawManager(_OPEN))
    clock = FlawFilter(match=Match(variable="AGENT_CLOCK"))
    left = [one for one in configuration.filters if one.component != "HorizonFilter" and not _is_of_tokens(one)]
    return replace(configuration, filters=(*left, clock), managers=tuple(managers))


def leaving_times(configuration: Configuration) -> Configuration:
    """The table of a reactor's solver for a plan of its goals beforehand, which leaves times to the execution too."""
    return replace(configuration, managers=tuple([_without_times(each) for each in configuration.managers]))


def _without_times(manager: FlawManager) -> FlawManager:
    """A manager that decides of no times but of those that one of its handlers names."""
    if manager.component != "UnboundVariableManager":
        return manager
    named = {handler.match.variable for handler in manager.handlers}
    times = tuple([FlawFilter(match=match) for match in _TIMES if match.variable not in named])
    return replace(manager, filters=(*manager.filters, *times))


def _is_of_tokens(one: FlawFilter) -> bool:
    """Whether a filter leaves out tokens by what they are, and not by their times, or variables alone."""
    return one.component == "FlawFilter" and one.match.variable is None
