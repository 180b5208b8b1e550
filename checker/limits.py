"""Limits on what a mission may cost: keys of [check], each with the most that is allowed."""

from enum import StrEnum


class Limit(StrEnum):
    """What a mission may have only so much of; the value is the key in [check]."""

    REJECTED = "max_rejected"  # goals given up, late ones included
    LATE = "max_late"
    REPAIRS = "max_repairs"
    UNDELIVERED = "max_undelivered"


Limits = tuple[tuple[Limit, int], ...]  # the most of each loss that [check] allows
