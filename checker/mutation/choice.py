"""Sites in, mutants out: one small fault each, all kinds in turn, drawn from a seed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import REPAIRS, EditKind


@dataclass(frozen=True, eq=False, slots=True)
class Mutant:
    """A fault: the edit that made it, and the line that it changed."""

    site: EditSite
    edit: SmallEdit

    def is_at(self, file: str, line: int) -> bool:
        """Whether a place is the changed line."""
        return self.site.holds(file, line) or (file == self.edit.file and line == self.edit.line)

    def is_in_rule(self, file: str, line: int) -> bool:
        """Whether a place is in the rule that the changed line is a part of; without one, at the line itself."""
        first, last = self.site.scope
        return file == self.site.file and first <= line <= last


def mutants_of(sites: Sequence[EditSite], seed: int) -> Iterator[Mutant]:
    """All mutants in an order that `seed` decides: a kind after the other, of each kind a line after the other."""
    chance = np.random.default_rng(seed)
    waiting: dict[EditKind, list[Mutant]] = {}
    kinds = [kind for kind in EditKind if kind not in REPAIRS]
    for kind in kinds:
        at = [(site, [edit for edit in site.edits if edit.kind is kind]) for site in sites]
        pending = [(site, [edits[k] for k in chance.permutation(len(edits))]) for site, edits in at if edits]
        pending = [pending[k] for k in chance.permutation(len(pending))]
        rounds = max((len(edits) for _, edits in pending), default=0)
        waiting[kind] = [
            Mutant(site, edits[turn]) for turn in range(rounds) for site, edits in pending if turn < len(edits)
        ]
        waiting[kind].reverse()
    while any(waiting.values()):
        for kind in kinds:
            if waiting[kind]:
                yield waiting[kind].pop()
