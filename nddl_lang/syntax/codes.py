"""Name every complaint about the syntax of a text and about its includes."""

from nddl_lang.text.diagnostic import Code, Severity

# ---- characters ----

UNEXPECTED_CHARACTER = Code("NDDL101", Severity.ERROR, "syntax", "`{text}` means nothing in NDDL")
UNCLOSED_STRING = Code("NDDL102", Severity.ERROR, "syntax", "this string has no closing quote")
UNCLOSED_COMMENT = Code("NDDL103", Severity.ERROR, "syntax", "this comment is never closed")
UNKNOWN_ESCAPE = Code("NDDL104", Severity.ERROR, "syntax", "`{text}` is no escape sequence")
MALFORMED_NUMBER = Code("NDDL105", Severity.ERROR, "syntax", "`{text}` is no number")
INTEGER_RANGE = Code("NDDL106", Severity.ERROR, "domain", "`{text}` does not fit in {bits} bits")
UNDECODABLE = Code("NDDL107", Severity.WARNING, "syntax", "these bytes are not UTF-8 text")
NOT_TEXT = Code("NDDL108", Severity.ERROR, "syntax", "this file is no text in UTF-8")
TOO_LARGE = Code("NDDL109", Severity.ERROR, "syntax", "here the model has more than {limit} lexemes, and is not read")

# ---- statements ----

EXPECTED = Code("NDDL110", Severity.ERROR, "syntax", "expected {expected}, found {found}")
MISSING = Code("NDDL111", Severity.ERROR, "syntax", "expected `{text}` {place}")
SUPERFLUOUS = Code("NDDL112", Severity.ERROR, "syntax", "`{text}` does not belong here")
RESERVED_WORD = Code("NDDL113", Severity.ERROR, "syntax", "`{text}` is a reserved word and cannot be a name")
UNCLOSED_BRACE = Code("NDDL114", Severity.ERROR, "syntax", "this `{text}` is never closed")
STRAY_BRACE = Code("NDDL115", Severity.ERROR, "syntax", "this `{text}` closes nothing")
TOO_DEEP = Code("NDDL116", Severity.ERROR, "syntax", "this is nested more than {limit} levels deep")
MISPLACED = Code("NDDL117", Severity.ERROR, "syntax", "{what} cannot stand {where}")
MISPLACED_NEW = Code("NDDL118", Severity.ERROR, "syntax", "`new` cannot stand inside another value")
MISPLACED_METHOD = Code("NDDL119", Severity.ERROR, "syntax", "the method `{name}` gives no value")
MISPLACED_VALUE = Code("NDDL120", Severity.ERROR, "syntax", "{what} cannot stand {where}")
NO_ARGUMENT = Code("NDDL121", Severity.ERROR, "syntax", "the function `{name}` needs an argument")
EQUALITY_SIGN = Code("NDDL123", Severity.ERROR, "syntax", "`=` cannot stand in an expression")
CALL_INITIALISER = Code("NDDL124", Severity.ERROR, "syntax", "`{name}(...)` does not give `{name}` its value")
IN_ASSIGNMENT = Code("NDDL125", Severity.ERROR, "syntax", "a variable is restricted with `=`, not with `in`")
MISSPELT = Code("NDDL126", Severity.ERROR, "syntax", "`{text}` is no word of NDDL")

# ---- what only the dialect nddlc accepts ----

EXPRESSION_VALUE = Code("NDDL150", Severity.ERROR, "syntax", "{where} is a plain value in nddl3, not an expression")
GLUED_SIGN = Code("NDDL151", Severity.ERROR, "syntax", "`{text}` is read as one number in nddl3")
UNARY_OPERATOR = Code("NDDL152", Severity.ERROR, "syntax", "nddl3 has no unary `{text}`")
DIVISION = Code("NDDL153", Severity.ERROR, "syntax", "nddl3 has no operator `/`")
RELATION_BOUNDS = Code("NDDL154", Severity.ERROR, "syntax", "relations have no bounds in nddl3")
MEMBER_INITIALISER = Code("NDDL155", Severity.ERROR, "syntax", "a member cannot be initialised here in nddl3")
COMMENT_AT_END = Code("NDDL156", Severity.ERROR, "syntax", "in nddl3 a `//` comment needs a line end after it")
BYTE_ORDER_MARK = Code("NDDL157", Severity.ERROR, "syntax", "nddl3 knows no byte order mark")
INCLUDE_BLANK = Code("NDDL158", Severity.ERROR, "syntax", "in nddl3 a blank must follow `#include`")
EMPTY_IN_PREDICATE = Code("NDDL159", Severity.ERROR, "syntax", "nddl3 allows no empty statement in a predicate")
VARIABLE_BOUND = Code("NDDL160", Severity.ERROR, "syntax", "the bounds of an interval are plain numbers in nddl3")
EXPRESSION_ARGUMENT = Code("NDDL161", Severity.ERROR, "name", "the arguments of `{name}` are plain values in nddl3")

# ---- earlier dialects ----

FORMER_WORD = Code("NDDL170", Severity.ERROR, "syntax", "`{text}` is no longer part of NDDL")
FORMER_STRING = Code("NDDL171", Severity.ERROR, "syntax", "strings stand in double quotes")
FORMER_NUMBER = Code("NDDL172", Severity.ERROR, "syntax", "numbers are written in decimal, without leading zeros")
FORMER_DIRECTIVE = Code("NDDL173", Severity.ERROR, "syntax", "`{text}` is no directive; there is only `#include`")
FORMER_RELATION = Code("NDDL174", Severity.ERROR, "syntax", "the tokens of a relation stand in `( )`")
FORMER_SIGNATURE = Code("NDDL175", Severity.ERROR, "syntax", "constraints are not declared in NDDL any more")

# These are about one lexeme, whatever becomes of the statement around it.
OF_LEXEMES = frozenset(
    (
        UNEXPECTED_CHARACTER,
        UNCLOSED_STRING,
        UNCLOSED_COMMENT,
        UNKNOWN_ESCAPE,
        MALFORMED_NUMBER,
        INTEGER_RANGE,
        UNDECODABLE,
        COMMENT_AT_END,
        BYTE_ORDER_MARK,
        INCLUDE_BLANK,
        FORMER_STRING,
        FORMER_NUMBER,
        FORMER_DIRECTIVE,
    )
)

# ---- includes ----

MISSING_FILE = Code("NDDL190", Severity.ERROR, "include", "no file `{path}`")
INCLUDE_CYCLE = Code("NDDL191", Severity.ERROR, "include", "`{path}` includes itself")
INCLUDE_AGAIN = Code("NDDL192", Severity.WARNING, "include", "`{path}` includes itself; it is read once")
UNREADABLE_FILE = Code("NDDL193", Severity.ERROR, "include", "`{path}` cannot be read: {reason}")
