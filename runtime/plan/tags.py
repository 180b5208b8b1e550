"""Integer codes of the plan database: states, flags, operands, instructions, trail entries."""

NONE = -1

# ---- states of a token; the symbols of its state variable have ids of their own ----
INACTIVE, ACTIVE, MERGED, REJECTED, FREED = range(5)
STATE_NAMES = ("INACTIVE", "ACTIVE", "MERGED", "REJECTED", "FREED")
SYMBOL_ACTIVE, SYMBOL_MERGED, SYMBOL_REJECTED, _SYMBOL_INACTIVE = range(4)
STATE_SYMBOLS = ("ACTIVE", "MERGED", "REJECTED", "INACTIVE")

# ---- flags of a token ----
FLAG_GOAL = 1
FLAG_FACT = 2
FLAG_REJECTABLE = 4
FLAG_CONDITION = 8
FLAG_EFFECT = 16
FLAG_ACTION = 32
FLAG_EVENT = 64
FLAG_NATIVE = 128  # a token of a resource: active from the moment it is made
FLAG_SENT = 256  # the owner of its timeline was asked for it

# ---- variables of a token, as in compiler/program.py ----
STATE, OBJECT, DURATION, START, END, FIRST_PARAMETER = range(6)

# ---- where an operand's variable is found ----
# (a shared constant, a fresh copy of a prototype, a global, a slot, a token's variable, a member, the object under
# construction, a union of base domains, nowhere)
IN_CONSTANT, IN_PROTOTYPE, IN_GLOBAL, IN_LOCAL, IN_TOKEN, IN_FIELD, IN_SELF, IN_UNION, IN_NONE = range(9)
TOKEN_SHIFT = 65536  # an operand IN_TOKEN is token slot * TOKEN_SHIFT + variable

# ---- instructions of the bytecode ----
(
    DO_VARIABLE,
    DO_POST,
    DO_SAMPLE,
    DO_CHILD,
    DO_RELATE,
    DO_GUARD,
    DO_FOREACH,
    DO_OBJECT,
    DO_ASSIGN,
    DO_BETWEEN,
    DO_USE,
) = range(11)

# ---- object of a child ----
OBJECT_ANY, OBJECT_OWN, OBJECT_GIVEN = range(3)

# ---- kinds of scopes: a token's body, a rule instance, a guard, the branch that it runs, a merge, an insertion into a
# timeline, the script ----
SCOPE_BODY, SCOPE_RULE, SCOPE_GUARD, SCOPE_BRANCH, SCOPE_MERGE, SCOPE_INSERTION, SCOPE_SCRIPT = range(7)
BRANCH_WAITING, BRANCH_THEN, BRANCH_ELSE = range(3)

# ---- what a scope holds ----
HOLDS_EDGE, HOLDS_CONSTRAINT, HOLDS_VARIABLES, HOLDS_RESTRICTION, HOLDS_USE = range(5)

# ---- what an engine variable is; nobody decides an internal one ----
ROLE_INTERNAL, ROLE_GLOBAL, ROLE_MEMBER, ROLE_TOKEN, ROLE_LOCAL = range(5)

# ---- what a token of a resource does ----
RESOURCE_HOLDS, RESOURCE_PRODUCES, RESOURCE_CONSUMES = range(1, 4)

# ---- what is certainly wrong with a level ----
AS_IT_IS = 2**62  # a bound that counts as tight as it is
TOO_LOW, TOO_HIGH, TOO_FAST, TOO_MUCH, TOO_TIGHT = range(1, 6)

# ---- trail entries: a field's old value, or something to take back ----
(
    UNDO_STATUS,
    UNDO_BRANCH,
    UNDO_INPUTS,
    UNDO_MERGED,
    UNDO_NEW_TOKEN,
    UNDO_NEW_SCOPE,
    UNDO_NEW_HOLD,
    UNDO_NEW_CELLS,
    UNDO_LINK,
    UNDO_UNLINK,
    UNDO_NEW_PAIR,
) = range(11)

# ---- lists that tokens are on ----
LIST_OPEN, LIST_THREAT, LIST_PREDICATE, LIST_ORDER = range(4)
LISTS = 4

HEAD_OPEN = 0
HEAD_THREAT = 1
HEAD_PREDICATE = 2  # + predicate; the sequences of the objects follow

# ---- infinity of NDDL's integers, and of weights: no edge is posted for it ----
INFINITY = 4503599627370495

# ---- operations from here on are constraints that the modeler wrote ----
FIRST_WRITTEN = 1024

# ---- relations: each distance is (target?, point, target?, point, lower, upper) ----
RELATION_CELLS = 6
DURATION_FREE, DURATION_EQUAL, DURATION_TARGET_SHORTER, DURATION_ORIGIN_SHORTER = range(4)

# ---- limits of a resource, in the order of its row ----
LIMITS = 7
INITIAL, MINIMUM, MAXIMUM, RATE, TOTAL, PRODUCTION_RATE, PRODUCTION_TOTAL = range(LIMITS)

# ---- frames up to this length are used again ----
SHORT = 256
