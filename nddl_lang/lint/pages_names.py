"""The pages of the findings about names: what has no use, and what hides something else."""

from nddl_lang.lint.codes import (
    FREE_PARAMETER,
    HIDDEN_BY_VALUE,
    HIDDEN_GLOBAL,
    HIDDEN_LOCAL,
    HIDDEN_PARAMETER,
    HIDDEN_TOKEN,
    NO_SUCH_CODE,
    UNUSED_FORMAL,
    UNUSED_GLOBAL,
    UNUSED_LABEL,
    UNUSED_LOCAL,
    UNUSED_MEMBER,
    UNUSED_PARAMETER,
    UNUSED_SUPPRESSION,
    UNUSED_TYPE,
    UNUSED_VALUE,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { int force; } predicate release { } }\n"
_WHOLE = (
    " Only what the linted file declares itself is judged, and only if the model is whole: it makes objects, states "
    "goals or closes a class. A file that others include may declare for them."
)

NAME_PAGES = (
    RulePage(
        UNUSED_LOCAL,
        "A rule declares a local variable, or that of a loop, and never refers to it, or only to give it a constant.",
        "It says nothing about the plan; of a class, an enum or a bool it even is a decision that a search has to "
        "take.",
        _ARM + "Arm::grab { int speed; force >= 2; }\n",
        _ARM + "Arm::grab { force >= 2; }\n",
    ),
    RulePage(
        UNUSED_LABEL,
        "A token that a rule asks for has a name that nothing refers to.",
        "The name may be left out. Only editors show this, as faded text; `--level hint` shows it elsewhere.",
        _ARM + "Arm::grab { meets(release r); force >= 2; }\n",
        _ARM + "Arm::grab { meets(release); force >= 2; }\n",
    ),
    RulePage(
        UNUSED_FORMAL,
        "A constructor takes a parameter and never uses it.",
        "Whoever makes an object believes that the value counts.",
        "class Lamp { int watts; Lamp(int w, int hue) { watts = w; } }\n",
        "class Lamp { int watts; Lamp(int w) { watts = w; } }\n",
    ),
    RulePage(
        UNUSED_GLOBAL,
        "Nothing in the model reads this global variable; at most the script gives it a value.",
        "It is left over, or its name is mistyped where it was meant to be used." + _WHOLE,
        _ARM + "int LEAST = 2;\nArm::grab { force >= 2; }\nArm arm = new Arm();\n",
        _ARM + "int LEAST = 2;\nArm::grab { force >= LEAST; }\nArm arm = new Arm();\n",
    ),
    RulePage(
        UNUSED_MEMBER,
        "Nothing reads this member: at most constructors give it a value.",
        "What an object knows counts only where a rule or the script asks for it." + _WHOLE,
        "class Lamp { int watts; Lamp(int w) { watts = w; } }\nLamp lamp = new Lamp(60);\n",
        "class Lamp { int watts; Lamp(int w) { watts = w; } }\nLamp lamp = new Lamp(60);\nlamp.watts <= 100;\n",
    ),
    RulePage(
        UNUSED_VALUE,
        "Other values of the enum are named in the model, this one is not.",
        "A search may still choose it. Only editors show this; `--level hint` shows it elsewhere." + _WHOLE,
        "enum Color { red, green, blue }\nColor c;\nColor d = red;\nc != green;\nc != d;\nclose();\n",
        "enum Color { red, green }\nColor c;\nColor d = red;\nc != green;\nc != d;\nclose();\n",
    ),
    RulePage(
        UNUSED_TYPE,
        "Nothing has this type.",
        "It is left over, or a variable has another type than it should have." + _WHOLE,
        "typedef int [0 100] Percent;\nint level;\nlevel >= 3;\nclose();\n",
        "typedef int [0 100] Percent;\nPercent level;\nlevel >= 3;\nclose();\n",
    ),
    RulePage(
        FREE_PARAMETER,
        "No rule, predicate or goal says anything about this parameter, and its values are without end.",
        "No search decides it: it stays open in every plan." + _WHOLE + " Parameters of an `AgentTimeline` are left "
        "out: they come with the tokens of other reactors.",
        _ARM + "Arm arm = new Arm();\nclose();\ngoal(arm.grab g);\ngoal(arm.release r);\n",
        _ARM + "Arm::grab { force >= 2; }\nArm arm = new Arm();\nclose();\ngoal(arm.grab g);\ngoal(arm.release r);\n",
    ),
    RulePage(
        UNUSED_PARAMETER,
        "No rule, predicate or goal refers to this parameter.",
        "A search has to choose a value for it, and nothing depends on that." + _WHOLE,
        "class Arm extends Timeline { predicate grab { bool gently; } }\n"
        "Arm arm = new Arm();\nclose();\ngoal(arm.grab g);\n",
        "class Arm extends Timeline { predicate grab { bool gently; } }\n"
        "Arm arm = new Arm();\nclose();\ngoal(arm.grab g);\ng.gently = true;\n",
    ),
    RulePage(
        HIDDEN_PARAMETER,
        "A local variable of a rule has the name of a parameter of its token.",
        "From here on the name means the local, and the parameter stays free. To restrict the parameter, compare it.",
        _ARM + "Arm::grab { int force = 3; force >= 2; }\n",
        _ARM + "Arm::grab { force == 3; }\n",
    ),
    RulePage(
        HIDDEN_LOCAL,
        "A local variable or the variable of a `foreach` has the name of one that is visible here.",
        "The later one counts, also where the first was meant.",
        _ARM + "Arm::grab { int least = 2; if (force == 5) { int least = 4; duration >= least; } force >= least; }\n",
        _ARM + "Arm::grab { int least = 2; if (force == 5) { int longer = 4; duration >= longer; } force >= least; }\n",
    ),
    RulePage(
        HIDDEN_BY_VALUE,
        "A parameter, a variable or a token's variable is called like a value of an enum.",
        "Such a name always means the value: the variable can never be read.",
        "enum Color { red, green }\nclass Lamp extends Timeline { predicate lit { int red; } }\n",
        "enum Color { red, green }\nclass Lamp extends Timeline { predicate lit { int redness; } }\n",
    ),
    RulePage(
        HIDDEN_GLOBAL,
        "A local variable of a rule has the name of a global one.",
        "In the rest of the rule the name means the local.",
        _ARM + "int least = 2;\nArm::grab { int least = 3; force >= least; }\n",
        _ARM + "int least = 2;\nArm::grab { int enough = 3; force >= enough; }\n",
    ),
    RulePage(
        HIDDEN_TOKEN,
        "A rule gives two of its tokens the same name.",
        "The later one counts from here on; before, the first did.",
        _ARM + "Arm::grab { met_by(release r); r.duration >= 2; meets(release r); r.duration >= 3; force >= 2; }\n",
        _ARM + "Arm::grab { met_by(release r); r.duration >= 2; meets(release s); s.duration >= 3; force >= 2; }\n",
    ),
    RulePage(
        UNUSED_SUPPRESSION,
        "A comment asks to ignore a finding that is not there.",
        "What it hid is mended, or the code is another one; left in place it would hide a later finding.",
        "int a = 3;\na >= 2; // nddlc: ignore NDDL554\n",
        "int a = 3;\na >= 2;\n",
    ),
    RulePage(
        NO_SUCH_CODE,
        "A comment asks to ignore a code that cannot be one.",
        "A code is `NDDL` and three digits; a shorter one stands for all that begin so.",
        "int a = 3;\na >= 2; // nddlc: ignore NDDL55x\n",
        "int a = 3;\na >= 2;\n",
    ),
)
