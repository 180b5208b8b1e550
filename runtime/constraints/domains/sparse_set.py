"""Sparse set: small whole numbers, each once, in the order in which they came; no hashing (Briggs and Torczon 1993)."""

from array import array

from runtime.constraints.domains.arrays import grow_rows, lengthen

_FIRST_ROOM = 8 * 256  # bytes


class SparseSet:
    """Numbers from 0 to before `room`: `items` are the first `count` of an array."""

    def __init__(self, room: int) -> None:
        self.marks = array("b", bytes(room))
        self.items = array("q", bytes(_FIRST_ROOM))
        self.count = 0

    def empty(self, room: int) -> int:
        """Forget all numbers; those up to before `room` can be added from now on."""
        for i in range(self.count):
            self.marks[self.items[i]] = 0
        self.count = 0
        if len(self.marks) < room:
            grow_rows(self, "marks", 2 * room)
        return 0

    def add(self, number: int) -> int:
        """Add a number, unless it is there."""
        if self.marks[number]:
            return 0
        self.marks[number] = 1
        if self.count == len(self.items):
            lengthen(self, "items")
        self.items[self.count] = number
        self.count += 1
        return 1

    def has(self, number: int) -> bool:
        """Whether a number is there."""
        return bool(self.marks[number])

    def sort(self) -> int:
        """Put the numbers into ascending order (Shell 1959, with the gaps of Knuth)."""
        gap = 1
        while 3 * gap + 1 < self.count:
            gap = 3 * gap + 1
        while gap > 0:
            for i in range(gap, self.count):
                number = self.items[i]
                at = i
                while at >= gap and self.items[at - gap] > number:
                    self.items[at] = self.items[at - gap]
                    at -= gap
                self.items[at] = number
            gap //= 3
        return 0
