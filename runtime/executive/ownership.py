"""Owners and users of timelines: which reactor comes before which, and how long an owner may take (T-REX 1.1, 1.3)."""

from collections.abc import Sequence

from runtime.executive.reactor import TeleoReactor


class OwnershipError(ValueError):
    """Reactors whose timelines have no owner, several owners, or owners in a cycle."""


def in_order(reactors: Sequence[TeleoReactor]) -> list[TeleoReactor]:
    """Reactors with owners before users, otherwise as given (T-REX 1.3).

    Raises `OwnershipError` where a timeline has no owner or several, or where owners depend on each other.
    """
    owner: dict[str, TeleoReactor] = {}
    for reactor in reactors:
        for timeline in reactor.internal:
            if timeline in owner:
                raise OwnershipError(f"`{timeline}` is owned by `{owner[timeline].name}` and by `{reactor.name}`")
            owner[timeline] = reactor
    waiting = list(reactors)
    done: list[TeleoReactor] = []
    while waiting:
        for reactor in waiting:
            for timeline in reactor.external:
                if timeline not in owner:
                    raise OwnershipError(f"`{reactor.name}` uses `{timeline}`, which no reactor owns")
            if all(owner[timeline] in done for timeline in reactor.external):
                break
        else:
            names = ", ".join(f"`{reactor.name}`" for reactor in waiting)
            raise OwnershipError(f"reactors wait for each other's timelines in a cycle: {names}")
        waiting.remove(reactor)
        done.append(reactor)
    return done


def tell_owners(reactors: Sequence[TeleoReactor]) -> None:
    """Give each reactor its execution latency, and those of the owners it uses; `reactors` has owners first.

    The execution latency is a reactor's own and the largest of those it depends on (T-REX 1.1).
    """
    windows: dict[str, tuple[int, int]] = {}
    for reactor in reactors:
        latency = reactor.latency + max((windows[timeline][0] for timeline in reactor.external), default=0)
        reactor.set_owners({timeline: windows[timeline] for timeline in reactor.external}, latency)
        windows |= dict.fromkeys(reactor.internal, (latency, reactor.lookahead))
