"""The pages of the codes about what one dialect of NDDL has and another has not."""

from nddl_lang.syntax.codes import (
    BYTE_ORDER_MARK,
    COMMENT_AT_END,
    DIVISION,
    EMPTY_IN_PREDICATE,
    EXPRESSION_ARGUMENT,
    EXPRESSION_VALUE,
    FORMER_DIRECTIVE,
    FORMER_NUMBER,
    FORMER_RELATION,
    FORMER_SIGNATURE,
    FORMER_STRING,
    FORMER_WORD,
    GLUED_SIGN,
    INCLUDE_BLANK,
    MEMBER_INITIALISER,
    RELATION_BOUNDS,
    UNARY_OPERATOR,
    VARIABLE_BOUND,
)
from nddl_lang.text.page import RulePage

_STRICT = "// nddlc: dialect=nddl3\n"
_LAMP = "class Lamp extends Timeline { predicate On { int level; } predicate Off { } }\n"
_PORTABLE = "The dialect nddlc accepts it, so this matters only where EUROPA must be able to read the model."

DIALECT_PAGES = (
    RulePage(
        EXPRESSION_VALUE,
        "An initialiser, the right side of an assignment, and an argument of a constructor or method is a literal, a "
        "domain or a variable in nddl3. " + _PORTABLE,
        "EUROPA's grammar has expressions only in constraints.",
        _STRICT + "int a = 1 + 2;\n",
        _STRICT + "int a;\na == 1 + 2;\n",
    ),
    RulePage(
        GLUED_SIGN,
        "In nddl3 a sign right before a digit belongs to the number, so `a-1` is a name followed by a number. "
        + _PORTABLE,
        "Blanks around an operator cost nothing and read the same everywhere; `nddlc fmt` puts them there.",
        _STRICT + "int a;\nint b;\nb == a-1;\n",
        _STRICT + "int a;\nint b;\nb == a - 1;\n",
    ),
    RulePage(
        UNARY_OPERATOR,
        "nddl3 has `-` only between two operands and as part of a number, and no `!`. " + _PORTABLE,
        "EUROPA refuses the file.",
        _STRICT + "int a;\nint b;\nb == -a;\n",
        _STRICT + "int a;\nint b;\nb == 0 - a;\n",
    ),
    RulePage(
        DIVISION,
        "nddl3 has no operator `/`. " + _PORTABLE,
        "EUROPA refuses the file. The same can be said as a product.",
        _STRICT + "float a;\nfloat b;\nfloat c;\nc == a / b;\n",
        _STRICT + "float a;\nfloat b;\nfloat c;\na == c * b;\n",
    ),
    RulePage(
        RELATION_BOUNDS,
        "`before [1 5] (...)` bounds the distance between both tokens; nddl3 has relations without bounds only. "
        + _PORTABLE,
        "EUROPA dropped the bounds from the language in 2005. A constraint over the times says the same.",
        _STRICT + _LAMP + "Lamp::On { before [1 5] (object.Off o); }\n",
        _STRICT + _LAMP + "Lamp::On { before(object.Off o); int gap = [1 5]; temporalDistance(end, gap, o.start); }\n",
    ),
    RulePage(
        MEMBER_INITIALISER,
        "In nddl3 a member gets its value in a constructor. " + _PORTABLE,
        "EUROPA reads this, prints a line, drops the rest of the file, and reports success.",
        _STRICT + "class Lamp { int watts = 5; }\n",
        _STRICT + "class Lamp { int watts; Lamp() { watts = 5; } }\n",
    ),
    RulePage(
        COMMENT_AT_END,
        "In nddl3 the last line must have a line end if it ends with a `//` comment. " + _PORTABLE,
        "EUROPA looks for the line end and finds none. Most editors add one when they save.",
        _STRICT + "int a = 1; // the end",
        _STRICT + "int a = 1; // the end\n",
    ),
    RulePage(
        BYTE_ORDER_MARK,
        "The file begins with the three bytes that some editors write before UTF-8 text. " + _PORTABLE,
        "EUROPA takes them for three unknown characters.",
        "\ufeff" + _STRICT + "int a = 1;\n",
        _STRICT + "int a = 1;\n",
    ),
    RulePage(
        INCLUDE_BLANK,
        "In nddl3 a blank stands between `#include` and the path. " + _PORTABLE,
        "EUROPA does not recognise the directive without it.",
        _STRICT + '#include"Plasma.nddl"\n',
        _STRICT + '#include "Plasma.nddl"\n',
    ),
    RulePage(
        EMPTY_IN_PREDICATE,
        "A `;` by itself may stand anywhere but in a predicate in nddl3. " + _PORTABLE,
        "EUROPA refuses the file.",
        _STRICT + "class Lamp extends Timeline { predicate On { int level;; } }\n",
        _STRICT + "class Lamp extends Timeline { predicate On { int level; } }\n",
    ),
    RulePage(
        VARIABLE_BOUND,
        "In nddl3 the bounds of an interval are plain numbers. " + _PORTABLE,
        "EUROPA refuses the file, though a set may name variables.",
        _STRICT + "int n = 5;\nint a = [1 n];\n",
        _STRICT + "int n = 5;\nint a;\na >= 1;\na <= n;\n",
    ),
    RulePage(
        EXPRESSION_ARGUMENT,
        "In nddl3 the arguments of a constraint are literals, domains and variables. " + _PORTABLE,
        "EUROPA takes `eq(a + 1, b)` for the call of a function `eq`, and finds none.",
        _STRICT + "int a;\nint b;\neq(a + 1, b);\n",
        _STRICT + "int a;\nint b;\na + 1 == b;\n",
    ),
    RulePage(
        FORMER_WORD,
        "Earlier dialects had access modifiers, `filterOnly`, `switch`, `delete`; papers have `subgoal`.",
        "NDDL3 has none of them. As they are ordinary names today, they are recognised by what follows them.",
        "class Lamp { private int watts; }\n",
        "class Lamp { int watts; }\n",
    ),
    RulePage(
        FORMER_STRING,
        "Single quotes made strings until 2006.",
        "EUROPA refuses the file.",
        "string s = 'lamp';\n",
        'string s = "lamp";\n',
    ),
    RulePage(
        FORMER_NUMBER,
        "Hexadecimal and octal numbers belonged to the language until 2008.",
        "NDDL3 reads `0x1F` as `0` followed by a name, and `007` as three numbers.",
        "int a = 0x1F;\n",
        "int a = 31;\n",
    ),
    RulePage(
        FORMER_DIRECTIVE,
        "`#include` is the only directive: there is no `#define`, `#ifdef`, `#line` or `#use_xml`.",
        "The line is left out.",
        "#define WATTS 5\nint a = 1;\n",
        "int WATTS = 5;\nint a = 1;\n",
    ),
    RulePage(
        FORMER_RELATION,
        "The tokens that a relation asks for stand in parentheses, not bare and not in braces.",
        "Without parentheses a name is a token that exists: `meets q;` relates to the token `q`.",
        _LAMP + "Lamp::On { meets object.Off o; }\n",
        _LAMP + "Lamp::On { meets(object.Off o); }\n",
    ),
    RulePage(
        FORMER_SIGNATURE,
        "Until 2009 a model declared the constraints that it used.",
        "Today the engine knows its constraints with their types, so nothing needs to be declared.",
        "constraint near(int a, int b) native;\nint c = 1;\n",
        "int c = 1;\n",
    ),
)
