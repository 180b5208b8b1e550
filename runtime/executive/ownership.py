"""Owners and users of timelines: which reactor comes before which, and how long an owner may take (T-REX 1.1, 1.3)."""

from collections.abc import Sequence

from runtime.executive.reactor import TeleoReactor


class OwnershipError(ValueError):
    """Reactors whose timelines have no owner, several owners, or owners in a cycle."""


def in_order(reactors: Sequence[TeleoReactor]) -> list[TeleoReactor]:
    """Reactors with owners before users: a walk in the order given, each behind the owners that it uses (T-REX 1.3).

    Raises `OwnershipError` where a timeline has no owner or several, or where owners depend on each other.
    """
    owner: dict[str, TeleoReactor] = {}
    for reactor in reactors:
        for timeline in reactor.internal:
            if timeline in owner:
                raise OwnershipError(f"`{timeline}` is owned by `{owner[timeline].name}` and by `{reactor.name}`")
            owner[timeline] = reactor
    for reactor in reactors:
        for timeline in reactor.external:
            if timeline not in owner:
                raise OwnershipError(f"`{reactor.name}` uses `{timeline}`, which no reactor owns")
    done: list[TeleoReactor] = []
    for reactor in reactors:
        walk = [reactor]
        while walk:
            behind = [owner[timeline] for timeline in walk[-1].external if owner[timeline] not in done]
            if walk[-1] in done or not behind:
                done += [one for one in (walk.pop(),) if one not in done]
            elif behind[0] in walk:
                cycle = walk[walk.index(behind[0]) :]
                names = ", ".join(f"`{one.name}`" for one in reactors if one in cycle)
                raise OwnershipError(f"reactors wait for each other's timelines in a cycle: {names}")
            else:
                walk.append(behind[0])
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
