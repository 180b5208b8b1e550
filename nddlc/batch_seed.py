"""A batch seed on the command line: a whole number as it is, `auto` as one that is drawn now."""

import secrets

import click

from checker.mission import LARGEST_SEED

_AUTOMATIC = "auto"
_BITS = 32


class BatchSeed(click.ParamType[int]):
    """Either way the seed stands in the report, so that the batch can be flown again."""

    name = "N|auto"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The seed that a text says; a new one on each call for `auto`."""
        if value == _AUTOMATIC:
            return secrets.randbits(_BITS)
        try:
            seed = int(str(value))
        except ValueError:
            seed = -1
        if not 0 <= seed <= LARGEST_SEED:
            self.fail(f"`{value}` is neither a whole number from 0 to {LARGEST_SEED} nor `auto`", param, ctx)
        return seed
