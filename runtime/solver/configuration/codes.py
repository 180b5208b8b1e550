"""Diagnostic codes of a solver's configuration."""

from nddl_lang.text.diagnostic import Code, Severity

NOT_READABLE = Code("NDDL751", Severity.ERROR, "syntax", "{reason}")
WRONG_ROOT = Code("NDDL752", Severity.ERROR, "syntax", "expected `Solver`, found `{name}`")
UNKNOWN_MANAGER = Code("NDDL753", Severity.ERROR, "name", "no flaw manager is called `{name}`")
UNKNOWN_FILTER = Code("NDDL754", Severity.ERROR, "name", "no filter is called `{name}`")
UNKNOWN_HANDLER = Code("NDDL755", Severity.ERROR, "name", "no handler is called `{name}`")
MISPLACED_HANDLER = Code("NDDL756", Severity.WARNING, "name", "`{name}` does not mend flaws of `{manager}`: left out")
UNKNOWN_ATTRIBUTE = Code("NDDL757", Severity.WARNING, "name", "`{name}` means nothing here and is left out")
UNKNOWN_ELEMENT = Code("NDDL758", Severity.WARNING, "name", "`{name}` means nothing here and is left out")
UNKNOWN_CHOICE = Code("NDDL759", Severity.ERROR, "domain", "`{value}` is no `{name}`; it may be {allowed}")
NOT_A_NUMBER = Code("NDDL760", Severity.ERROR, "domain", "`{name}` must be a number from 0 to {most}")
MISSING_ATTRIBUTE = Code("NDDL761", Severity.ERROR, "arity", "`{element}` needs `{name}`")
EMPTY_VALUES = Code("NDDL762", Severity.ERROR, "arity", "`ValEnum` needs at least one value")
BOTH_LEVELS = Code("NDDL763", Severity.ERROR, "domain", "flaws cannot be ordered by `lower` and by `upper` at once")
FORBIDDEN_DOCTYPE = Code("NDDL764", Severity.ERROR, "syntax", "a document type declaration is not read")
