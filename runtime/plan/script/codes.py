"""Codes of statements of the script that are not allowed when their turn comes."""

from nddl_lang.text.diagnostic import Code, Severity

OUTSIDE_DOMAIN = Code("NDDL651", Severity.ERROR, "domain", "{value} is not among the values that `{name}` may have")
NO_OBJECT = Code("NDDL652", Severity.ERROR, "state", "there is no object of class `{name}` yet that could hold a token")
WRONG_STATE = Code("NDDL653", Severity.ERROR, "state", "`{name}` is {state} and cannot be {action}")
OTHER_PREDICATE = Code("NDDL654", Severity.ERROR, "state", "`{name}` is a `{predicate}` and `{other}` a `{others}`")
NOT_REJECTABLE = Code("NDDL655", Severity.ERROR, "state", "`{name}` is not rejectable")
CLOSED_CLASS = Code("NDDL656", Severity.ERROR, "state", "class `{name}` is closed: it can have no further objects")
CLOSED_ALREADY = Code("NDDL657", Severity.ERROR, "state", "`{name}` is closed already")
NOT_ONE_OBJECT = Code("NDDL658", Severity.ERROR, "state", "it is not known which object `{name}` is")
SEVERAL_VALUES = Code("NDDL659", Severity.ERROR, "domain", "a single value is needed to specify `{name}`")
WRONG_OBJECT = Code("NDDL660", Severity.ERROR, "domain", "`{name}` cannot be on `{object}`")
ENDLESS_OBJECT = Code(
    "NDDL663", Severity.ERROR, "rule", "an object of class `{name}` cannot be made: its parts have parts without end"
)
NOT_ORDERED = Code("NDDL664", Severity.ERROR, "state", "`{name}` is not ordered before `{other}` on `{object}`")
LOOSE_ITEM = Code("NDDL665", Severity.ERROR, "domain", "a set takes names of variables whose value is known only")
