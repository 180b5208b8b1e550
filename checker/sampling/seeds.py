"""Batch seed in, one seed per mission out, all of them different."""

from runtime.executive.chance import draw_bits

_WORD = 0xFFFFFFFF


def mission_seed(batch_seed: int, number: int) -> int:
    """The seed of mission `number` (from 1): a permutation of the 32-bit words, chosen by the batch seed.

    A permutation, so that no two of the first 2**32 missions share a seed (reference of T-REX, 4 row 22); two rounds
    of MurmurHash3's 32-bit finaliser, keyed by the batch seed's own stream.
    """
    keys = draw_bits(batch_seed, "mission seeds", 0)
    return _stir(_stir((number & _WORD) ^ (keys & _WORD)) ^ (keys >> 32))


def _stir(word: int) -> int:
    word = ((word ^ (word >> 16)) * 0x85EBCA6B) & _WORD
    word = ((word ^ (word >> 13)) * 0xC2B2AE35) & _WORD
    return word ^ (word >> 16)
