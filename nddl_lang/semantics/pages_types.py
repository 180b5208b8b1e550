"""The pages of the codes about types and domains."""

from nddl_lang.semantics.codes import (
    ALWAYS_DIFFERENT,
    ASSIGNED_TWICE,
    CLASS_AS_VALUE,
    CLASS_TYPEDEF,
    DOES_NOT_FIT,
    INCOMPARABLE,
    LEAVES_DOMAIN,
    MEMBER_VALUE,
    MIXED_ARITHMETIC,
    MIXED_SET,
    NARROWED_TYPEDEF,
    NO_OBJECT_PREFIX,
    NO_ORDER,
    NOT_A_BOUND,
    NOT_A_COLLECTION,
    NOT_A_CONDITION,
    NOT_A_NUMBER,
    NOT_A_VARIABLE,
    NOT_AN_OBJECT,
    OUTSIDE_TYPE,
    REVERSED_INTERVAL,
    SUM_OF_TIMES,
)
from nddl_lang.text.page import RulePage

_ARM = "class Arm extends Timeline { predicate grab { int force; Arm other; } }\n"
_GOALS = _ARM + "Arm a = new Arm();\nclose();\ngoal(a.grab g);\ngoal(a.grab h);\n"
_COLORS = "enum Color { red, green }\nColor c;\n"

TYPE_PAGES = (
    RulePage(
        NARROWED_TYPEDEF,
        "A typedef of a typedef lists values that the first one does not allow.",
        "A value must be allowed by both, so the type holds fewer values than its own line says.",
        "typedef int [0 10] Small;\ntypedef Small [5 20] Odd;\n",
        "typedef int [0 10] Small;\ntypedef Small [5 10] Odd;\n",
    ),
    RulePage(
        NOT_AN_OBJECT,
        "Only objects and tokens have something behind a dot.",
        "The name before the dot is a number, a truth value, a text or an enum value.",
        "int a = 3;\nint b = a.k;\n",
        "class Box { int k; }\nBox a = new Box();\nint b = a.k;\n",
    ),
    RulePage(
        CLASS_AS_VALUE,
        "A class stands where a value is needed.",
        "The name of a class can be used to close it (`C.close();`) and to name a predicate (`C.p`).",
        "class Lamp { }\nLamp a = Lamp;\n",
        "class Lamp { }\nLamp a = new Lamp();\n",
    ),
    RulePage(
        MIXED_SET,
        "The values of a set belong to one type; int and float go together.",
        "A variable has one type, so that some of the values could never be taken.",
        "int a = {1, true};\n",
        "int a = {1, 2};\n",
    ),
    RulePage(
        DOES_NOT_FIT,
        "A value of this type cannot be given to the variable.",
        "EUROPA gives a global variable or member the type of its first value, whatever was declared: `int x = 2.5;` "
        "makes a float. Here the declared type holds. A float takes an int, a variable takes objects of subclasses, "
        "and nothing else converts.",
        "int a = 2.5;\n",
        "float a = 2.5;\n",
    ),
    RulePage(
        INCOMPARABLE,
        "No value belongs to both types, so that the two can never be equal.",
        "Numbers and truth values can be compared, enum values with those of the same enum, texts with texts, "
        "objects with objects of the same class or a subclass.",
        _COLORS + 'string s = "red";\ns == c;\n',
        _COLORS + "Color s = red;\ns == c;\n",
    ),
    RulePage(
        ALWAYS_DIFFERENT,
        "No value belongs to both enums, or to both classes, so that the two differ whatever their values are.",
        "The constraint says nothing; something else was probably meant.",
        _COLORS + "enum Mood { calm, angry }\nMood m;\nc != m;\n",
        _COLORS + "Color d;\nc != d;\n",
    ),
    RulePage(
        CLASS_TYPEDEF,
        "A typedef names a restriction of a basic type or of an enum.",
        "The objects of a class are made one by one while the script runs; a type cannot list them.",
        "class Lamp { }\nLamp a = new Lamp();\ntypedef Lamp {a} First;\n",
        "class Lamp { }\nLamp a = new Lamp();\nLamp first = {a};\n",
    ),
    RulePage(
        NO_ORDER,
        "`<`, `<=`, `>` and `>=` compare numbers.",
        "The values of an enum, texts and objects have no order.",
        _COLORS + "c < green;\n",
        _COLORS + "c != green;\n",
    ),
    RulePage(
        NOT_A_NUMBER,
        "Arithmetic needs ints or floats.",
        "There is no arithmetic over truth values, texts, enum values or objects.",
        "string s;\nint a;\na == s + 1;\n",
        "int s;\nint a;\na == s + 1;\n",
    ),
    RulePage(
        MIXED_ARITHMETIC,
        "In the dialect nddl3 both operands of `+`, `-` and `*` are ints, or both are floats.",
        "EUROPA refuses to combine an int with a float; comparing them is possible. The dialect nddlc combines them.",
        "// nddlc: dialect=nddl3\nfloat f;\nint a = 1;\nf == a + 2.5;\n",
        "// nddlc: dialect=nddl3\nfloat f;\nint a = 1;\nfloat b;\neq(b, a);\nf == b + 2.5;\n",
    ),
    RulePage(
        NOT_A_CONDITION,
        "Something that is true or false is needed: a comparison, a bool, or several joined by `&&` and `||`.",
        "A statement of an expression enforces it, and `if` waits for its truth; neither is possible with a number. "
        "(As a guard, the name of an object variable is allowed: it holds once the object is decided.)",
        "int a;\na + 1;\n",
        "int a;\na + 1 == 3;\n",
    ),
    RulePage(
        SUM_OF_TIMES,
        "Two times are added and compared with a third.",
        "EUROPA refuses it, as only a distance can be added to a time.",
        _GOALS + "g.start + g.end == h.start;\n",
        _GOALS + "g.start + g.duration == h.start;\n",
    ),
    RulePage(
        REVERSED_INTERVAL,
        "The lower bound of an interval stands first.",
        "An interval without values leaves nothing to a variable. EUROPA reports it without words, or stores it.",
        "int a = [5 1];\n",
        "int a = [1 5];\n",
    ),
    RulePage(
        NOT_A_BOUND,
        "The bounds of an interval are numbers.",
        "Enums and objects have no order; list their values in a set.",
        _COLORS + "c == [red green];\n",
        _COLORS + "c == {red, green};\n",
    ),
    RulePage(
        OUTSIDE_TYPE,
        "A typedef allows only the values of its domain.",
        "EUROPA takes the domain as a default only and stores the foreign value.",
        "typedef int [0 100] Percent;\nPercent p = 120;\n",
        "typedef int [0 100] Percent;\nPercent p = 20;\n",
    ),
    RulePage(
        LEAVES_DOMAIN,
        "The variable cannot take the value: its declaration or an earlier assignment excludes it.",
        "An assignment narrows the domain and never widens it; a variable without a value left is a mistake.",
        "int a = [1 3];\na = 7;\n",
        "int a = [1 9];\na = 7;\n",
    ),
    RulePage(
        MEMBER_VALUE,
        "The value that a class gives to a member is written out.",
        "It is the same for all objects and is known before the first of them. What depends on other variables is "
        "assigned in a constructor.",
        "int W = [40 60];\nclass Lamp { int watts = W + 1; }\n",
        "class Lamp { int watts = [41 61]; }\n",
    ),
    RulePage(
        ASSIGNED_TWICE,
        "A constructor gives a member two values that exclude each other.",
        "EUROPA makes two variables of the same name. Here the second assignment narrows the first, as in the script.",
        "class Lamp { int w; Lamp() { w = 40; w = 60; } }\n",
        "class Lamp { int w; Lamp() { w = [40 60]; w = 60; } }\n",
    ),
    RulePage(
        NO_OBJECT_PREFIX,
        "What stands before the predicate must hold an object.",
        "A new token stands on the object that the prefix names: a variable, a parameter or a member of a class type.",
        _ARM + "Arm::grab { meets(force.grab q); }\n",
        _ARM + "Arm::grab { meets(other.grab q); }\n",
    ),
    RulePage(
        NOT_A_COLLECTION,
        "`foreach` runs over the objects that a variable may hold.",
        "EUROPA stops with an internal error when the rule fires.",
        _ARM + "Arm::grab { foreach (x in force) { force == 3; } }\n",
        _ARM + "Arm::grab { foreach (x in other) { any(x.grab q); } }\n",
    ),
    RulePage(
        NOT_A_VARIABLE,
        "Only a variable can be assigned.",
        "A token has variables that can: `g.state = ACTIVE;`, `g.x = 3;`.",
        _GOALS + "g = ACTIVE;\n",
        _GOALS + "g.state = ACTIVE;\n",
    ),
)
