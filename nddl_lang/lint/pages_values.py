"""The pages of the findings about numbers, draws, the script, and what EUROPA does otherwise."""

from nddl_lang.lint.codes import (
    ARROW,
    BEGINS_OUTSIDE,
    BESIDE_FILE,
    BEYOND_FLOATS,
    CHAINED,
    DRAWN_IN_VAIN,
    DRAWS_OUTSIDE,
    ESCAPE,
    EXACT_TYPES,
    FLOAT_EQUALITY,
    IDLE_FACT,
    INT_AMONG_FLOATS,
    INT_OF_FLOATS,
    INT_RESULT,
    LITERAL_TRUTH,
    NEVER_PLANNED,
    NEVER_VARIED,
    NEVER_WHOLE,
    NO_FILTER,
    NO_MERGE,
    OBJECT_IN_PREDICATE,
    OTHER_METHOD,
    OTHER_RANGE,
    OTHER_RELATION,
    OUTSIDE_HORIZON,
    OVER_CAPACITY,
    OVERLOOKED,
    TRUTH_AS_NUMBER,
    UNCLOSED,
    WHOLE_FLOAT,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { } }\nArm arm = new Arm();\n"
_PLANNED = (
    '#include "PlannerConfig.nddl"\n' + _ARM + "PlannerConfig world = new PlannerConfig(0, 100, 500);\nclose();\n"
)
_GPS = "class Gps extends Timeline { predicate active { int hits; } }\n"
_NDDL3 = "// nddlc: dialect=nddl3\n"

VALUE_PAGES = (
    RulePage(
        OUTSIDE_HORIZON,
        "A goal can only start after the horizon of the model's `PlannerConfig`, or ends before it.",
        "A planner leaves it alone, and the plan is reported as complete.",
        _PLANNED + "goal(arm.grab g);\ng.start = [120 150];\n",
        _PLANNED + "goal(arm.grab g);\ng.start = [20 50];\n",
    ),
    RulePage(
        NEVER_PLANNED,
        "Nothing bounds the time of this goal, and the model sets a horizon.",
        "A token is planned once it must start before the end of the horizon. One that may start at any time is "
        "left alone, and the plan is reported as complete after no step at all.",
        _PLANNED + "goal(arm.grab g);\n",
        _PLANNED + "goal(arm.grab g);\ng.start = [0 90];\n",
    ),
    RulePage(
        NO_MERGE,
        "Two tokens are merged that differ in a variable.",
        "Merging makes them one token, so all of their variables must be able to be equal.",
        _ARM
        + "close();\ngoal(arm.grab g);\ngoal(arm.grab h);\ng.start = 1;\nh.start = 5;\ng.activate();\nh.merge(g);\n",
        _ARM
        + "close();\ngoal(arm.grab g);\ngoal(arm.grab h);\ng.start = 5;\nh.start = 5;\ng.activate();\nh.merge(g);\n",
    ),
    RulePage(
        UNCLOSED,
        "The model has goals, or a mission flies it; it has variables that range over objects, and closes no class. "
        "Without either that is a hint: a mission may fly it.",
        "While further objects may join, no search decides which one is taken.",
        _ARM + "Arm helper;\nhelper != arm;\ngoal(arm.grab g);\n",
        _ARM + "Arm helper;\nhelper != arm;\nclose();\ngoal(arm.grab g);\n",
    ),
    RulePage(
        IDLE_FACT,
        "A fact is neither activated nor merged by the script.",
        "To a planner it is a goal like others, only that no action is looked for which achieves it. Only editors "
        "show this; `--level hint` shows it elsewhere.",
        _ARM + "close();\nfact(arm.grab f);\n",
        _ARM + "close();\nfact(arm.grab f);\nf.activate();\n",
    ),
    RulePage(
        FLOAT_EQUALITY,
        "A condition asks whether a float that was computed equals something.",
        "Floats are rounded, and compared with a tolerance of 1e-5; what decides a branch should not hang on that.",
        _GPS + "Gps::active { float rate = {0.1, 0.3}; if (rate * 3.0 == 0.9) { hits >= 3; } }\n",
        _GPS + "Gps::active { float rate = {0.1, 0.3}; if (rate * 3.0 >= 0.9) { hits >= 3; } }\n",
    ),
    RulePage(
        INT_AMONG_FLOATS,
        "An int variable stands in a product with floats.",
        "A product works in all directions. Drawn back from float to int, 9.9999999 becomes no whole number at all, "
        "and a plan fails for some values and not for others. Copy the int into a float first.",
        _GPS + "Gps::active { float rate = [0.1 4.0]; float span; mulEq(rate, hits, span); span <= 60.0; }\n",
        _GPS + "Gps::active { float rate = [0.1 4.0]; float span; float exact; eq(exact, hits); "
        "mulEq(rate, exact, span); span <= 60.0; }\n",
    ),
    RulePage(
        INT_RESULT,
        "An int is to equal a float that is computed.",
        "That holds only where the result happens to be whole; in all other cases there is no plan.",
        _GPS + "Gps::active { float rate = [0.1 4.0]; duration == rate * 10.0; hits >= 1; }\n",
        _GPS + "Gps::active { float rate = [0.1 4.0]; duration == ceil(rate * 10.0); hits >= 1; }\n",
    ),
    RulePage(
        INT_OF_FLOATS,
        "A local int is to equal a float that is computed, and stands beside floats wherever else it is used.",
        "It holds only where the result happens to be whole. Nothing needs a whole number: it may be a float itself.",
        _GPS + "Gps::active { float rate = [0.1 4.0]; int span; span == rate * 10.0; span <= 60.0; hits >= 1; }\n",
        _GPS + "Gps::active { float rate = [0.1 4.0]; float span; span == rate * 10.0; span <= 60.0; hits >= 1; }\n",
    ),
    RulePage(
        WHOLE_FLOAT,
        "A global or a member of type float gets a value or bounds that are written as ints.",
        "EUROPA makes an int of it: 0.5 is impossible. nddlc makes a float of it; only texts in nddl3 are looked at.",
        _NDDL3 + "float share = [0 1];\nshare <= 0.5;\n",
        _NDDL3 + "float share = [0.0 1.0];\nshare <= 0.5;\n",
    ),
    RulePage(
        CHAINED,
        "A comparison is compared again.",
        "`a < b < c` means `(a < b) < c`, where `a < b` counts as 0 or 1. Written in parentheses it is believed, "
        "unless the truth is to equal a number that is neither, as in `LIMIT == (a > b)`.",
        "int a; int b; int c;\na < b < c;\n",
        "int a; int b; int c;\na < b && b < c;\n",
    ),
    RulePage(
        TRUTH_AS_NUMBER,
        "A bool is compared with 0 or 1.",
        "EUROPA takes both, and so does nddlc: a truth counts as 0 or 1. Only editors show this; `--level hint` shows "
        "it elsewhere.",
        "bool loaded;\nloaded == 1;\n",
        "bool loaded;\nloaded == true;\n",
    ),
    RulePage(
        NEVER_WHOLE,
        "An int is to equal a number with a fraction.",
        "No whole number does, so no token of the rule is ever in a plan.",
        _GPS + "Gps::active { duration == 120.5; hits >= 1; }\n",
        _GPS + "Gps::active { duration == 120; hits >= 1; }\n",
    ),
    RulePage(
        ARROW,
        "`<-` stands where other languages give a value.",
        "NDDL reads it as `<` and the sign of what follows. Written `< -3` or `<-3` it is believed.",
        "int limit;\nlimit <- 3;\n",
        "int limit = 3;\nlimit <= 4;\n",
    ),
    RulePage(
        OVER_CAPACITY,
        "One token takes more of a resource than that ever holds, or brings more than it ever has room for.",
        "No plan can contain the token.",
        "Reusable power = new Reusable(1.0, 0.0);\nclose();\ngoal(power.uses u);\nu.quantity = 2.0;\n",
        "Reusable power = new Reusable(3.0, 0.0);\nclose();\ngoal(power.uses u);\nu.quantity = 2.0;\n",
    ),
    RulePage(
        BEGINS_OUTSIDE,
        "The level of a resource lies outside its own limits before any token takes or brings something.",
        "`Reservoir(initial, min, max)` and `Reusable(capacity, min)` take numbers that are easily swapped. No plan "
        "that uses the resource keeps its limits.",
        "Reservoir tank = new Reservoir(20.0, 120.0, 150.0);\nclose();\ngoal(tank.consume c);\nc.quantity = 2.0;\n",
        "Reservoir tank = new Reservoir(120.0, 20.0, 150.0);\nclose();\ngoal(tank.consume c);\nc.quantity = 2.0;\n",
    ),
    RulePage(
        OVERLOOKED,
        "A function gets more arguments than it takes.",
        "EUROPA drops the rest without a word. In the dialect nddlc this is an error.",
        _NDDL3 + "float a;\na == max(1.0, 2.0, 5.0);\n",
        _NDDL3 + "float a;\neqMaximum(a, 1.0, 2.0, 5.0);\n",
    ),
    RulePage(
        DRAWN_IN_VAIN,
        "A value is drawn into a local variable that nothing else refers to.",
        "The parameter then has no influence on any mission.",
        _GPS + "float RATE = [0.1 4.0];\nGps::active { float rate; rate == sampledParameter(RATE); hits >= 1; }\n",
        _GPS + "float RATE = [0.1 4.0];\nGps::active { float rate; rate == sampledParameter(RATE); hits >= rate; }\n",
    ),
    RulePage(
        DRAWS_OUTSIDE,
        "A sampled parameter has a wider range than the variable that receives the draws.",
        "A mission that draws a value from outside cannot be planned.",
        _GPS + "float RATE = [0.1 4.0];\n"
        "Gps::active { float rate = [0.1 2.0]; rate == sampledParameter(RATE); hits >= rate; }\n",
        _GPS + "float RATE = [0.1 4.0];\n"
        "Gps::active { float rate = [0.1 4.0]; rate == sampledParameter(RATE); hits >= rate; }\n",
    ),
    RulePage(
        NEVER_VARIED,
        "A sampled parameter has a single value in the model.",
        "All missions draw the same, unless the mission file gives it a range.",
        _GPS + "float RATE = 4.0;\nGps::active { float rate; rate == sampledParameter(RATE); hits >= rate; }\n",
        _GPS + "float RATE = [0.1 4.0];\nGps::active { float rate; rate == sampledParameter(RATE); hits >= rate; }\n",
    ),
    RulePage(
        BEYOND_FLOATS,
        "A number of 2^51 (2.25e15) or more is written out.",
        "As in EUROPA, numbers from there on count as infinite: what is compared with one or computed from it knows no "
        "bound.",
        "float distance = [0.0 1e18];\n",
        "float distance = [0.0 inff];\n",
    ),
    RulePage(
        OTHER_RANGE,
        "A sampled parameter without a range in the model is drawn into variables with different ranges.",
        "A value that fits one place need not fit the other. Give the parameter a range of its own.",
        "enum Sampled { RATE, NOISE }\n" + _GPS + "Gps::active { float a = [0.0 1.0]; float b = [0.0 2.0]; "
        "a == sampledParameter(RATE); b == sampledParameter(RATE); a <= b; hits >= 1; }\n",
        "enum Sampled { RATE, NOISE }\n" + _GPS + "Gps::active { float a = [0.0 2.0]; float b = [0.0 2.0]; "
        "a == sampledParameter(RATE); b == sampledParameter(RATE); a <= b; hits >= 1; }\n",
    ),
    RulePage(
        ESCAPE,
        "A string holds an escape sequence such as `\\n`.",
        "It is checked and then kept as it is written: a backslash and a letter.",
        'string s = "a\\n";\ns != "b";\n',
        'string s = "a";\ns != "b";\n',
    ),
    RulePage(
        OTHER_RELATION,
        "EUROPA posts other constraints for this relation than its name says.",
        "`contains_end` demands `origin.end <= target.end` there, instead of the other way round. Only texts in "
        "nddl3 are looked at.",
        _NDDL3 + _ARM + "Arm::grab { contains_end(object.grab); }\n",
        _NDDL3 + _ARM + "Arm::grab { ends_after(object.grab); }\n",
    ),
    RulePage(
        NO_FILTER,
        "The keyword `filter` stands before a variable.",
        "EUROPA reads it and forgets it, and so does nddlc.",
        "filter int x;\nx >= 3;\n",
        "int x;\nx >= 3;\n",
    ),
    RulePage(
        BESIDE_FILE,
        "An included file is found beside the file that includes it, and nowhere else.",
        "EUROPA looks in `nddl.includePath` and in the directory that it is started in. Only texts in nddl3 are "
        "looked at.",
        _NDDL3 + '#include "vehicle.nddl"\n',
        _NDDL3 + '#include "PlannerConfig.nddl"\n',
    ),
    RulePage(
        LITERAL_TRUTH,
        "The truth value of a constraint such as `testEq` is a variable.",
        "EUROPA refuses any but the words `true` and `false` there. Only texts in nddl3 are looked at.",
        _NDDL3 + "bool b;\nint x;\ntestEq(b, x, 3);\n",
        _NDDL3 + "bool b;\nint x;\nb == (x == 3);\n",
    ),
    RulePage(
        EXACT_TYPES,
        "An int is given to a constructor that takes a float.",
        "EUROPA looks for a constructor with exactly these types and finds none. Only texts in nddl3 are looked at.",
        _NDDL3 + "Reusable r = new Reusable(5, 0.0);\n",
        _NDDL3 + "Reusable r = new Reusable(5.0, 0.0);\n",
    ),
    RulePage(
        OBJECT_IN_PREDICATE,
        "The body of a predicate refers to a member of an object.",
        "EUROPA stops as soon as it makes a token of it. In a rule on the predicate it works. Only texts in nddl3 "
        "are looked at.",
        _NDDL3 + "class Arm extends Timeline { int most; predicate grab { int force; force <= object.most; } }\n",
        _NDDL3 + "class Arm extends Timeline { int most; predicate grab { int force; } }\n"
        "Arm::grab { force <= object.most; }\n",
    ),
    RulePage(
        OTHER_METHOD,
        "`set_limit` is called.",
        "EUROPA changes the capacity instead of the limits. Only texts in nddl3 are looked at.",
        _NDDL3 + "Reservoir tank = new Reservoir(5.0, 0.0, 9.0);\ntank.set_limit(3, 0.0, 5.0);\n",
        _NDDL3 + "Reservoir tank = new Reservoir(5.0, 0.0, 9.0);\ntank.set_capacity(3, 0.0, 5.0);\n",
    ),
)
