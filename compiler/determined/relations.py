"""How the token that a relation asks for is found, and what the slots of a rule under way stand for."""

from dataclasses import dataclass, field

from compiler.determined.operations import Cell

TOGETHER, MERGED, PREVIOUS, FOLLOWING, ROOT = "together", "merged", "previous", "following", "root"
# How the token that a relation asks for is found: by starting now, by holding now, by following.
RELATIONS = {
    "equals": TOGETHER,
    "starts": TOGETHER,
    "contained_by": MERGED,
    "starts_during": MERGED,
    "ends": MERGED,
    "meets": FOLLOWING,
    "met_by": PREVIOUS,
}


@dataclass(eq=False, slots=True)
class RuleInstance:
    """One rule instance, or the body of a predicate, under way: its token and what its slots stand for."""

    token: int
    rule: int
    tokens: dict[int, int]  # token slot -> number of the token
    locals: dict[int, Cell] = field(default_factory=dict)
