"""The pages of the codes about single words, numbers and strings, and about includes."""

from nddl_lang.syntax.codes import (
    INCLUDE_AGAIN,
    INCLUDE_CYCLE,
    INTEGER_RANGE,
    MALFORMED_NUMBER,
    MISSING_FILE,
    NOT_TEXT,
    TOO_LARGE,
    UNCLOSED_COMMENT,
    UNCLOSED_STRING,
    UNDECODABLE,
    UNEXPECTED_CHARACTER,
    UNKNOWN_ESCAPE,
    UNREADABLE_FILE,
)
from nddl_lang.syntax.parser import MOST_ASKED_FOR, MOST_LEXEMES
from nddl_lang.text.page import RulePage

_STRICT = "// nddlc: dialect=nddl3\n"

LEXEME_PAGES = (
    RulePage(
        UNEXPECTED_CHARACTER,
        "Outside strings and comments NDDL consists of ASCII letters, digits, `_`, `$`, blanks and a few signs. Other "
        "characters are left out, and reading goes on after them.",
        "EUROPA refuses such a file. Names cannot hold letters beyond ASCII; strings and comments can.",
        "int größe = 3;\n",
        "int groesse = 3;\n",
    ),
    RulePage(
        UNCLOSED_STRING,
        'A string begins here, and no `"` ends it.',
        "A string may go on over several lines, so a missing quote could swallow the rest of the file. It is taken to "
        "end with its line.",
        'string s = "lamp;\nint a = 1;\n',
        'string s = "lamp";\nint a = 1;\n',
    ),
    RulePage(
        UNCLOSED_COMMENT,
        "A comment begins here with `/*`, and no `*/` ends it. All that follows belongs to it.",
        "Comments do not nest: the first `*/` ends a comment, whatever was opened inside it.",
        "int a = 1;\n/* the rest\nint b = 2;\n",
        "int a = 1;\n/* the rest */\nint b = 2;\n",
    ),
    RulePage(
        UNKNOWN_ESCAPE,
        "After a backslash stands `b t n f r \" ' \\`, up to three octal digits, or `u` and four hexadecimal digits.",
        'Escapes are checked but not decoded: `"a\\nb"` has four characters between its quotes. So a backslash is '
        "rarely of use.",
        'string path = "maps\\quay";\n',
        'string path = "maps/quay";\n',
    ),
    RulePage(
        MALFORMED_NUMBER,
        "This begins like a number and goes on like none.",
        "A whole number is `0` or begins with another digit; a real number has a point, an exponent, or one of "
        "`f F d D` at its end. A name cannot begin with a digit.",
        "int a = 12ab;\n",
        "int a = 12;\n",
    ),
    RulePage(
        INTEGER_RANGE,
        "Whole numbers reach from -4503599627370495 to 4503599627370495, in nddl3 from -2147483648 to 2147483648.",
        "EUROPA keeps the last 32 bits of a number without a word: 4503599627370496 becomes 0 and 3000000000 negative.",
        _STRICT + "int limit = 3000000000;\n",
        _STRICT + "int limit = 2000000000;\n",
    ),
    RulePage(
        UNDECODABLE,
        "The file holds bytes that are not UTF-8, in a string or a comment.",
        "Each of them is shown as U+FFFD. Nothing is lost for the meaning of the model, but a text that is compared or "
        "printed is not the one that was meant.",
        "// Stra\ufffde\nint a = 1;\n",
        "// Straße\nint a = 1;\n",
    ),
    RulePage(
        NOT_TEXT,
        "The file is an image, a program, an archive, or a text in another encoding such as UTF-16: most of it cannot "
        "be read as UTF-8.",
        "Nothing in it is looked at, as each of its bytes would be another complaint.",
        "\ufffdPNG\ufffd\ufffd\ufffd\ufffdIHDR\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\n",
        "int a = 1;\n",
    ),
    RulePage(
        TOO_LARGE,
        f"With all that it includes, the model has more than {MOST_LEXEMES} lexemes: words, numbers, strings, signs "
        f"and comments. `max-lexemes` in the configuration sets another limit, up to {MOST_ASKED_FOR}.",
        "What a command needs grows with them: at the limit about 300 MB and some seconds. The largest public model "
        "has fewer than 2,000. Nothing of a larger one is analysed.",
        "max-lexemes = 1000\n",
        "max-lexemes = 400000\n",
        "toml",
    ),
    RulePage(
        MISSING_FILE,
        "No file has this name beside the including file, in the directories given by `--include` or in the "
        "configuration, in the current directory, or in the library.",
        "EUROPA looks only in its include path and in the directory that it was started in.",
        '#include "nowhere.nddl"\nint a = 1;\n',
        '#include "Plasma.nddl"\nint a = 1;\n',
    ),
    RulePage(
        INCLUDE_CYCLE,
        "A file includes itself, directly or through others.",
        "Each file is read once, so the include brings nothing. It hides which of the files needs the other; what both "
        "need belongs into a third file.",
        '#include "bad.nddl"\nint a = 1;\n',
        "int a = 1;\n",
    ),
    RulePage(
        INCLUDE_AGAIN,
        "A file includes itself, directly or through others. In nddl3 this is a warning only.",
        "EUROPA reads each file once and says nothing. In the dialect nddlc it is an error.",
        _STRICT + '#include "bad.nddl"\nint a = 1;\n',
        _STRICT + "int a = 1;\n",
    ),
    RulePage(
        UNREADABLE_FILE,
        "There is something of this name, but it cannot be read: it is a directory, or reading is not allowed.",
        "The rest of the model is checked as if the include were not there.",
        '#include "."\nint a = 1;\n',
        '#include "Plasma.nddl"\nint a = 1;\n',
    ),
)
