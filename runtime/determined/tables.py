"""Tables of a determined reactor: code, and where registers stand, the same for all machines that carry it out."""

from array import array

from runtime.determined.tags import NONE


class CodeTables:
    """By timeline, by block and by predicate."""

    def __init__(self, lines: int) -> None:
        self.current = array("q", bytes(8 * lines))  # banks of registers
        self.following = array("q", bytes(8 * lines))
        self.incoming = array("q", bytes(8 * lines))
        self.wished = array("q", bytes(8 * lines))
        self.previous = array("q", bytes(8 * lines))
        self.remembers = array("q", bytes(8 * lines))
        self.starts = array("q", bytes(8 * lines))
        self.width = array("q", bytes(8 * lines))
        self.size = array("q", [0])  # how many parameters each predicate has
        self.default_block = array("q", bytes(8 * lines))
        self.order = array("q", [NONE])
        self.code = array("i", bytes(4 * 8))
        self.block_start = array("q", [0])
        self.block_predicate = array("q", [NONE])
        self.block_mask = array("q", [0])
        self.block_sure = array("q", [0])  # whether all parameters of its tokens must have a value
        self.block_free = array("q", [0])  # whether it begins at any time
        self.shown = array("q", [0])  # registers, block after block
        self.shown_first = array("q", [0])
