"""The pages of the codes about names that are taken."""

from nddl_lang.semantics.codes import (
    BUILTIN_PARAMETER,
    CONSTRUCTOR_NAME,
    DUPLICATE_CONSTRUCTOR,
    DUPLICATE_FORMAL,
    DUPLICATE_MEMBER,
    DUPLICATE_NAME,
    DUPLICATE_OBJECT,
    DUPLICATE_PARAMETER,
    DUPLICATE_PREDICATE,
    DUPLICATE_TOKEN,
    DUPLICATE_TYPE,
    DUPLICATE_VALUE,
    ENUM_OF_THAT_NAME,
    NATIVE_CLASS,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { int force; } }\nArm a = new Arm();\n"

DUPLICATE_PAGES = (
    RulePage(
        CONSTRUCTOR_NAME,
        "The constructor of a class carries the name of the class.",
        "EUROPA takes any name and makes a constructor of it, so that a misspelt one goes unnoticed.",
        "class Lamp { int watts; Lmap() { watts = 60; } }\n",
        "class Lamp { int watts; Lamp() { watts = 60; } }\n",
    ),
    RulePage(
        DUPLICATE_TYPE,
        "A class, enum or typedef of this name exists already.",
        "EUROPA keeps the first of two classes and passes over the second without a word.",
        "class Lamp { int watts; }\nclass Lamp { int volts; }\n",
        "class Lamp { int watts; int volts; }\n",
    ),
    RulePage(
        DUPLICATE_MEMBER,
        "The class or an ancestor of it declares a member of this name already.",
        "EUROPA makes two variables of the same name, and each place takes another one of them.",
        "class Lamp { int watts; }\nclass Spot extends Lamp { int watts; }\n",
        "class Lamp { int watts; }\nclass Spot extends Lamp { int angle; }\n",
    ),
    RulePage(
        ENUM_OF_THAT_NAME,
        "A class bears the name of an enum above it.",
        "EUROPA allows it and lets the class take the name over: what is declared with it below is an object. The "
        "values of the enum stay what they are. The other way round, an enum named like a class, is an error.",
        "enum Lamp { bright, dim }\nclass Lamp { int watts; }\n",
        "enum Glow { bright, dim }\nclass Lamp { int watts; }\n",
    ),
    RulePage(
        NATIVE_CLASS,
        "The class is built in; what the model writes about it is not read.",
        "EUROPA's library describes the resource classes in NDDL for its readers only. A class with other members "
        "needs another name.",
        "class Reservoir { float initialCapacity; }\n",
        "class Tank extends Reservoir { Tank(float level) { super(level, 0.0, 10.0); } }\n",
    ),
    RulePage(
        DUPLICATE_PREDICATE,
        "A class declares each of its predicates once.",
        "To add parameters or constraints to an inherited predicate, declare it again in the subclass.",
        "class Arm extends Timeline { predicate grab { int x; } predicate grab { int y; } }\n",
        "class Arm extends Timeline { predicate grab { int x; int y; } }\n",
    ),
    RulePage(
        DUPLICATE_PARAMETER,
        "The predicate has a parameter of this name already, perhaps from an ancestor's declaration.",
        "A subclass that declares an inherited predicate again adds to it; what is there stays there.",
        "class Arm extends Timeline { predicate grab { int force; } }\n"
        "class Hand extends Arm { predicate grab { int force; } }\n",
        "class Arm extends Timeline { predicate grab { int force; } }\n"
        "class Hand extends Arm { predicate grab { force <= 5; } }\n",
    ),
    RulePage(
        BUILTIN_PARAMETER,
        "`state`, `object`, `start`, `end` and `duration` (for events `time`) belong to every token.",
        "EUROPA notices it only when the first token is made, and stops.",
        "class Arm extends Timeline { predicate grab { int duration; } }\n",
        "class Arm extends Timeline { predicate grab { duration = [1 5]; } }\n",
    ),
    RulePage(
        DUPLICATE_CONSTRUCTOR,
        "Two constructors of a class take arguments of the same types.",
        "`new` chooses by the types of the arguments, so that one of them could never be called.",
        "class Lamp { int w; Lamp(int v) { w = v; } Lamp(int x) { w = x; } }\n",
        "class Lamp { int w; Lamp(int v) { w = v; } Lamp(int v, int x) { w = x; } }\n",
    ),
    RulePage(
        DUPLICATE_FORMAL,
        "Two parameters of a constructor have the same name.",
        "Only one of them could be used.",
        "class Lamp { int w; Lamp(int v, int v) { w = v; } }\n",
        "class Lamp { int w; Lamp(int v, int x) { w = v; } }\n",
    ),
    RulePage(
        DUPLICATE_NAME,
        "A variable or token of the script has this name already.",
        "Variables and tokens share their names, as a path `x.y` may start with either.",
        "int a = 1;\nint a = 2;\n",
        "int a = 1;\nint b = 2;\n",
    ),
    RulePage(
        DUPLICATE_TOKEN,
        "A token or variable of the script has this name already.",
        "The names of tokens are global.",
        _ARM + "goal(a.grab g);\ngoal(a.grab g);\n",
        _ARM + "goal(a.grab g);\ngoal(a.grab h);\n",
    ),
    RulePage(
        DUPLICATE_VALUE,
        "The name is a value of an enum already, of this one or of another.",
        "A bare enum value is known everywhere, so that it can belong to one enum only.",
        "enum Color { red, green }\nenum Light { green, amber }\n",
        "enum Color { red, green }\nenum Light { go, amber }\n",
    ),
    RulePage(
        DUPLICATE_OBJECT,
        "An object takes the name of the variable that it is made for; one of that name exists.",
        "The names of objects are global.",
        "class Lamp { }\nLamp a = new Lamp();\na = new Lamp();\n",
        "class Lamp { }\nLamp a = new Lamp();\nLamp b = new Lamp();\n",
    ),
)
