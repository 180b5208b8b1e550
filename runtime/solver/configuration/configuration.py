"""Solver configuration as frozen data: which flaws are mended, in which order, and how."""

from dataclasses import dataclass, fields, replace
from functools import cache

from runtime.solver.tags import WORST_PRIORITY


@dataclass(frozen=True, slots=True)
class Match:
    """Which tokens, variables or resources a filter or handler matches; all that is given must hold."""

    class_name: str | None = None
    predicate: str | None = None
    variable: str | None = None
    parent_class: str | None = None
    parent_predicate: str | None = None
    parent_relation: str | None = None
    token_name: str | None = None

    @property
    def weight(self) -> int:
        """How many attributes are given: the more, the more specific."""
        return sum(getattr(self, attribute.name) is not None for attribute in fields(self))


@dataclass(frozen=True, slots=True)
class FlawFilter:
    """Flaws to exclude. `component` FlawFilter excludes all that match; the others test more."""

    component: str = "FlawFilter"
    match: Match = Match()
    policy: str = "PartiallyContained"


@dataclass(frozen=True, slots=True)
class FlawHandler:
    """How a flaw is mended: the component, when it applies, and its settings.

    `guards` and `parent_guards` are pairs of a variable of the token (of its parent) and the value it must have.
    `order` sorts choices; `choice` says which an HSTS handler offers; `values` are those of ValEnum.
    `keep`, `constraint` and `iterate` are for resource threats.
    """

    component: str
    match: Match = Match()
    guards: tuple[tuple[str, str], ...] = ()
    parent_guards: tuple[tuple[str, str], ...] = ()
    priority: float = WORST_PRIORITY
    max_choices: int = 0
    order: tuple[str, ...] = ()
    choice: str = "mergeFirst"
    values: tuple[str, ...] = ()
    keep: str = "none"
    constraint: str = "precedesOnly"
    iterate: str = "pairFirst"

    @property
    def specificity(self) -> int:
        """How many conditions it has: of all handlers that apply, the most specific one is taken."""
        return self.match.weight + len(self.guards) + len(self.parent_guards)


@dataclass(frozen=True, slots=True)
class FlawManager:
    """One kind of flaw, its filters and handlers; `order` sorts flaws of resources.

    A manager of resources leaves nothing out, unless it stands `for_tokens`: see `with_resources`.
    """

    component: str
    filters: tuple[FlawFilter, ...] = ()
    handlers: tuple[FlawHandler, ...] = ()
    order: tuple[str, ...] = ()
    for_tokens: bool = False


@dataclass(frozen=True, slots=True)
class Configuration:
    """The settings of a solver; `filters` apply to tokens and variables of every manager."""

    name: str
    filters: tuple[FlawFilter, ...]
    managers: tuple[FlawManager, ...]


def with_resources(configuration: Configuration) -> Configuration:
    """The configuration as a model with resources reads it, EUROPA's way.

    Where no manager of resources is named, one of timelines also orders the tokens that use a resource too much, unless
    its filters exclude them.
    """
    if any(manager.component == "ResourceThreatManager" for manager in configuration.managers):
        return configuration
    managers: list[FlawManager] = []
    for manager in configuration.managers:
        managers.append(manager)
        if manager.component == "ThreatManager":
            handlers = tuple(replace(one, component="ResourceThreatHandler", order=()) for one in manager.handlers)
            managers.append(FlawManager("ResourceThreatManager", manager.filters, handlers, for_tokens=True))
    return replace(configuration, managers=tuple(managers))


@cache
def default_configuration() -> Configuration:
    """What a solver does that is told nothing: as EUROPA's own runner with the configuration it ships."""
    undecided = [FlawFilter(match=Match(variable=name)) for name in ("start", "end", "duration", "object")]
    events = [
        FlawFilter(match=Match(class_name=owner, variable=name))
        for owner in ("Resource", "Reservoir")
        for name in ("time", "quantity")
    ]
    uses = FlawFilter(match=Match(class_name="Reusable", variable="quantity"))
    resources = tuple(FlawFilter(match=Match(class_name=name)) for name in ("Reservoir", "Reusable"))
    return Configuration(
        "default",
        (FlawFilter("HorizonFilter"),),
        (
            FlawManager("ThreatManager", resources, (FlawHandler("StandardThreatHandler", priority=0.0),)),
            FlawManager("OpenConditionManager", (), (FlawHandler("StandardOpenConditionHandler", priority=0.0),)),
            FlawManager(
                "UnboundVariableManager",
                (*undecided, *events, uses, FlawFilter("InfiniteDynamicFilter")),
                (FlawHandler("StandardVariableHandler", priority=0.0),),
            ),
        ),
    )
