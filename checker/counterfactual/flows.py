"""The lines of models in; out: whether a resource is rather filled than emptied at a line, or the other way round.

What only empties is hardly all: a rule called `Refill`, or a token `more`, that takes something as all others do was
meant to bring it.
"""

import re
from collections import Counter
from collections.abc import Sequence

from checker.counterfactual.word_odds import EVENTS
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind

_USE = re.compile(r"\(\s*((?:\w+\.)*)(consume|produce)\s+(\w+)\s*\)")
_PART = re.compile(r"[A-Z]?[a-z]+")
_BRINGS = re.compile(r"(?:re)?(?:fill|charg|stock|fuel|plenish)|gain|more|add|bring|suppl|produc|make|got", re.I)
_TAKES = re.compile(r"use|tak|gone|drain|drink|eat|burn|spend|spent|cost|consum|empt|discharg|less|away", re.I)


class Flows:
    """How many lines empty and fill each resource."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._counts = Counter((owner, word) for site in sites for owner, word, _ in _USE.findall(site.text))

    def asks_for(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit turns the only line that could do so to the side that no line is on, as names there say."""
        used = _USE.search(site.text)
        if edit.kind is not EditKind.PREDICATE or edit.new not in EVENTS or used is None:
            return False
        owner, word, label = used.groups()
        is_lacking = not self._counts[owner, edit.new] and self._counts[owner, word] > 1
        wanted, other = (_BRINGS, _TAKES) if edit.new == "produce" else (_TAKES, _BRINGS)
        names = [label, *_PART.findall(site.rule.rpartition(".")[2])]
        speaks = [sum(one.match(name) is not None for name in names) for one in (wanted, other)]
        return is_lacking and speaks[0] > speaks[1]
