"""What a block has to do, before it is put into an order: each item with the registers that it needs and tells."""

from dataclasses import dataclass, field

from compiler.determined.operations import Instruction, Way
from nddl_lang.text.source import Span

# Under which truth values of which guards' conditions something happens, outermost first.
Context = tuple[tuple[int, bool], ...]


@dataclass(eq=False, slots=True)
class Item:
    """A constraint, or something done to the timelines.

    One of `ways` computes what is not known yet; where all is known, `check` is what must hold (none: the first way,
    computed once more, must give the same). An item without ways acts by `check` once all `needs` are known.
    `rank` puts acts before (-1) or after (1) the rest.
    """

    context: Context
    span: Span
    name: str
    needs: tuple[int, ...]
    ways: tuple[Way, ...] = ()
    check: tuple[Instruction, ...] | None = None
    rank: int = 0


@dataclass(eq=False, slots=True)
class Worksheet:
    """All items of a block, and what is known before it runs."""

    items: list[Item] = field(default_factory=list)
    given: set[int] = field(default_factory=set)  # registers that hold a value when the block starts
    doubtful: set[int] = field(default_factory=set)  # registers that may hold one: those of tokens that hold already
    homes: dict[int, Context] = field(default_factory=dict)  # where a register comes to be, if not at the top
    names: dict[int, tuple[str, Span | None]] = field(default_factory=dict)  # what a register is to the modeler
    wanted: dict[int, Context] = field(default_factory=dict)  # registers that must have a value in the end
    openable: set[int] = field(default_factory=set)  # parameters that may stay open where no constraint names them
