"""Faults of six kinds, each aimed at the functions of engine and executive where it belongs, and that missions run."""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from tests.checker.judge.source_faults import MOMENTS, FaultySource, Place, SourceFault

_OUT = frozenset({"call left out", "change left out", "taken as done"})
_TRIES = 50


@dataclass(frozen=True, slots=True)
class _Aim:
    """A kind of fault: files below runtime/, words in the name of the function or in what is changed, changes."""

    kind: str
    files: str
    words: str
    changes: frozenset[str]

    def is_met_by(self, place: Place, file: str) -> bool:
        """Whether the change of a place is such a fault."""
        if place.change not in self.changes or not re.match(self.files, file):
            return False
        return re.search(self.words, f"{place.function} {place.text}".lower()) is not None


_AIMS = (
    _Aim("skipped propagation", r"constraints/|plan/|determined/(machine|expand|arguments|reactor)", "", _OUT),
    _Aim(
        "lost wake-up",
        "",
        r"watch|wake|awake|queue|push|stir|due\b|pending|agenda|notify|wait|revive|dirty|touch|changed|next_tick|fire",
        _OUT | {"first left out", "condition"},
    ),
    _Aim(
        "wrong bound side",
        "",
        r"bound|lower|upper|start|end|earliest|latest|min|max|weight|distance|duration|tick|first|last|narrow|limit",
        frozenset({"side", "sign", "comparison", "arguments swapped", "constant"}),
    ),
    _Aim(
        "dropped observation",
        "executive/|determined/",
        r"observ|notify|publish|tell|told|receive|restrict|argument|news|current|hold|message|request|recall|goal",
        _OUT | {"first left out", "condition", "loop", "part of a condition left out"},
    ),
    _Aim(
        "archived too early",
        r"executive/|plan/tokens/(archive|retraction|ties)|constraints/relaxation|determined/(log|present|inputs|reactor)",
        r"archive|over|past|forget|remov|clear|keep|free|drop|cut|before|relax|retract|release|live|done|old",
        _OUT | {"comparison", "constant", "condition", "part of a condition left out", "sign"},
    ),
    _Aim(
        "wrong order",
        "executive/|plan/|solver/|determined/|constraints/stn/heap",
        r"order|sort|heap|insert|before|after|place|first|last|next|follow|precede|timeline|successor|for ",
        frozenset({"order", "loop", "arguments swapped", "comparison"}),
    ),
)
KINDS = tuple(aim.kind for aim in _AIMS)


class Targets:
    """The places at which a fault of each kind can be put, among lines that missions run."""

    def __init__(self, lines: dict[str, set[int]], root: str) -> None:
        self.sources = {file: FaultySource(file) for file in sorted(lines)}
        self.used: set[tuple[str, int, str]] = set()
        self.tried: Counter[tuple[str, str]] = Counter()  # by kind and file
        self.broke: Counter[tuple[str, str]] = Counter()
        self.places: dict[str, dict[str, dict[str, list[Place]]]] = {kind: {} for kind in KINDS}  # file, function
        for aim in _AIMS:
            for place in self._run(lines):
                if aim.is_met_by(place, place.file.removeprefix(root)):
                    functions = self.places[aim.kind].setdefault(place.file, {})
                    functions.setdefault(place.function, []).append(place)

    def _run(self, lines: dict[str, set[int]]) -> Iterator[Place]:
        for file, source in self.sources.items():
            yield from (place for place in source.places if place.line in lines[file])

    def fault(self, dice: Random, kind: str) -> SourceFault | None:
        """A fault of this kind in a function that the dice choose, each place but once; None if none was found.

        Files are chosen the more often, the more of their faults have broken a model.
        """
        files = sorted(self.places[kind])
        shares = [(1 + 6 * self.broke[kind, file]) / (4 + self.tried[kind, file]) for file in files]
        for _ in range(_TRIES):
            (file,) = dice.choices(files, shares)
            place = dice.choice(self.places[kind][file][dice.choice(sorted(self.places[kind][file]))])
            moment, nth = dice.choice(("always", *MOMENTS)), dice.choice((1, 2, 3, 5, 8))
            mark = place.file, place.spot, place.change
            if mark in self.used:
                continue
            self.used.add(mark)
            found = self.sources[place.file].fault(place, moment, nth)
            if found is not None:
                return found
        return None

    def note(self, kind: str, fault: SourceFault, *, broke: bool) -> None:
        """Note whether a fault has broken a model."""
        self.tried[kind, fault.place.file] += 1
        self.broke[kind, fault.place.file] += broke
