"""Sparse sets: each number once, in the order in which they came."""

from runtime.constraints.domains.sparse_set import SparseSet


def test_numbers_stand_once_in_their_order_however_many_they_are() -> None:
    given = [(7 * k * k + 3) % 1009 for k in range(2000)]
    found = SparseSet(1009)
    added = [number for number in given if found.add(number)]
    assert added == list(dict.fromkeys(given))
    assert [found.items[k] for k in range(found.count)] == added
    assert [number for number in range(1009) if found.has(number)] == sorted(added)
