"""Codes of the lints, and of the settings that choose among them."""

from nddl_lang.text.diagnostic import Code, Severity

UNUSED_LOCAL = Code("NDDL501", Severity.WARNING, "lint", "the local variable `{name}` is never {done}")
UNUSED_LABEL = Code("NDDL502", Severity.HINT, "lint", "the token `{name}` is never referred to")
UNUSED_FORMAL = Code("NDDL503", Severity.WARNING, "lint", "the constructor does not use its parameter `{name}`")
UNUSED_GLOBAL = Code("NDDL504", Severity.WARNING, "lint", "the global variable `{name}` is never {done}")
UNUSED_MEMBER = Code("NDDL505", Severity.INFO, "lint", "the member `{name}` of class `{owner}` is never {done}")
UNUSED_VALUE = Code("NDDL506", Severity.HINT, "lint", "the value `{name}` of enum `{enum}` is never used")
UNUSED_TYPE = Code("NDDL507", Severity.INFO, "lint", "the {what} `{name}` is never used")
FREE_PARAMETER = Code("NDDL508", Severity.WARNING, "lint", "nothing ever says what `{name}` of `{predicate}` is")
UNUSED_PARAMETER = Code("NDDL509", Severity.INFO, "lint", "the parameter `{name}` of `{predicate}` is never used")
HIDDEN_PARAMETER = Code("NDDL510", Severity.WARNING, "lint", "this `{name}` hides the parameter `{name}` of the token")
HIDDEN_LOCAL = Code("NDDL511", Severity.WARNING, "lint", "this `{name}` hides the one declared before it")
HIDDEN_BY_VALUE = Code(
    "NDDL512", Severity.WARNING, "lint", "`{name}` is a value of enum `{enum}`, and means that value"
)
HIDDEN_GLOBAL = Code("NDDL513", Severity.INFO, "lint", "this `{name}` hides the global variable `{name}`")
HIDDEN_TOKEN = Code("NDDL514", Severity.INFO, "lint", "another token is called `{name}` already; this one counts now")
NEVER_TRUE = Code("NDDL520", Severity.WARNING, "lint", "this condition can never hold")
ALWAYS_TRUE = Code("NDDL521", Severity.WARNING, "lint", "this condition always holds")
SEVERAL_VALUES = Code("NDDL522", Severity.WARNING, "lint", "a comparison with several values is never decided")
NEVER_DECIDED = Code("NDDL523", Severity.WARNING, "lint", "`{name}` is only ever narrowed: this waits for a search")
VARYING_FIELD = Code("NDDL524", Severity.WARNING, "lint", "EUROPA does not decide this while `{name}` may be several")
CONTRADICTION = Code("NDDL530", Severity.WARNING, "lint", "what is demanded here cannot all hold")
TOO_LONG = Code("NDDL531", Severity.WARNING, "lint", "a token lasts longer here than the one that contains it")
NO_DURATION = Code("NDDL532", Severity.WARNING, "lint", "a token lasts at least 1, so this cannot hold")
OUTSIDE_HORIZON = Code("NDDL533", Severity.WARNING, "lint", "`{name}` lies outside the horizon, {horizon}")
NEVER_PLANNED = Code("NDDL534", Severity.WARNING, "lint", "`{name}` has no bound on its time, so it is never planned")
NO_MERGE = Code("NDDL535", Severity.WARNING, "lint", "`{name}` and `{other}` cannot be one token: `{variable}` differs")
OVERLAP = Code("NDDL536", Severity.WARNING, "lint", "{name} and {other} overlap, as tokens of a timeline never do")
UNREACHABLE = Code("NDDL540", Severity.WARNING, "lint", "no goal leads to {what}")
NEVER_FIRES = Code("NDDL541", Severity.WARNING, "lint", "no token of `{name}` is ever made, so this rule never runs")
ENDLESS = Code("NDDL542", Severity.WARNING, "lint", "each `{name}` asks for another one, without an end")
ANY_OBJECT = Code("NDDL543", Severity.WARNING, "lint", "`{text}` may stand on any object of class `{owner}`")
ANY_OF_MANY = Code("NDDL544", Severity.INFO, "lint", "`any` says nothing about when this `{name}` holds")
NO_EFFECT = Code("NDDL545", Severity.WARNING, "lint", "the action `{name}` has no effect, so no goal is achieved by it")
UNCLOSED = Code("NDDL546", Severity.WARNING, "lint", "no class is closed, so no object is ever chosen")
CHAIN = Code("NDDL547", Severity.HINT, "lint", "each `{name}` asks for a later one: the chain ends at the horizon")
IDLE_FACT = Code("NDDL548", Severity.HINT, "lint", "a fact is a goal like others until it is activated")
FLOAT_EQUALITY = Code("NDDL550", Severity.WARNING, "lint", "`{op}` compares a computed float")
INT_AMONG_FLOATS = Code(
    "NDDL551", Severity.WARNING, "lint", "`{name}` is an int, and `{constraint}` rounds it against floats"
)
INT_RESULT = Code("NDDL552", Severity.WARNING, "lint", "`{name}` is an int: this holds only where the float is whole")
WHOLE_FLOAT = Code("NDDL553", Severity.WARNING, "lint", "EUROPA lets `{name}` take whole numbers only")
CHAINED = Code("NDDL554", Severity.WARNING, "lint", "`{op}` compares the truth of `{text}`")
NEVER_WHOLE = Code("NDDL555", Severity.WARNING, "lint", "`{name}` is an int, and never {value}")
ARROW = Code("NDDL556", Severity.WARNING, "lint", "`{text}` compares: `<-` is `<` and `-`")
INT_OF_FLOATS = Code("NDDL558", Severity.WARNING, "lint", "`{name}` is an int, and used with floats alone")
TRUTH_AS_NUMBER = Code("NDDL557", Severity.HINT, "lint", "`{name}` is a bool: {value} stands for `{truth}`")
OVER_CAPACITY = Code(
    "NDDL560", Severity.WARNING, "lint", "`{name}` {moves} {demand} {way} `{resource}`, which {has} {capacity}"
)
OVERLOOKED = Code("NDDL561", Severity.WARNING, "lint", "EUROPA overlooks what follows the first {count} of `{name}`")
DRAWN_IN_VAIN = Code("NDDL562", Severity.WARNING, "lint", "what is drawn for `{name}` is never used")
DRAWS_OUTSIDE = Code(
    "NDDL563", Severity.WARNING, "lint", "`{name}` is drawn from {range}, but {receiver} takes {domain}"
)
NEVER_VARIED = Code("NDDL564", Severity.WARNING, "lint", "the sampled parameter `{name}` has one value only, {value}")
OTHER_RANGE = Code(
    "NDDL565", Severity.WARNING, "lint", "`{name}` is drawn into {domain} here, and into {other} elsewhere"
)
BEYOND_FLOATS = Code("NDDL566", Severity.WARNING, "lint", "`{text}` counts as infinite: floats end at 2.25e15")
BEGINS_OUTSIDE = Code("NDDL567", Severity.WARNING, "lint", "`{resource}` has {first} at first, {what}, {limit}")
ESCAPE = Code("NDDL570", Severity.INFO, "lint", "`{text}` is two characters, not one: escapes are not decoded")
OTHER_RELATION = Code("NDDL571", Severity.INFO, "lint", "EUROPA understands `{name}` otherwise")
NO_FILTER = Code("NDDL572", Severity.INFO, "lint", "`filter` has no effect")
BESIDE_FILE = Code("NDDL573", Severity.INFO, "lint", "EUROPA does not look beside this file for `{path}`")
LITERAL_TRUTH = Code(
    "NDDL574", Severity.WARNING, "lint", "EUROPA takes only `true` or `false` as the truth of `{name}`"
)
EXACT_TYPES = Code(
    "NDDL575", Severity.WARNING, "lint", "EUROPA finds no constructor of `{name}` that takes {found} here"
)
OBJECT_IN_PREDICATE = Code("NDDL576", Severity.WARNING, "lint", "EUROPA stops when a token of `{name}` is made")
OTHER_METHOD = Code("NDDL577", Severity.WARNING, "lint", "EUROPA does something else for `{name}`")
UNUSED_SUPPRESSION = Code("NDDL590", Severity.WARNING, "lint", "there is nothing{what} to ignore here")
NO_SUCH_CODE = Code("NDDL591", Severity.WARNING, "lint", "`{text}` is no code of a finding")
UNUSABLE_MODULE = Code("NDDL594", Severity.ERROR, "name", "the project's Python cannot be used: {reason}")
NOT_TOML = Code("NDDL595", Severity.ERROR, "syntax", "this is not TOML: {reason}")
UNKNOWN_KEY = Code("NDDL596", Severity.ERROR, "name", "there is no setting `{key}`")
WRONG_VALUE = Code("NDDL597", Severity.ERROR, "type", "`{key}` must be {wanted}")
UNREAD_MODULE = Code(
    "NDDL598", Severity.WARNING, "name", "what `{path}` adds cannot be read without running it: {reason}"
)
NOT_TRUSTED = Code("NDDL599", Severity.ERROR, "include", "`{path}` is not run: {reason}")
