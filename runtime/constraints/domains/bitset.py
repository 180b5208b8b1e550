"""Keep which values between a variable's bounds are missing: words of bits, a log of who removed which."""

from runtime.constraints.domains.arrays import grow_rows, lengthen
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    ALL_BITS,
    EVENT_HOLES,
    EVERY_SECOND_BIT,
    FLOAT_TOLERANCE,
    FOUR_OF_EIGHT_BITS,
    KIND_FLOAT,
    NEVER,
    ONE_BIT,
    TRAIL_HOLES,
    TRAIL_WORDS,
    TWO_OF_FOUR_BITS,
)


def _lowest_bit(x: int) -> int:
    """Give the index of the lowest set bit, which is how many zeros stand behind it; x is not 0."""
    return _bits_in((x & -x) - 1)


def _bits_in(x: int) -> int:
    """Count the set bits of a word, in pairs, then in fours, then in bytes (Warren, Hacker's Delight, 5-1)."""
    x -= (x >> 1) & EVERY_SECOND_BIT
    x = (x & TWO_OF_FOUR_BITS) + ((x >> 2) & TWO_OF_FOUR_BITS)
    x = (x + (x >> 4)) & FOUR_OF_EIGHT_BITS
    x += x >> 8
    x += x >> 16
    x += x >> 32
    return x & 127


def _highest_bit(x: int) -> int:
    """Give the index of the highest set bit; x is not 0."""
    n = 0
    if x >> 32:
        n += 32
        x >>= 32
    if x >> 16:
        n += 16
        x >>= 16
    if x >> 8:
        n += 8
        x >>= 8
    if x >> 4:
        n += 4
        x >>= 4
    if x >> 2:
        n += 2
        x >>= 2
    if x >> 1:
        n += 1
    return n


def _allocate_words(s: Store, count: int) -> int:
    """Take `count` consecutive words; small blocks come back through free lists."""
    if count < len(s.word_free) and s.word_free[count] >= 0:
        first = s.word_free[count]
        s.word_free[count] = s.bits[first] - 1
        return first
    first = s.bits_used
    if first + count > len(s.bits):
        lengthen(s, "bits", need=first + count)
    s.bits_used = first + count
    return first


def _release_words(s: Store, first: int, count: int) -> None:
    """Give words back (blocks of more than 64 words are not used again)."""
    if count < len(s.word_free):
        s.bits[first] = s.word_free[count] + 1
        s.word_free[count] = first


def attach_words(s: Store, v: int, base: int, values: int) -> None:
    """Give `v` a full bit set for the `values` indices that start at `base`."""
    count = (values + 63) >> 6
    first = _allocate_words(s, count)
    for k in range(count):
        s.bits[first + k] = ALL_BITS
    if values & 63:
        s.bits[first + count - 1] = (ONE_BIT << (values & 63)) - 1
    s.word[v] = first
    s.words_of[v] = count
    s.bit_base[v] = base
    s.save(v, TRAIL_WORDS, 0, 0)


def detach_words(s: Store, v: int) -> None:
    """Take the bit set of `v` away; its log must be empty."""
    _release_words(s, s.word[v], s.words_of[v])
    if s.table[v] >= 0:
        _release_table(s, s.table[v], s.table_length[v])
    s.word[v] = -1
    s.words_of[v] = 0
    s.table[v] = -1


def index_above(s: Store, v: int, x: int) -> int:
    """Give the first index whose value is at least x; it may lie beyond the last index."""
    if s.table[v] < 0:
        return x - s.bit_base[v] if x > s.bit_base[v] else 0
    return table_index(s, v, float(x))


def index_below(s: Store, v: int, x: int) -> int:
    """Give the last index whose value is at most x; -1 if there is none."""
    if s.table[v] < 0:
        return x - s.bit_base[v] if x >= s.bit_base[v] else -1
    index = table_index(s, v, float(x))
    if index < s.table_length[v] and s.table_values[s.table[v] + index] <= x:
        return index
    return index - 1


def table_index(s: Store, v: int, x: float) -> int:
    """Find by halving the first index of a table whose value is at least x, less the tolerance of a float."""
    first = s.table[v]
    low = 0
    high = s.table_length[v]
    if s.kind[v] == KIND_FLOAT:
        x -= FLOAT_TOLERANCE
    while low < high:
        middle = (low + high) >> 1
        if s.table_values[first + middle] < x:
            low = middle + 1
        else:
            high = middle
    return low


def next_index(s: Store, v: int, index: int) -> int:
    """Give the first set index from `index` on; -1 if there is none."""
    if index < 0:
        index = 0
    k = index >> 6
    if k >= s.words_of[v]:
        return -1
    x = s.bits[s.word[v] + k] & (ALL_BITS << (index & 63) & ALL_BITS)
    while x == 0:
        k += 1
        if k >= s.words_of[v]:
            return -1
        x = s.bits[s.word[v] + k]
    return (k << 6) + _lowest_bit(x)


def previous_index(s: Store, v: int, index: int) -> int:
    """Give the last set index up to `index`; -1 if there is none."""
    if index < 0:
        return -1
    k = index >> 6
    if k >= s.words_of[v]:
        k = s.words_of[v] - 1
        index = (k << 6) + 63
    x = s.bits[s.word[v] + k] & (ALL_BITS >> (63 - (index & 63)))
    while x == 0:
        k -= 1
        if k < 0:
            return -1
        x = s.bits[s.word[v] + k]
    return (k << 6) + _highest_bit(x)


def value_at(s: Store, v: int, index: int) -> int:
    """Give the whole number at a index."""
    if s.table[v] < 0:
        return s.bit_base[v] + index
    return int(s.table_values[s.table[v] + index])


def next_value(s: Store, v: int, x: int) -> int:
    """Give the first value from x on that is no hole; NEVER if there is none."""
    index = next_index(s, v, index_above(s, v, x))
    return NEVER if index < 0 else value_at(s, v, index)


def previous_value(s: Store, v: int, x: int) -> int:
    """Give the last value up to x that is no hole; -NEVER if there is none."""
    index = previous_index(s, v, index_below(s, v, x))
    return -NEVER if index < 0 else value_at(s, v, index)


def has_value(s: Store, v: int, x: int) -> bool:
    """Tell whether a discrete variable may take x."""
    if x < s.lb[v] or x > s.ub[v]:
        return False
    if s.word[v] < 0:
        return True
    index = index_above(s, v, x)
    if s.table[v] >= 0 and (index >= s.table_length[v] or value_at(s, v, index) != x):
        return False
    return (s.bits[s.word[v] + (index >> 6)] >> (index & 63)) & 1 != 0


def clear_bits(s: Store, v: int, k: int, mask: int, support: int) -> None:
    """Remove the indices of `mask` in the k-th word of `v`, log who did it, and wake the watches of holes."""
    entry = s.hole_free
    if entry >= 0:
        s.hole_free = s.hole_next[entry]
    else:
        entry = s.holes_used
        if entry == len(s.hole_mask):
            lengthen(s, "hole_word hole_mask", "hole_support hole_when hole_next")
        s.holes_used += 1
    s.bits[s.word[v] + k] &= ALL_BITS ^ mask
    s.hole_word[entry] = k
    s.hole_mask[entry] = mask
    s.hole_support[entry] = support
    s.hole_when[entry] = s.trail_base + s.trail_size
    s.hole_next[entry] = s.hole_head[v]
    s.hole_head[v] = entry
    s.save(v, TRAIL_HOLES, entry, 0)
    s.updates += 1
    s.wake(v, EVENT_HOLES)


def restore_bits(s: Store, v: int) -> None:
    """Put the values of the newest log entry of `v` back and drop the entry."""
    entry = s.hole_head[v]
    s.bits[s.word[v] + s.hole_word[entry]] |= s.hole_mask[entry]
    s.hole_head[v] = s.hole_next[entry]
    s.hole_next[entry] = s.hole_free
    s.hole_free = entry


def drop_log(s: Store, v: int) -> None:
    """Free all log entries of a variable."""
    while s.hole_head[v] >= 0:
        entry = s.hole_head[v]
        s.hole_head[v] = s.hole_next[entry]
        s.hole_next[entry] = s.hole_free
        s.hole_free = entry


def attach_table(s: Store, v: int, values: list[float]) -> None:
    """Give `v` a full bit set over a sorted table of values that are sparse or real."""
    count = len(values)
    if count < len(s.table_free) and s.table_free[count] >= 0:
        first = s.table_free[count]
        s.table_free[count] = int(s.table_values[first])
    else:
        first = s.table_used
        if first + count > len(s.table_values):
            grow_rows(s, "table_values", 2 * (first + count))
        s.table_used = first + count
    for k in range(count):
        s.table_values[first + k] = values[k]
    s.table[v] = first
    s.table_length[v] = count
    attach_words(s, v, 0, count)


def _release_table(s: Store, first: int, count: int) -> None:
    """Give a table back (tables of more than 64 values are not used again)."""
    if count < len(s.table_free):
        s.table_values[first] = s.table_free[count]
        s.table_free[count] = first


def count_values(s: Store, v: int) -> int:
    """Count the values of a discrete variable."""
    if s.word[v] < 0:
        return s.ub[v] - s.lb[v] + 1
    total = 0
    index = index_above(s, v, s.lb[v])
    last = index_below(s, v, s.ub[v])
    if last >= 64 * s.words_of[v]:
        last = 64 * s.words_of[v] - 1
    while index <= last:
        # A word at a time: the indices below its first one and above its last one are shifted out.
        x = s.bits[s.word[v] + (index >> 6)] >> (index & 63)
        rest = last - index
        if rest < 63:
            x &= (ONE_BIT << (rest + 1)) - 1
        total += _bits_in(x)
        index = (index | 63) + 1
    return total
