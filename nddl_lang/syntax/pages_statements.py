"""The pages of the codes about statements that are not built as NDDL wants them."""

from nddl_lang.syntax.brackets import DEPTH_LIMIT
from nddl_lang.syntax.codes import (
    CALL_INITIALISER,
    EQUALITY_SIGN,
    EXPECTED,
    IN_ASSIGNMENT,
    MISPLACED,
    MISPLACED_METHOD,
    MISPLACED_NEW,
    MISPLACED_VALUE,
    MISSING,
    MISSPELT,
    NO_ARGUMENT,
    RESERVED_WORD,
    STRAY_BRACE,
    SUPERFLUOUS,
    TOO_DEEP,
    UNCLOSED_BRACE,
)
from nddl_lang.text.page import RulePage

_LAMP = "class Lamp extends Timeline { predicate On { int level; } predicate Off { } }\n"

STATEMENT_PAGES = (
    RulePage(
        EXPECTED,
        "The statement cannot go on like this. The message says what could stand here instead.",
        "What was not understood is left out as a whole statement, and reading goes on behind it; so one mistake costs "
        "one message.",
        "int a = ;\n",
        "int a = 3;\n",
    ),
    RulePage(
        MISSING,
        "A `;`, `)`, `]` or `}` is missing, and everything around it is clear.",
        "The text is understood as if the sign were there.",
        "int a = 1\nint b = 2;\n",
        "int a = 1;\nint b = 2;\n",
    ),
    RulePage(
        SUPERFLUOUS,
        "A sign stands where none can, and without it everything is clear.",
        "The text is understood as if the sign were not there. Lists have no comma after their last entry.",
        "enum Colour { red, green, }\n",
        "enum Colour { red, green }\n",
    ),
    RulePage(
        RESERVED_WORD,
        "The words of the language, among them all relations, cannot name anything.",
        "They are: `action any after before bool class close condition contained_by contains contains_end "
        "contains_start effect else ends ends_after ends_after_start ends_before ends_during enforce enum equal equals "
        "extends fact false filter float foreach goal if in inf inff int meets met_by new paralleled_by parallels "
        "predicate rejectable starts starts_after starts_before starts_before_end starts_during string super this "
        "true typedef`.",
        "int before = 3;\n",
        "int earlier = 3;\n",
    ),
    RulePage(
        UNCLOSED_BRACE,
        "The block that begins here has no end. Where the lines are indented, the message points at the block whose "
        "`}` seems to be missing.",
        "A class, a rule, an enum, a typedef or a goal at the start of a line ends all that is still open above it.",
        "class Lamp {\n    predicate On { int level; }\n\nclass Switch { }\n",
        "class Lamp {\n    predicate On { int level; }\n}\n\nclass Switch { }\n",
    ),
    RulePage(
        STRAY_BRACE,
        "Every block that was opened is closed already.",
        "EUROPA stops reading here without a word and drops the rest of the file.",
        "int a = 1;\n}\nint b = 2;\n",
        "int a = 1;\nint b = 2;\n",
    ),
    RulePage(
        TOO_DEEP,
        f"Parentheses, blocks, `else if` or the operands of one expression are nested more than {DEPTH_LIMIT} levels "
        "deep.",
        "Everybody who works on a model walks down into its expressions, and has to come back.",
        f"int a = {'(' * 201}1{')' * 201};\n",
        "int a = 1;\n",
    ),
    RulePage(
        MISPLACED,
        "The statement is one of NDDL, but not of this kind of block.",
        "Classes, enums, typedefs, rules, goals, method calls and `close()` stand at the top level. A class holds "
        "members, constructors, predicates and actions; a constructor holds assignments and, first, `super(...)`; a "
        "predicate holds parameters, constraints and assignments; a rule holds relations, variables, constraints, `if` "
        "and `foreach`. EUROPA drops the rest of the file after some of these mistakes.",
        _LAMP + "Lamp::On { level = 3; }\n",
        _LAMP + "Lamp::On { level == 3; }\n",
    ),
    RulePage(
        MISPLACED_NEW,
        "`new` creates an object for a variable, or stands by itself.",
        "Every object has a name: that of its variable, which plans and messages use.",
        "class Lens { }\nclass Lamp { Lens lens; Lamp(Lens l) { lens = l; } }\nLamp a = new Lamp(new Lens());\n",
        "class Lens { }\nclass Lamp { Lens lens; Lamp(Lens l) { lens = l; } }\nLens b = new Lens();\n"
        "Lamp a = new Lamp(b);\n",
    ),
    RulePage(
        MISPLACED_METHOD,
        "A method does something to a variable, a token or an object; it has no result.",
        "Functions such as `max(a, b)` have results; they belong to no object.",
        "int a = [0 9];\nint b;\nb == a.specify(3);\n",
        "int a = [0 9];\nint b;\na.specify(3);\nb == a;\n",
    ),
    RulePage(
        MISPLACED_VALUE,
        "The bounds of an interval are numbers, and a set holds single values.",
        "A domain is either an interval or a set; it is not built from other domains.",
        "int a = {[1 2], 5};\n",
        "int a = {1, 2, 5};\n",
    ),
    RulePage(
        NO_ARGUMENT,
        "A function computes its value from arguments.",
        "Without any, there is nothing to compute it from.",
        "int a;\na == max();\n",
        "int a;\na == max(1, 2);\n",
    ),
    RulePage(
        EQUALITY_SIGN,
        "`=` gives a variable its value; in an expression `==` says that two values are equal.",
        "The text is understood as if `==` stood here.",
        _LAMP + "Lamp::On { if (level = 3) { meets(object.Off o); } }\n",
        _LAMP + "Lamp::On { if (level == 3) { meets(object.Off o); } }\n",
    ),
    RulePage(
        CALL_INITIALISER,
        "A variable gets its value by `=`, not by parentheses.",
        "EUROPA reads this, prints a line, drops the rest of the file, and reports success.",
        "int a(5);\n",
        "int a = 5;\n",
    ),
    RulePage(
        IN_ASSIGNMENT,
        "A domain is given to a variable by `=`, which restricts it to the values of the domain.",
        "EUROPA reads this, prints a line, drops the rest of the file, and reports success.",
        "int a;\na in [1 5];\n",
        "int a;\na = [1 5];\n",
    ),
    RulePage(
        MISSPELT,
        "Where a word of the language would make sense stands a name that is none.",
        "The text is understood as if the word stood here that comes nearest: of keywords and types the one that makes "
        "the statement go on, of relations `any` if none is near. Behind a word of other languages (`elif`) "
        "the statement is passed over.",
        _LAMP + "Lamp::On { befor(object.Off dark); }\n",
        _LAMP + "Lamp::On { before(object.Off dark); }\n",
    ),
)
