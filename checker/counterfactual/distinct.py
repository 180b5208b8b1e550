"""The lines of models in; out: constants by which lines tell two cases of one variable apart.

Where one branch says `flush.degrees == HOT;` and the other `flush.degrees == LUKEWARM;`, who wrote both wanted two.
"""

import re
from collections import defaultdict
from collections.abc import Sequence

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import NUMERIC

_SAID = re.compile(r"\s*([\w.]+)\s*==\s*([A-Za-z_]\w*)\s*;")
_VALUE = re.compile(r"=\s*(-?[\d.]+)\s*;")


class Distinct:
    """Which named numbers lines of one rule hold the same variable to."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._values: dict[str, float] = {}
        told: dict[object, set[str]] = defaultdict(set)
        for site in sites:
            if site.is_number and (value := _VALUE.search(site.text)) is not None:
                self._values[site.named] = float(value.group(1))
            if site.rule and (said := _SAID.fullmatch(site.text)) is not None:
                told[site.file, site.scope, said.group(1)].add(said.group(2))
        self._others: dict[str, set[str]] = defaultdict(set)
        for names in told.values():
            for name in names:
                self._others[name] |= names - {name}

    def confuses(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a number becomes another one that it is told apart from."""
        if edit.kind not in NUMERIC or not site.named:
            return False
        return any(self._values.get(other) == float(edit.new) for other in self._others[site.named])
