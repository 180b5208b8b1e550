"""The pages of the findings about rules: conditions, times, and what asks for what."""

from nddl_lang.lint.codes import (
    ALWAYS_TRUE,
    ANY_OBJECT,
    ANY_OF_MANY,
    CHAIN,
    CONTRADICTION,
    ENDLESS,
    NEVER_DECIDED,
    NEVER_FIRES,
    NEVER_TRUE,
    NO_DURATION,
    NO_EFFECT,
    OVERLAP,
    SEVERAL_VALUES,
    TOO_LONG,
    UNREACHABLE,
    VARYING_FIELD,
)
from nddl_lang.text.page import RulePage

_GAUGE = "class Gauge extends Timeline { predicate shown { int level = [0 3]; } predicate dark { } }\n"
_TWO = _GAUGE + "class Lamp extends Timeline { predicate on { } }\n"
_SCRIPT = "Gauge gauge = new Gauge();\nclose();\ngoal(gauge.shown g);\ng.level = 2;\n"

RULE_LINT_PAGES = (
    RulePage(
        NEVER_TRUE,
        "For none of the values that its variables can have, the condition holds: the branch is dead.",
        "What is looked at are declarations, the comparisons beside it in the rule, and the conditions around it.",
        _GAUGE + "Gauge::shown { if (level == 7) { meets(dark); } }\n",
        _GAUGE + "Gauge::shown { if (level == 3) { meets(dark); } }\n",
    ),
    RulePage(
        ALWAYS_TRUE,
        "For all values that its variables can have, the condition holds: the `else` is dead, the `if` needless.",
        "The last condition of a chain of `else if` is not complained about, where it only spells out the rest.",
        _GAUGE + "Gauge::shown { if (level <= 5) { meets(dark); } }\n",
        _GAUGE + "Gauge::shown { if (level <= 2) { meets(dark); } }\n",
    ),
    RulePage(
        SEVERAL_VALUES,
        "A condition compares with an interval or a set of several values.",
        "Such a value is no single one, so the comparison is never decided and neither branch ever runs.",
        _GAUGE + "Gauge::shown { if (level == [1 2]) { meets(dark); } }\n",
        _GAUGE + "Gauge::shown { if (level >= 1 && level <= 2) { meets(dark); } }\n",
    ),
    RulePage(
        NEVER_DECIDED,
        "A condition asks for a local number that is only narrowed by constraints.",
        "A condition waits until each of its variables is decided. That constraints leave a single value does not "
        "count: a search decides the variable, and only once finitely many values are left. So what stands in the "
        "condition comes late, and never where nothing bounds the variable.",
        _GAUGE + "Gauge::shown { int twice; twice == level * 2; if (twice == 4) { meets(dark); } }\n",
        _GAUGE + "Gauge::shown { if (level == 2) { meets(dark); } }\n",
    ),
    RulePage(
        VARYING_FIELD,
        "A condition asks for a member of an object while it may be one of several that differ in it.",
        "EUROPA looks at the member once, when the rule starts. nddlc decides it as soon as the object is decided.",
        "// nddlc: dialect=nddl3\nclass Lamp extends Timeline { int kind; Lamp(int k) { kind = k; } predicate lit { } "
        "predicate dark { } }\nLamp::lit { if (object.kind == 1) { meets(dark); } }\n"
        "Lamp a = new Lamp(1);\nLamp b = new Lamp(2);\n",
        "// nddlc: dialect=nddl3\nclass Lamp extends Timeline { int kind; Lamp(int k) { kind = k; } predicate lit { } "
        "predicate dark { } }\nLamp::lit { if (object.kind == 1) { meets(dark); } }\n"
        "Lamp a = new Lamp(1);\nLamp b = new Lamp(1);\n",
    ),
    RulePage(
        CONTRADICTION,
        "Relations, durations and comparisons of times exclude each other: in one rule or one branch of it, in a rule "
        "and those that fire before it for the same token, or in the script.",
        "Each is a bound on the distance of two times, or of a time and an int variable; the ones that are listed form "
        "a cycle whose bounds sum to less than 0. A token of the predicate can never be part of a plan in which "
        "the branch holds. A global constant counts with its value. A script that resets, cancels or frees something "
        "is not judged, nor are its rejectable tokens.",
        _GAUGE + "Gauge::shown { meets(dark d); met_by(dark e); d before e; level >= 1; }\n",
        _GAUGE + "Gauge::shown { meets(dark d); met_by(dark e); e before d; level >= 1; }\n",
    ),
    RulePage(
        TOO_LONG,
        "A token must lie within another one that is shorter.",
        "Both durations are bounded in the rule or in the declarations, and the bounds do not fit.",
        _TWO + "Gauge::shown { contains(Lamp.on d); duration <= 5; d.duration >= 9; level >= 1; }\n",
        _TWO + "Gauge::shown { contains(Lamp.on d); duration <= 9; d.duration >= 5; level >= 1; }\n",
    ),
    RulePage(
        NO_DURATION,
        "A token is to last no time at all.",
        "Every token but the events of a `Reservoir` lasts at least 1.",
        _GAUGE + "Gauge::shown { duration == 0; level >= 1; }\n",
        _GAUGE + "Gauge::shown { duration == 1; level >= 1; }\n",
    ),
    RulePage(
        OVERLAP,
        "A rule asks for two tokens of other predicates on one timeline, at times that overlap.",
        "Tokens of a timeline never overlap, so the rule can never hold. What must go on at once stands on several "
        "timelines, or is a parameter of one token. A token on any object of the class is judged where the model makes "
        "one object only.",
        _GAUGE + "Gauge::shown { contains(object.dark); level >= 1; }\n",
        _GAUGE + "Gauge::shown { meets(object.dark); level >= 1; }\n",
    ),
    RulePage(
        UNREACHABLE,
        "No goal or fact of the script asks for a token of this predicate, neither do the rules that they lead to.",
        "The predicate is dead, or a goal or a subgoal is missing. Rules go by the class that a token is made with. "
        "Only predicates of the linted file are judged, in a model with goals; those of an `AgentTimeline` count as "
        "reached, since other reactors make tokens of them.",
        _GAUGE + "Gauge::shown { level >= 1; }\n" + _SCRIPT,
        _GAUGE + "Gauge::shown { level >= 1; meets(dark); }\n" + _SCRIPT,
    ),
    RulePage(
        NEVER_FIRES,
        "Tokens of this predicate are only made as those of another class, so the rule never runs.",
        "A rule goes by the class that a token is made with, `Base.p` or `Sub.p`, not by the object that it stands "
        "on in the end.",
        _GAUGE + "class Dial extends Gauge { }\nGauge::shown { meets(dark); level >= 1; }\n"
        "Dial::shown { level >= 2; }\n" + _SCRIPT,
        _GAUGE + "class Dial extends Gauge { }\nGauge::shown { meets(dark); level >= 1; }\n"
        "Dial::shown { level >= 2; }\nDial dial = new Dial();\n" + _SCRIPT + "goal(dial.shown h);\n",
    ),
    RulePage(
        ENDLESS,
        "Each token of this predicate asks for another one that differs from it, and none of them comes later.",
        "The chain never ends: tokens that differ cannot be merged, and time does not run out. Put a condition "
        "around the subgoal.",
        "class Step extends Timeline { predicate at { int n; } }\n"
        "Step::at { any(object.at q); q.n == n - 1; }\nStep s = new Step();\nclose();\n",
        "class Step extends Timeline { predicate at { int n; } }\n"
        "Step::at { if (n > 0) { any(object.at q); q.n == n - 1; } }\nStep s = new Step();\nclose();\n",
    ),
    RulePage(
        CHAIN,
        "Each token of this predicate asks for a later one of the same.",
        "The chain ends only at the horizon, which is often meant so. Only editors show this; `--level hint` shows "
        "it elsewhere.",
        _GAUGE + "Gauge::shown { meets(dark); level >= 1; }\nGauge::dark { meets(shown); }\n" + _SCRIPT,
        _GAUGE + "Gauge::shown { meets(dark); level >= 1; }\n" + _SCRIPT,
    ),
    RulePage(
        ANY_OBJECT,
        "A rule asks for a token of its own class by the name of the class.",
        "Any object of the class may then hold the token, not only the rule's own. Usually `object.p` is meant; "
        "where another object is, say which.",
        _GAUGE + "Gauge::shown { meets(Gauge.dark); level >= 1; }\n",
        _GAUGE + "Gauge::shown { meets(object.dark); level >= 1; }\n",
    ),
    RulePage(
        ANY_OF_MANY,
        "`any` relates a token without a name, of a predicate that unrelated classes have.",
        "It demands that such a token exists at some time, nothing else; often it is left from looking for a fault.",
        _GAUGE + "class Lamp extends Timeline { predicate dark { } }\nGauge::shown { any(object.dark); level >= 1; }\n",
        _GAUGE + "class Lamp extends Timeline { predicate dark { } }\n"
        "Gauge::shown { before(object.dark); level >= 1; }\n",
    ),
    RulePage(
        NO_EFFECT,
        "No rule on this action marks a token as its effect.",
        "A goal that needs an action is achieved by one of its effects. Without any, the action is a plain predicate.",
        "class Arm extends Timeline { predicate held { } action grab { } }\n"
        "Arm::grab { meets(object.held); }\nArm arm = new Arm();\nclose();\n",
        "class Arm extends Timeline { predicate held { } action grab { } }\n"
        "Arm::grab { meets(effect object.held); }\nArm arm = new Arm();\nclose();\n",
    ),
)
