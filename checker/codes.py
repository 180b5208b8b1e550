"""The complaints about mission files: NDDL7xx."""

from nddl_lang.text.diagnostic import Code, Severity

NOT_TOML = Code("NDDL701", Severity.ERROR, "syntax", "this is not TOML: {reason}")
UNKNOWN_KEY = Code("NDDL702", Severity.ERROR, "name", "no key `{key}` in {table}")
MISSING_KEY = Code("NDDL703", Severity.ERROR, "name", "{table} needs the key `{key}`")
WRONG_TYPE = Code("NDDL704", Severity.ERROR, "type", "`{key}` must be {wanted}, not {found}")
OUT_OF_RANGE = Code("NDDL705", Severity.ERROR, "domain", "`{key}` must be {wanted}, not {found}")
REVERSED = Code("NDDL706", Severity.ERROR, "domain", "`{key}` runs backwards: {lower} is above {upper}")
UNKNOWN_CHOICE = Code("NDDL707", Severity.ERROR, "name", "`{key}` cannot be `{found}`; it is one of {choices}")
NO_FILE = Code("NDDL708", Severity.ERROR, "include", "there is no file `{path}`")
TWICE = Code("NDDL709", Severity.ERROR, "duplicate", "{what} `{name}` is there twice")
NO_OWNER = Code("NDDL710", Severity.ERROR, "name", "no reactor owns the timeline `{timeline}`")
CYCLE = Code("NDDL711", Severity.ERROR, "rule", "the reactors use each other in a cycle: {cycle}")
# A warning, as T-REX refuses such a goal and flies on.
NO_GOALS = Code(
    "NDDL712", Severity.WARNING, "rule", "`{timeline}` takes no goals: its owner `{reactor}` has a lookahead of 0"
)
ILL_DISTRIBUTION = Code("NDDL713", Severity.ERROR, "domain", "{reason}")
UNUSED_PARAMETER = Code("NDDL714", Severity.ERROR, "name", "no model samples a parameter `{name}`")
NO_RANGE = Code("NDDL715", Severity.ERROR, "domain", "the parameter `{name}` has no range, here or in the model")
NO_TIMELINE = Code("NDDL716", Severity.ERROR, "name", "the model `{model}` has no object `{timeline}`")
NO_PREDICATE = Code("NDDL717", Severity.ERROR, "name", "`{class_name}` has no predicate `{predicate}`")
NO_ARGUMENT = Code("NDDL718", Severity.ERROR, "name", "`{predicate}` has no parameter `{name}`")
ILL_VALUE = Code("NDDL719", Severity.ERROR, "type", "`{name}` of `{predicate}` must be {wanted}, not {found}")
# A warning: who writes such a goal may want to see what becomes of it.
OUT_OF_TIME = Code("NDDL720", Severity.WARNING, "domain", "this goal can never be achieved: {reason}")
OTHER_ROLE = Code(
    "NDDL721", Severity.ERROR, "rule", "`{timeline}` is {listed} here, and `{mode}` in the model `{model}`"
)
UNLISTED = Code(
    "NDDL722",
    Severity.WARNING,
    "rule",
    "`{timeline}` is `{mode}` in the model `{model}`, and not listed here",
)
NO_DEFAULT = Code(
    "NDDL723", Severity.ERROR, "name", "`{timeline}` falls back to `{predicate}`, which `{class_name}` does not have"
)
NO_TEXT_FILE = Code("NDDL724", Severity.ERROR, "include", "`{path}` is {what}, not a file")
ILL_BATCH = Code("NDDL725", Severity.ERROR, "syntax", "this is no batch file: {reason}")
UNKNOWN_ELEMENT = Code("NDDL726", Severity.ERROR, "name", "no element `{tag}` in {parent}")
NO_EFFECT = Code("NDDL727", Severity.WARNING, "name", "`{what}` has no effect here")
NO_RESOURCE = Code("NDDL728", Severity.ERROR, "name", "no model has a resource `{name}`")
NO_REACTOR = Code("NDDL729", Severity.ERROR, "name", "there is no reactor `{name}`")
NO_THREATS = Code(
    "NDDL733", Severity.WARNING, "rule", "nothing orders the uses of `{resource}` in the plans of `{reactor}`"
)
NO_CLASS = Code("NDDL736", Severity.ERROR, "name", "{where} has no class `{name}`")
NO_LOG = Code("NDDL737", Severity.ERROR, "rule", "`{path}` cannot be played: {problem}")
NO_MATCH = Code("NDDL738", Severity.WARNING, "name", "no model that is planned with this file has a {what} `{name}`")
RESOURCES_FIRST = Code(
    "NDDL739", Severity.INFO, "rule", "uses of resources are ordered before {what}: such a search may have no end"
)
BEYOND_MODEL = Code("NDDL740", Severity.WARNING, "domain", "`{name}` is drawn {reason}")
OTHER_NUMBER = Code(
    "NDDL741",
    Severity.WARNING,
    "domain",
    "`{timeline}` is made with {mine} here, and by its owner `{owner}` with {theirs}",
)
NO_REQUESTS = Code(
    "NDDL734", Severity.WARNING, "rule", "`{timeline}` takes no requests: its owner `{owner}` has a lookahead of 0"
)
SINGLE_LEVEL = Code(
    "NDDL735", Severity.WARNING, "rule", "the level of `{resource}` would have to be {level} at all times"
)
