"""The pages of what z3 proves of rules."""

from checker.proofs.codes import DEAD_BRANCH, IMPOSSIBLE_BRANCH, IMPOSSIBLE_RULE
from nddl_lang.text.page import RulePage

_HEAD = "class Drone extends Timeline {\n  predicate Fly { int way; }\n  predicate Charge { }\n}\n"
_TAIL = "Drone drone = new Drone();\nclose();\n"

_GUARDS = "Drone::Fly {{\n  if (way > {}) {{ starts(Charge a); }} else {{ if (way > {}) {{ ends(Charge b); }} }}\n}}\n"

PROOF_PAGES = (
    RulePage(
        IMPOSSIBLE_RULE,
        "The lines of a rule, with the constants of the model, contradict each other.",
        "A token of the predicate can be in no plan. `nddlc lint --prove` asks z3, which is told what the lines mean; "
        "the notes are a smallest set of lines without a solution: without any one of them there is one.",
        "int LEG = 60;\n" + _HEAD + "Drone::Fly { way <= 3; duration <= way * LEG; duration >= 200; }\n" + _TAIL,
        "int LEG = 80;\n" + _HEAD + "Drone::Fly { way <= 3; duration <= way * LEG; duration >= 200; }\n" + _TAIL,
    ),
    RulePage(
        DEAD_BRANCH,
        "The condition of a branch contradicts what holds there: lines of the rule, or conditions before it.",
        "The branch is never run. A guard whose condition an earlier one includes is shadowed by it. Conditions on "
        "constants alone are switches, and are not reported.",
        _HEAD
        + "Drone::Fly {\n  if (way > 10) { starts(Charge a); } else { if (way > 20) { ends(Charge b); } }\n}\n"
        + _TAIL,
        _HEAD
        + "Drone::Fly {\n  if (way > 20) { starts(Charge a); } else { if (way > 10) { ends(Charge b); } }\n}\n"
        + _TAIL,
    ),
    RulePage(
        IMPOSSIBLE_BRANCH,
        "The lines of a branch contradict its condition, each other, or what the rule demands in any case.",
        "A token for which the condition holds can be in no plan.",
        _HEAD + "Drone::Fly {\n  duration <= way;\n  if (way < 10) { duration >= 20; }\n}\n" + _TAIL,
        _HEAD + "Drone::Fly {\n  duration <= way;\n  if (way > 30) { duration >= 20; }\n}\n" + _TAIL,
    ),
)
