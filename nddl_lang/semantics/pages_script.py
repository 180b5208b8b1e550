"""The pages of the codes about what is not possible at its place, or in the state that the script has reached."""

from nddl_lang.semantics.codes import (
    CLASS_IS_CLOSED,
    CLOSED_TWICE,
    EARLY_CLOSE,
    FOREIGN_TARGET,
    MERGE_INACTIVE,
    MERGE_OTHER,
    NO_OBJECT_YET,
    NOT_A_MEMBER,
    NOT_INACTIVE,
    NOT_REJECTABLE,
    ORDER_INACTIVE,
    SUPER_NOT_FIRST,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { } predicate release { } }\n"
_GOALS = _ARM + "Arm a = new Arm();\nclose();\ngoal(a.grab g);\ngoal(a.grab h);\n"

SCRIPT_PAGES = (
    RulePage(
        SUPER_NOT_FIRST,
        "`super(...)` is the first statement of a constructor, or is left out.",
        "The base is made before what is added to it. EUROPA crashes on it while it reads the class.",
        "class A { int k; A(int v) { k = v; } }\nclass B extends A { int m; B() { m = 3; super(4); } }\n",
        "class A { int k; A(int v) { k = v; } }\nclass B extends A { int m; B() { super(4); m = 3; } }\n",
    ),
    RulePage(
        NOT_A_MEMBER,
        "A constructor gives values to the members of its object, and to nothing else.",
        "It runs whenever an object is made; variables of the script are assigned in the script.",
        "int count;\nclass Lamp { int w; Lamp() { count = 3; } }\n",
        "int count;\nclass Lamp { int w; Lamp() { w = 3; } }\ncount = 3;\n",
    ),
    RulePage(
        CLASS_IS_CLOSED,
        "The class, or every class, was closed above: no further object can join.",
        "Closing makes the domains of object variables final. EUROPA refuses the object, or accepts it and leaves "
        "it out of those domains.",
        "class Lamp { }\nclose();\nLamp a = new Lamp();\n",
        "class Lamp { }\nLamp a = new Lamp();\nclose();\n",
    ),
    RulePage(
        FOREIGN_TARGET,
        "An assignment in a predicate restricts a parameter or a built-in variable of the token.",
        "It is carried out for every token of the predicate.",
        "int limit;\nclass Arm extends Timeline { predicate grab { limit = 3; } }\n",
        "int limit;\nclass Arm extends Timeline { predicate grab { duration = 3; } }\n",
    ),
    RulePage(
        NO_OBJECT_YET,
        "A token needs an object to stand on, and none of the class exists at this point of the script.",
        "The objects that a token may stand on are those that exist when it is made; later ones do not join.",
        _ARM + "goal(Arm.grab g);\nArm a = new Arm();\n",
        _ARM + "Arm a = new Arm();\ngoal(Arm.grab g);\n",
    ),
    RulePage(
        CLOSED_TWICE,
        "The class, the variable or everything is closed already.",
        "The second time has no effect, and EUROPA refuses it.",
        "close();\nclose();\n",
        "close();\n",
    ),
    RulePage(
        EARLY_CLOSE,
        "A class, or every class, is closed above several objects, or above an object and a second `close()`.",
        "No object joins a class that is closed. One object below is told by NDDL403, where it stands.",
        "class Lamp { }\nclose();\nLamp a = new Lamp();\nLamp b = new Lamp();\n",
        "class Lamp { }\nLamp a = new Lamp();\nLamp b = new Lamp();\nclose();\n",
    ),
    RulePage(
        NOT_INACTIVE,
        "The token is in a state from which this is not possible.",
        "Only an inactive token can be activated, merged or rejected; `cancel` makes it inactive again.",
        _GOALS + "g.activate();\nh.activate();\nh.merge(g);\n",
        _GOALS + "g.activate();\nh.merge(g);\n",
    ),
    RulePage(
        MERGE_INACTIVE,
        "A token can be merged only into an active one.",
        "The active token stands in the plan for both.",
        _GOALS + "h.merge(g);\n",
        _GOALS + "g.activate();\nh.merge(g);\n",
    ),
    RulePage(
        MERGE_OTHER,
        "The two tokens belong to different predicates.",
        "The active token stands for both, so that it must say the same.",
        _GOALS + "goal(a.release r);\ng.activate();\nr.merge(g);\n",
        _GOALS + "goal(a.release r);\ng.activate();\nh.merge(g);\n",
    ),
    RulePage(
        NOT_REJECTABLE,
        "Only a token made by `rejectable(...)` can be left out of the plan.",
        "Goals and facts must be in it, and so must what a relation created.",
        _GOALS + "g.reject();\n",
        _GOALS + "rejectable(a.grab r);\nr.reject();\n",
    ),
    RulePage(
        ORDER_INACTIVE,
        "`constrain` puts active tokens in order.",
        "A token that is not in the plan has no place on the object.",
        _GOALS + "g.activate();\na.constrain(g, h);\n",
        _GOALS + "g.activate();\nh.activate();\na.constrain(g, h);\n",
    ),
)
