"""Keep entries in the order of a key and a tie; the smallest is on top. Entries may be stale: who reads them checks."""

from runtime.constraints.domains.arrays import blank, lengthen


class Heap:
    """A binary heap in three arrays."""

    def __init__(self) -> None:
        self.length = 0
        self.first = blank(64)
        self.second = blank(64)
        self.item = blank(64)

    def push(self, key: int, tie: int, entry: int) -> None:
        """Add an entry."""
        if self.length == len(self.item):
            lengthen(self, "first second item")
        at = self.length
        self.length = at + 1
        while at > 0:
            above = (at - 1) >> 1
            if self.first[above] < key or (self.first[above] == key and self.second[above] <= tie):
                break
            self.first[at] = self.first[above]
            self.second[at] = self.second[above]
            self.item[at] = self.item[above]
            at = above
        self.first[at] = key
        self.second[at] = tie
        self.item[at] = entry

    def top_key(self) -> int:
        """Key of the entry on top."""
        return self.first[0]

    def top_item(self) -> int:
        """What the entry on top is about."""
        return self.item[0]

    def pop(self) -> None:
        """Take the top off."""
        last = self.length - 1
        self.length = last
        key = self.first[last]
        tie = self.second[last]
        entry = self.item[last]
        at = 0
        while True:
            below = 2 * at + 1
            if below >= last:
                break
            if below + 1 < last and (
                self.first[below + 1] < self.first[below]
                or (self.first[below + 1] == self.first[below] and self.second[below + 1] < self.second[below])
            ):
                below += 1
            if key < self.first[below] or (key == self.first[below] and tie <= self.second[below]):
                break
            self.first[at] = self.first[below]
            self.second[at] = self.second[below]
            self.item[at] = self.item[below]
            at = below
        self.first[at] = key
        self.second[at] = tie
        self.item[at] = entry

    def clear(self) -> None:
        """Forget all entries."""
        self.length = 0
