"""What z3 proves of rules: NDDL73x."""

from nddl_lang.text.diagnostic import Code, Severity

IMPOSSIBLE_RULE = Code("NDDL730", Severity.WARNING, "rule", "no token of `{predicate}` can satisfy its rule")
DEAD_BRANCH = Code("NDDL731", Severity.WARNING, "rule", "this branch never runs: {why}")
IMPOSSIBLE_BRANCH = Code("NDDL732", Severity.WARNING, "rule", "when this branch runs, the rule cannot be satisfied")
