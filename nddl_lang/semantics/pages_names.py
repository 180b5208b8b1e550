"""The pages of the codes about names that are not known."""

from nddl_lang.semantics.codes import (
    DECLARED_BELOW,
    MISPLACED_THIS,
    MISSING_OBJECT,
    MISSING_ORIGIN,
    MISSPELT_DECLARATION,
    NAME_OF_OTHER_BLOCK,
    OWN_BASE,
    THIS_AS_OBJECT,
    UNDEFINED_CLASS,
    UNKNOWN_CLASS,
    UNKNOWN_ENUM_VALUE,
    UNKNOWN_MEMBER,
    UNKNOWN_NAME,
    UNKNOWN_PREDICATE,
    UNKNOWN_RELATION,
    UNKNOWN_TOKEN,
    UNKNOWN_TOKEN_VARIABLE,
    UNKNOWN_TYPE,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { int reach; predicate grab { int force; } predicate release { } }\n"
_GOALS = _ARM + "Arm a = new Arm();\nclose();\ngoal(a.grab g);\ngoal(a.release h);\n"

NAME_PAGES = (
    RulePage(
        UNKNOWN_NAME,
        "Neither an enum value nor a local variable, a parameter, a token or a global variable has this name.",
        "Names are looked up in that order. Members of a class are not among them: in a rule or a predicate the "
        "member `k` of the token's object is `object.k`.",
        _ARM + "Arm::grab { force <= reach; }\n",
        _ARM + "Arm::grab { force <= object.reach; }\n",
    ),
    RulePage(
        MISSPELT_DECLARATION,
        "Nothing uses the declared name, and one that is like it is used in its place.",
        "A name that is misspelt where it is declared is unknown wherever it is used: this is told once, at the "
        "declaration. A use that stands alone is told itself, with the declared name as help.",
        "int LIMTI = 3;\n" + _ARM + "Arm::grab { force <= LIMIT; }\nArm::release { duration <= LIMIT; }\n",
        "int LIMIT = 3;\n" + _ARM + "Arm::grab { force <= LIMIT; }\nArm::release { duration <= LIMIT; }\n",
    ),
    RulePage(
        DECLARED_BELOW,
        "The name is declared, but further down.",
        "A model is a script: each statement is executed when it is reached, and knows only what stands above it. "
        "Inside a rule, a predicate and a class it is the same.",
        _ARM + "Arm::grab { force <= LIMIT; }\nint LIMIT = 3;\n",
        "int LIMIT = 3;\n" + _ARM + "Arm::grab { force <= LIMIT; }\n",
    ),
    RulePage(
        NAME_OF_OTHER_BLOCK,
        "The variable or token is declared in a block that has ended.",
        "What one branch of an `if` declares exists only if that branch is carried out, and each round of a `foreach` "
        "has its own. EUROPA finds the mistake only when the rule fires.",
        _ARM + "Arm::grab {\n  if (force == 1) { any(object.release r); }\n  r.start == 1;\n}\n",
        _ARM + "Arm::grab {\n  if (force == 1) { any(object.release r); r.start == 1; }\n}\n",
    ),
    RulePage(
        UNKNOWN_MEMBER,
        "Neither the class of the object nor an ancestor of it declares this member.",
        "A class that is only announced (`class C;`) has no members yet.",
        _ARM + "Arm a = new Arm();\nint r = a.raech;\n",
        _ARM + "Arm a = new Arm();\nint r = a.reach;\n",
    ),
    RulePage(
        UNKNOWN_TOKEN_VARIABLE,
        "A token has the parameters of its predicate and the variables `state`, `object`, `start`, `end` and "
        "`duration`; no other.",
        "Events, such as `consume` of a `Reservoir`, happen at one `time`: they have neither `start` nor `end`.",
        "Reservoir r = new Reservoir(5.0, 0.0, 10.0);\nclose();\ngoal(r.consume c);\nc.start == 5;\n",
        "Reservoir r = new Reservoir(5.0, 0.0, 10.0);\nclose();\ngoal(r.consume c);\nc.time == 5;\n",
    ),
    RulePage(
        UNKNOWN_ENUM_VALUE,
        "The name before the dot is an enum, and it has no value of the name behind the dot.",
        "EUROPA does not look at the name before the dot, so that `Color.sad` would be the value of another enum.",
        "enum Color { red, green }\nenum Mood { glad, sad }\nColor c = Color.sad;\n",
        "enum Color { red, green }\nenum Mood { glad, sad }\nColor c = Color.red;\n",
    ),
    RulePage(
        MISPLACED_THIS,
        "`this` is the token of a rule or predicate, and the object under construction in a constructor.",
        "The script has neither.",
        "int a = 3;\nthis.a == 3;\n",
        "int a = 3;\na == 3;\n",
    ),
    RulePage(
        UNKNOWN_TYPE,
        "A type is `int`, `float`, `bool`, `string`, an enum, a typedef or a class.",
        "It must be declared above; a class may be announced with `class C;`.",
        "class Arm { Tool tool; }\nclass Tool { }\n",
        "class Tool;\nclass Arm { Tool tool; }\nclass Tool { }\n",
    ),
    RulePage(
        UNKNOWN_CLASS,
        "No class of this name is built in or declared above.",
        "Built in are `Object`, `Timeline`, `Reservoir`, `Reusable`, `CBReusable` and `Unary`.",
        "class Lamp { }\nLamp l = new Lmap();\n",
        "class Lamp { }\nLamp l = new Lamp();\n",
    ),
    RulePage(
        UNDEFINED_CLASS,
        "The class has been announced with `class C;`, but its definition does not stand above.",
        "An announced class can be the type of a variable. To extend it or to make an object of it, its members and "
        "constructors must be known. Inside a constructor or a rule it is enough that the definition follows.",
        "class Lamp;\nLamp l = new Lamp();\nclass Lamp { }\n",
        "class Lamp { }\nLamp l = new Lamp();\n",
    ),
    RulePage(
        OWN_BASE,
        "The class names itself as its base.",
        "Name the class whose members and predicates it should have, or leave `extends` out.",
        "class Lamp extends Lamp { }\n",
        "class Lamp { }\n",
    ),
    RulePage(
        UNKNOWN_PREDICATE,
        "Neither the class nor an ancestor of it declares this predicate.",
        "A predicate without an object before it is looked for in the rule's own class; for another class write "
        "`C.p` (any object of the class) or `x.p` (the object that the variable `x` holds).",
        _ARM + "class Leg extends Timeline { predicate step { } }\nArm::grab { meets(step s); }\n",
        _ARM + "class Leg extends Timeline { predicate step { } }\nArm::grab { meets(Leg.step s); }\n",
    ),
    RulePage(
        UNKNOWN_TOKEN,
        "A relation without parentheses leads to a token that exists; none has this name.",
        "With parentheses a new token of the predicate is created: `meets(object.p q)`.",
        _ARM + "Arm::grab { meets release; }\n",
        _ARM + "Arm::grab { meets(release); }\n",
    ),
    RulePage(
        UNKNOWN_RELATION,
        "`equal` can be written where a relation stands, but EUROPA refuses to carry it out.",
        "The relation is called `equals`.",
        _GOALS + "g equal h;\n",
        _GOALS + "g equals h;\n",
    ),
    RulePage(
        MISSING_ORIGIN,
        "A relation in the script needs the token that it starts from.",
        "In a rule the rule's own token is meant where none is written; the script has no such token.",
        _GOALS + "before h;\n",
        _GOALS + "g before h;\n",
    ),
    RulePage(
        MISSING_OBJECT,
        "A token of the script needs an object, or a class if any object of it will do.",
        "In a rule a predicate without an object belongs to the rule's own object; the script has no such object.",
        _ARM + "Arm a = new Arm();\ngoal(grab g);\n",
        _ARM + "Arm a = new Arm();\ngoal(a.grab g);\n",
    ),
    RulePage(
        THIS_AS_OBJECT,
        "`this` is the token; a new token stands on an object.",
        "The object of the rule's token is `object`; without a prefix it is meant too.",
        _ARM + "Arm::grab { meets(this.release r); }\n",
        _ARM + "Arm::grab { meets(object.release r); }\n",
    ),
)
