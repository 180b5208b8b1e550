"""Codes of the semantic passes: names, types, duplicates, rules and states."""

from nddl_lang.text.diagnostic import Code, Severity

UNKNOWN_NAME = Code("NDDL201", Severity.ERROR, "name", "nothing named `{name}` is in scope here")
DECLARED_BELOW = Code("NDDL202", Severity.ERROR, "name", "`{name}` is used above its declaration")
NAME_OF_OTHER_BLOCK = Code(
    "NDDL203", Severity.ERROR, "name", "`{name}` is known only inside the block that declares it"
)
UNKNOWN_MEMBER = Code("NDDL204", Severity.ERROR, "name", "class `{owner}` has no member `{name}`")
UNKNOWN_TOKEN_VARIABLE = Code("NDDL205", Severity.ERROR, "name", "a token of `{predicate}` has no parameter `{name}`")
UNKNOWN_ENUM_VALUE = Code("NDDL206", Severity.ERROR, "name", "`{name}` is no value of enum `{enum}`")
MISPLACED_THIS = Code("NDDL207", Severity.ERROR, "name", "`this` has no meaning in {place}")
UNKNOWN_CONSTRAINT = Code("NDDL208", Severity.ERROR, "name", "there is no constraint `{name}`")
UNKNOWN_FUNCTION = Code("NDDL209", Severity.ERROR, "name", "there is no function `{name}`")
FORMER_CONSTRAINT = Code("NDDL210", Severity.ERROR, "name", "the constraint `{name}` is called `{today}` today")
NOT_IN_NDDL3 = Code("NDDL211", Severity.ERROR, "name", "`{name}` is not part of nddl3")
UNKNOWN_TYPE = Code("NDDL212", Severity.ERROR, "name", "there is no type `{name}`")
UNKNOWN_CLASS = Code("NDDL213", Severity.ERROR, "name", "there is no class `{name}`")
UNDEFINED_CLASS = Code("NDDL214", Severity.ERROR, "name", "class `{name}` is announced, but not defined so far")
CONSTRUCTOR_NAME = Code("NDDL215", Severity.ERROR, "name", "a constructor is called like its class, `{owner}`")
UNKNOWN_PREDICATE = Code("NDDL216", Severity.ERROR, "name", "class `{owner}` has no predicate `{name}`")
UNKNOWN_TOKEN = Code("NDDL217", Severity.ERROR, "name", "there is no token `{name}` here")
UNKNOWN_RELATION = Code("NDDL218", Severity.ERROR, "name", "`{name}` names no relation")
MISSING_ORIGIN = Code("NDDL219", Severity.ERROR, "name", "outside a rule a relation needs a token on its left")
DUPLICATE_TYPE = Code("NDDL220", Severity.ERROR, "duplicate", "`{name}` is declared twice")
DUPLICATE_MEMBER = Code("NDDL221", Severity.ERROR, "duplicate", "class `{owner}` has a member `{name}` already")
NATIVE_CLASS = Code("NDDL222", Severity.WARNING, "duplicate", "class `{name}` is built in; this text is not read")
DUPLICATE_PREDICATE = Code("NDDL223", Severity.ERROR, "duplicate", "class `{owner}` has a predicate `{name}` already")
DUPLICATE_PARAMETER = Code("NDDL224", Severity.ERROR, "duplicate", "`{owner}` has a parameter `{name}` already")
BUILTIN_PARAMETER = Code("NDDL225", Severity.ERROR, "duplicate", "every token has a variable `{name}` of its own")
DUPLICATE_CONSTRUCTOR = Code("NDDL226", Severity.ERROR, "duplicate", "`{signature}` is declared twice")
DUPLICATE_FORMAL = Code("NDDL227", Severity.ERROR, "duplicate", "two parameters are called `{name}`")
DUPLICATE_NAME = Code("NDDL228", Severity.ERROR, "duplicate", "`{name}` is declared twice")
DUPLICATE_TOKEN = Code("NDDL229", Severity.ERROR, "duplicate", "`{name}` is declared twice")
DUPLICATE_VALUE = Code("NDDL230", Severity.ERROR, "duplicate", "`{name}` is a value of enum `{enum}` already")
MISSING_OBJECT = Code("NDDL231", Severity.ERROR, "name", "outside a rule a token needs its object: `object.{name}`")
THIS_AS_OBJECT = Code("NDDL232", Severity.ERROR, "name", "`this` is the token, not its object")
DUPLICATE_OBJECT = Code("NDDL233", Severity.ERROR, "duplicate", "an object called `{name}` exists already")
UNKNOWN_METHOD = Code("NDDL234", Severity.ERROR, "name", "there is no method `{name}`")
ENUM_OF_THAT_NAME = Code(
    "NDDL235", Severity.WARNING, "duplicate", "`{name}` is an enum already; as a type it means the class from here on"
)
OWN_BASE = Code("NDDL236", Severity.ERROR, "name", "class `{name}` cannot extend itself")
MISSPELT_DECLARATION = Code(
    "NDDL237", Severity.ERROR, "name", "`{name}` is declared and never used; `{used}` is used and not declared"
)
NOT_AN_OBJECT = Code("NDDL301", Severity.ERROR, "type", "`{name}` is {type}, so `.{member}` finds nothing in it")
CLASS_AS_VALUE = Code("NDDL302", Severity.ERROR, "type", "`{name}` is a class, not a value")
MIXED_SET = Code(
    "NDDL303", Severity.ERROR, "type", "the values of a set have one type; `{text}` is {found}, `{first}` is {expected}"
)
DOES_NOT_FIT = Code("NDDL304", Severity.ERROR, "type", "`{text}` is {found}; `{name}` takes {wanted}")
INCOMPARABLE = Code("NDDL305", Severity.ERROR, "type", "`{left}` is {one} and `{right}` is {other}: never equal")
NO_ORDER = Code("NDDL306", Severity.ERROR, "type", "`{op}` compares numbers; `{text}` is {found}")
NOT_A_NUMBER = Code("NDDL307", Severity.ERROR, "type", "`{op}` needs numbers; `{text}` is {found}")
MIXED_ARITHMETIC = Code(
    "NDDL308", Severity.ERROR, "type", "nddl3 does not combine int and float: `{left}` is {one}, `{right}` is {other}"
)
NOT_A_CONDITION = Code("NDDL309", Severity.ERROR, "type", "a condition is needed here; `{text}` is {found}")
SUM_OF_TIMES = Code("NDDL310", Severity.ERROR, "type", "the sum of two times is not a time")
REVERSED_INTERVAL = Code(
    "NDDL311", Severity.ERROR, "domain", "the lower bound {lower} is above the upper bound {upper}"
)
NOT_A_BOUND = Code(
    "NDDL312", Severity.ERROR, "type", "the bounds of an interval are written out as numbers; `{text}` is not one"
)
OUTSIDE_TYPE = Code("NDDL313", Severity.ERROR, "domain", "`{text}` lies outside `{type}`, which is {domain}")
LEAVES_DOMAIN = Code("NDDL314", Severity.ERROR, "domain", "`{text}` is outside the domain of `{name}`, {domain}")
WRONG_COUNT = Code("NDDL320", Severity.ERROR, "arity", "`{name}` takes {expected}, found {found}")
WRONG_ARGUMENT = Code("NDDL321", Severity.ERROR, "type", "`{name}` needs {expected} here; `{text}` is {found}")
ARGUMENTS_DIFFER = Code(
    "NDDL322", Severity.ERROR, "type", "`{name}` compares its arguments; `{text}` is {found}, `{other}` is {expected}"
)
NARROWED_TYPEDEF = Code(
    "NDDL336", Severity.WARNING, "domain", "`{name}` is {found}: `{base}` allows no more than {allowed}"
)
NO_BASE = Code("NDDL335", Severity.ERROR, "arity", "`{name}` extends no class, so `super` has nothing to call")
NO_CONSTRUCTOR = Code("NDDL323", Severity.ERROR, "arity", "class `{name}` has no constructor {arguments}")
NO_BASE_CONSTRUCTOR = Code(
    "NDDL324",
    Severity.ERROR,
    "arity",
    "`{name}` cannot be made: its base `{base}` has no constructor without arguments",
)
MEMBER_VALUE = Code(
    "NDDL325", Severity.ERROR, "type", "the value of a member is written out; `{text}` depends on others"
)
MISSING_SUPER = Code(
    "NDDL326", Severity.ERROR, "arity", "base `{base}` has no constructor without arguments: `super(...)` is needed"
)
ASSIGNED_TWICE = Code("NDDL327", Severity.ERROR, "domain", "`{name}` is {first} already, and cannot become {second}")
NO_OBJECT_PREFIX = Code("NDDL328", Severity.ERROR, "type", "`{name}` is {type}, not an object")
WHOLE_BOUNDS = Code("NDDL329", Severity.ERROR, "type", "the bounds of a relation are whole numbers; `{text}` is not")
NOT_A_COLLECTION = Code("NDDL330", Severity.ERROR, "type", "`foreach` runs over objects; `{text}` is {found}")
NOT_A_VARIABLE = Code("NDDL331", Severity.ERROR, "type", "`{name}` is {what}, not a variable")
WRONG_RECEIVER = Code("NDDL332", Severity.ERROR, "type", "`{name}` is called on {wanted}; `{text}` is {found}")
CLASS_TYPEDEF = Code(
    "NDDL333", Severity.ERROR, "type", "a typedef restricts numbers, texts or an enum; `{name}` is a class"
)
ALWAYS_DIFFERENT = Code(
    "NDDL334", Severity.WARNING, "type", "`{left}` is {one} and `{right}` is {other}: they always differ"
)
SUPER_NOT_FIRST = Code("NDDL401", Severity.ERROR, "rule", "`super(...)` must be the first statement of a constructor")
NOT_A_MEMBER = Code("NDDL402", Severity.ERROR, "rule", "a constructor can assign only members; `{name}` is none")
CLASS_IS_CLOSED = Code("NDDL403", Severity.ERROR, "state", "no object of class `{name}` can join after `close()`")
FOREIGN_TARGET = Code("NDDL404", Severity.ERROR, "rule", "a predicate can restrict only the variables of its own token")
NO_OBJECT_YET = Code("NDDL405", Severity.ERROR, "state", "no object of class `{name}` exists yet to hold this token")
CLOSED_TWICE = Code("NDDL406", Severity.ERROR, "state", "{what} is closed already")
NOT_INACTIVE = Code("NDDL407", Severity.ERROR, "state", "`{name}` cannot be {done}: it is {state}")
MERGE_INACTIVE = Code("NDDL408", Severity.ERROR, "state", "`{name}` is not active, so nothing can be merged into it")
MERGE_OTHER = Code(
    "NDDL409", Severity.ERROR, "state", "`{name}` is a token of `{one}`; only another one of them can stand for it"
)
NOT_REJECTABLE = Code("NDDL410", Severity.ERROR, "state", "`{name}` is a {kind}, which cannot be rejected")
ORDER_INACTIVE = Code("NDDL411", Severity.ERROR, "state", "`{name}` is not active, so it has no place on `{object}`")
EARLY_CLOSE = Code("NDDL412", Severity.ERROR, "state", "`{text}` stands above objects, which can join no more")
