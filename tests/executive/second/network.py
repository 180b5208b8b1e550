"""Differences of whole numbers, each with its bounds: the times and arguments of one plan."""

from collections.abc import Set as AbstractSet

from tests.executive.second.description import FAR


class ContradictionError(Exception):
    """No values are left."""


NOBODY, ORDER = -1, -2  # who says something: nobody in particular, the order on a timeline


class Network:
    """`x[j] - x[i] <= w`; bounds are kept tight by going round until nothing changes.

    All that is said is kept with who says it (`speaker`, a token): so it can be left out again.
    """

    def __init__(self) -> None:
        self.speaker = NOBODY
        self.said: list[tuple[int, str, tuple[int, ...]]] = []
        self.low: list[int] = []
        self.high: list[int] = []
        self.edges: list[tuple[tuple[int, int], ...]] = []  # of i: j and w
        self.back: list[tuple[tuple[int, int], ...]] = []  # of j: i and w

    def copy(self) -> "Network":
        """Another network that says the same."""
        other = Network()
        other.speaker, other.said = self.speaker, self.said[:]
        other.low, other.high = self.low[:], self.high[:]
        other.edges, other.back = self.edges[:], self.back[:]
        return other

    def without(self, speakers: set[int]) -> "Network":
        """A network without what these have said; its numbers stay."""
        other = Network()
        for other.speaker, what, given in self.said:
            if what == "new" or other.speaker not in speakers:
                getattr(other, what)(*given)
        other.speaker = NOBODY
        return other

    def new(self, low: int = -FAR, high: int = FAR) -> int:
        """A number between bounds."""
        self.said.append((self.speaker, "new", (low, high)))
        self.low.append(low)
        self.high.append(high)
        self.edges.append(())
        self.back.append(())
        return len(self.low) - 1

    def least(self, one: int, low: int) -> None:
        """It is `low` or more."""
        self.said.append((self.speaker, "least", (one, low)))
        self._spread([(one, low, True)])

    def most(self, one: int, high: int) -> None:
        """It is `high` or less."""
        self.said.append((self.speaker, "most", (one, high)))
        self._spread([(one, high, False)])

    def within(self, one: int, low: int, high: int) -> None:
        """It lies in a range."""
        self.said.append((self.speaker, "within", (one, low, high)))
        self._spread([(one, low, True), (one, high, False)])

    def differ(self, first: int, second: int, low: int, high: int) -> None:
        """The second less the first lies in a range."""
        self.said.append((self.speaker, "differ", (first, second, low, high)))
        if high < FAR:
            self._edge(first, second, high)
        if low > -FAR:
            self._edge(second, first, -low)

    def value(self, one: int) -> int | None:
        """What it is, if that is known."""
        return self.low[one] if self.low[one] == self.high[one] else None

    def distance(self, first: int, second: int) -> int:
        """The largest that the second can be beyond the first, by the edges alone; FAR if they do not say."""
        best = {first: 0}
        agenda = [first]
        while agenda:
            here = agenda.pop()
            for there, weight in self.edges[here]:
                if best[here] + weight < best.get(there, FAR):
                    best[there] = best[here] + weight
                    agenda.append(there)
        return best.get(second, FAR)

    def follows(self, first: int, second: int, beyond: AbstractSet[int] = frozenset()) -> bool:
        """Whether relations say one after another that the second is no later; what lengths add up to says nothing.

        Relations by way of `beyond` do not count.
        """
        met, agenda = {first}, [first]
        while agenda:
            for there, weight in self.edges[agenda.pop()]:
                if weight <= 0 and there not in met and there not in beyond:
                    met.add(there)
                    agenda.append(there)
        return second in met

    def _edge(self, i: int, j: int, weight: int) -> None:
        self.edges[i] = (*self.edges[i], (j, weight))
        self.back[j] = (*self.back[j], (i, weight))
        self._spread([(j, self.high[i] + weight, False), (i, self.low[j] - weight, True)])

    def _spread(self, agenda: list[tuple[int, int, bool]]) -> None:
        while agenda:
            one, bound, is_low = agenda.pop()
            if is_low:
                if bound <= self.low[one]:
                    continue
                self.low[one] = bound
                agenda += [(i, bound - weight, True) for i, weight in self.back[one]]
            else:
                if bound >= self.high[one]:
                    continue
                self.high[one] = bound
                agenda += [(j, bound + weight, False) for j, weight in self.edges[one]]
            if self.low[one] > self.high[one]:
                raise ContradictionError
