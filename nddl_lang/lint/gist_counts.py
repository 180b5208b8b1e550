"""What the statements of a model mention: statements that come and go in, what any of them mentions out."""

from collections.abc import Iterable
from collections.abc import Set as AbstractSet

from nddl_lang.lint.gist import Gist


class GistCounts:
    """Counts what statements mention, so that an edit costs what it touches."""

    def __init__(self) -> None:
        self._gists: dict[Gist, None] = {}
        self._variables: dict[object, int] = {}
        self._written: dict[object, int] = {}
        self._words: dict[object, int] = {}
        self._names: dict[object, int] = {}
        self._labels: dict[object, int] = {}
        self._requested: dict[object, int] = {}

    def update(self, gists: Iterable[Gist]) -> None:
        """Count what these mention, in place of those before."""
        now = dict.fromkeys(gists)
        for gone in self._gists.keys() - now.keys():
            self._count(gone, -1)
        for new in now.keys() - self._gists.keys():
            self._count(new, 1)
        self._gists = now

    def _count(self, each: Gist, by: int) -> None:
        _add(self._variables, each.variables, by)
        _add(self._written, each.written, by)
        _add(self._words, each.words, by)
        _add(self._names, each.names, by)
        _add(self._labels, each.labels, by)
        _add(self._requested, each.requested, by)

    @property
    def variables(self) -> AbstractSet[object]:
        """The variables that are read or written, apart from their declaration."""
        return self._variables.keys()

    @property
    def written(self) -> AbstractSet[object]:
        """The members that get a value in a constructor."""
        return self._written.keys()

    @property
    def words(self) -> AbstractSet[object]:
        """Names of types and enum values, and the texts of strings."""
        return self._words.keys()

    @property
    def names(self) -> AbstractSet[object]:
        """The names of declared variables."""
        return self._names.keys()

    @property
    def labels(self) -> AbstractSet[object]:
        """The tokens that the script refers to."""
        return self._labels.keys()

    @property
    def requested(self) -> AbstractSet[object]:
        """The names of the predicates of which tokens are made."""
        return self._requested.keys()


def _add(counts: dict[object, int], items: Iterable[object], by: int) -> None:
    for item in items:
        count = counts.get(item, 0) + by
        if count:
            counts[item] = count
        else:
            del counts[item]
