"""The kinds of small edits, and which of them leave a demand out, stand outside of models, or are repairs alone."""

from enum import StrEnum


class EditKind(StrEnum):
    """What an edit changes."""

    CONSTANT = "constant"
    OFF_BY_ONE = "off by one"
    LIMIT = "limit"  # a constant's name, for another
    RELATION = "relation"
    COMPARISON = "comparison"
    SIGN = "sign"
    ARGUMENTS = "swapped arguments"
    NAME = "name"  # a variable, for another of its type
    VALUE = "value"  # of an enumeration, or a truth value
    POINT = "time point"  # the start of a token, for its end
    TOKEN = "token"  # one token of a rule, for another
    PREDICATE = "predicate"  # of a child
    MISSION = "mission file"
    SETTING = "setting"  # of a reactor in Python
    GOAL = "goal"  # what a goal asks for
    PROMISE = "property"  # what a property of the mission promises
    DROPPED_CONSTRAINT = "dropped constraint"
    DROPPED_BRANCH = "dropped branch"
    OPERATOR = "operator"  # a product for a sum
    TERM = "term"  # of a sum or product, left out
    FORMULA = "formula"  # other operators of an expression
    MISSING = "missing term"  # a term or factor more, of what nothing reads
    LINE = "missing line"  # a line more, behind another one
    TURN = "swapped tokens"  # of a limit by which one begins after the end of the other
    SWAP = "swapped lines"  # what two lines say, each in the place of the other


OUTSIDE = (EditKind.MISSION, EditKind.SETTING, EditKind.GOAL, EditKind.PROMISE)  # of any model
NUMERIC = (EditKind.CONSTANT, EditKind.OFF_BY_ONE)
NUMBERS = (*NUMERIC, EditKind.SETTING)  # in models and outside
DROPPED = (EditKind.DROPPED_CONSTRAINT, EditKind.DROPPED_BRANCH)
REPAIRS = (
    EditKind.TERM,
    EditKind.FORMULA,
    EditKind.MISSING,
    EditKind.LINE,
    EditKind.TURN,
    EditKind.SWAP,
)  # tried as causes, and not made as faults
