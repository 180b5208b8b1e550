"""The pages of the codes about constraints, functions, constructors and methods."""

from nddl_lang.semantics.codes import (
    ARGUMENTS_DIFFER,
    FORMER_CONSTRAINT,
    MISSING_SUPER,
    NO_BASE,
    NO_BASE_CONSTRUCTOR,
    NO_CONSTRUCTOR,
    NOT_IN_NDDL3,
    UNKNOWN_CONSTRAINT,
    UNKNOWN_FUNCTION,
    UNKNOWN_METHOD,
    WHOLE_BOUNDS,
    WRONG_ARGUMENT,
    WRONG_COUNT,
    WRONG_RECEIVER,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { } predicate release { } }\n"
_GOAL = _ARM + "Arm a = new Arm();\nclose();\ngoal(a.grab g);\n"
_LAMP = "class Lamp { int watts; Lamp(int w) { watts = w; } }\n"

CALL_PAGES = (
    RulePage(
        UNKNOWN_CONSTRAINT,
        "No constraint has this name.",
        "A name followed by arguments is, as a statement, one of the named constraints. One of your own is in a Python "
        "file that `modules` of `[constraints]` names: in nddlc.toml for what reads models, in the mission file for "
        "what flies them.",
        "int a;\nadEq(a, 3, 5);\n",
        "int a;\naddEq(a, 3, 5);\n",
    ),
    RulePage(
        UNKNOWN_FUNCTION,
        "No function has this name.",
        "Constraints are no functions: they are statements and give no value.",
        "bool b;\nb == eq(1, 1);\n",
        "bool b;\nb == (1 == 1);\n",
    ),
    RulePage(
        FORMER_CONSTRAINT,
        "The constraint has another name today.",
        "EUROPA renamed its constraints in February 2015 and refuses the old names.",
        "int a;\ntestEQ(true, a, 3);\n",
        "int a;\ntestEq(true, a, 3);\n",
    ),
    RulePage(
        NOT_IN_NDDL3,
        "The function or constraint belongs to the dialect nddlc.",
        "EUROPA does not know it, so that a model in the dialect nddl3 cannot use it.",
        "// nddlc: dialect=nddl3\nfloat WIND;\nfloat w;\nw == sampledParameter(WIND);\n",
        "// nddlc: dialect=nddlc\nfloat WIND;\nfloat w;\nw == sampledParameter(WIND);\n",
    ),
    RulePage(
        WRONG_COUNT,
        "The call has too many or too few arguments.",
        "EUROPA overlooks superfluous arguments of functions; in the dialect nddl3 so do we.",
        "int a;\neq(a);\n",
        "int a;\neq(a, 3);\n",
    ),
    RulePage(
        WRONG_ARGUMENT,
        "An argument is of a type that cannot stand in its place.",
        "What each constraint, function and method takes is listed in the tables of the language guide.",
        "string s;\nstring t;\nlt(s, t);\n",
        "int s;\nint t;\nlt(s, t);\n",
    ),
    RulePage(
        ARGUMENTS_DIFFER,
        "The constraint compares its arguments, and these can never be equal.",
        "Numbers and truth values can be compared, enum values with those of the same enum, texts with texts, "
        "objects with objects of the same class or a subclass.",
        'string s = "a";\nint a;\neq(a, s);\n',
        "int s = 3;\nint a;\neq(a, s);\n",
    ),
    RulePage(
        NO_CONSTRUCTOR,
        "No constructor of the class takes arguments of these numbers and types.",
        "An int is taken where a float is expected, and an object of a subclass where one of the class is; nothing "
        "else converts. A class that declares a constructor has no other than those it declares, and none is "
        "inherited.",
        _LAMP + "Lamp a = new Lamp();\n",
        _LAMP + "Lamp a = new Lamp(60);\n",
    ),
    RulePage(
        NO_BASE,
        "A constructor calls `super(...)` with arguments, but its class extends none.",
        "`extends` and the class to build on were left out; what all classes come from has no such constructor.",
        "class Lamp { Lamp(int w) { super(w); } }\n",
        "class Light { Light(int w) { } }\nclass Lamp extends Light { Lamp(int w) { super(w); } }\n",
    ),
    RulePage(
        NO_BASE_CONSTRUCTOR,
        "A class without a constructor calls the empty one of its base, and the base has none.",
        "Declare a constructor that calls `super(...)`.",
        _LAMP + "class Spot extends Lamp { }\nSpot s = new Spot();\n",
        _LAMP + "class Spot extends Lamp { Spot() { super(60); } }\nSpot s = new Spot();\n",
    ),
    RulePage(
        MISSING_SUPER,
        "The base of the class has no constructor without arguments, so that `super(...)` must say which one to call.",
        "Where a constructor does not call `super(...)`, the empty constructor of the base runs.",
        _LAMP + "class Spot extends Lamp { int angle; Spot(int a) { angle = a; } }\n",
        _LAMP + "class Spot extends Lamp { int angle; Spot(int a) { super(60); angle = a; } }\n",
    ),
    RulePage(
        WHOLE_BOUNDS,
        "The bounds of a relation are whole numbers.",
        "Time passes in ticks.",
        _ARM + "Arm::grab { before [1 2.5] (object.release r); }\n",
        _ARM + "Arm::grab { before [1 2] (object.release r); }\n",
    ),
    RulePage(
        WRONG_RECEIVER,
        "The method is called on something that does not have it.",
        "`specify`, `reset` and `close` belong to variables, `activate`, `merge`, `reject` and `cancel` to tokens, "
        "`constrain` and `free` to objects.",
        _GOAL + "a.activate();\n",
        _GOAL + "g.activate();\n",
    ),
    RulePage(
        UNKNOWN_METHOD,
        "No method has this name.",
        "NDDL has no methods but those that are built in.",
        "int a = [1 3];\na.specifi(2);\n",
        "int a = [1 3];\na.specify(2);\n",
    ),
)
