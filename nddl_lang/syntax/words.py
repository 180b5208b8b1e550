"""List the words of NDDL that mean something by themselves."""

BASE_TYPES = ("int", "float", "bool", "string")

RELATIONS = (
    "any",
    "before",
    "after",
    "meets",
    "met_by",
    "starts",
    "ends",
    "equals",
    "equal",
    "contains",
    "contained_by",
    "parallels",
    "paralleled_by",
    "starts_before",
    "starts_after",
    "starts_before_end",
    "starts_during",
    "ends_before",
    "ends_after",
    "ends_after_start",
    "ends_during",
    "contains_start",
    "contains_end",
)

GOALS = ("goal", "fact", "rejectable")

# Words that the grammar names themselves.
PLAIN = (
    "action",
    "class",
    "close",
    "condition",
    "effect",
    "else",
    "enforce",
    "enum",
    "extends",
    "filter",
    "foreach",
    "if",
    "in",
    "new",
    "predicate",
    "super",
    "this",
    "typedef",
)

# Words of earlier dialects; today they are ordinary names, so former.py looks at what follows them.
FORMER = ("filterOnly", "private", "public", "protected", "switch", "constraint", "subgoal", "delete")

# What other languages call the same.
ELSEWHERE = {
    "during": "contained_by",
    "finishes": "ends",
    "precedes": "before",
    "includes": "contains",
    "encloses": "contains",
    "follows": "after",
    "coincides": "equals",
    "then": "meets",
    "for": "foreach",
    "when": "if",
    "fluent": "predicate",
    "type": "typedef",
    "struct": "class",
}

# The kind of lexeme that each word makes; any other word is an IDENT, and so is in the end a FORMER one.
KINDS: dict[str, str] = {
    **dict.fromkeys(BASE_TYPES, "BASETYPE"),
    **dict.fromkeys(RELATIONS, "RELATION"),
    **dict.fromkeys(GOALS, "GOAL"),
    **dict.fromkeys(("true", "false"), "BOOL"),
    **dict.fromkeys(FORMER, "FORMER"),
    **{word: word for word in PLAIN},
    "inf": "INT",
    "inff": "FLOAT",
}

RESERVED = frozenset(KINDS) - frozenset(FORMER)
