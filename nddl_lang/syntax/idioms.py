"""Statements as C, Java, Python and PDDL write them: recognised by their words, with how NDDL says the same."""

import re
from functools import cache
from typing import NamedTuple

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.tables import END
from nddl_lang.syntax.words import BASE_TYPES, GOALS, RELATIONS, RESERVED
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span

_MOST_WORDS = 40  # of a statement that are looked at
_MOST_USES = 20  # of a name, before which it is given to a token
_N = rf"(?!(?:{'|'.join(RESERVED - {'this', 'object'})})\b)[A-Za-z_$][\w$]*"
_PATH = rf"{_N}(?: \. {_N})*"
_NUMBER = r"[-+]?(?:\.?\d\S*|inff?)"
_VALUE = f"(?:{_PATH}|{_NUMBER})"
_TYPE = f"(?:{'|'.join(BASE_TYPES)})"
_RELATION = f"(?:{'|'.join(sorted(RELATIONS, key=len, reverse=True))})"
_ASKS = f"(?:{'|'.join(GOALS)}|{_RELATION[3:]}"


class Idiom(NamedTuple):
    """What to say of a statement that was recognised, and how to write the whole of it, where that is plain."""

    help: str
    fix: Fix | None


_NO_ARRAYS = "there are no arrays: declare a variable for each"
# A pattern of the statement's lexemes with a blank between each two; what to say; the whole statement in NDDL.
_ROWS: tuple[tuple[str, str, str], ...] = (
    # Values that change.
    (
        rf"({_PATH}) (?:\+ ?\+|- -) ;",
        r"no value changes: state another, as in `next == \1 + 1`",
        "",
    ),
    (
        rf"({_PATH}) ([-+*/]) = (.*) ;",
        r"no value changes: state another, as in `next == \1 \2 \3`",
        "",
    ),
    (r"return (.*);", "a statement says what holds: remove `return`", r"\1;"),
    # Words and signs of expressions.
    (r".*\S \* \* \S.*", "a power is the function `pow(a, b)`", ""),
    (rf"(.*) ({_PATH}|{_NUMBER}) x ({_PATH}|{_NUMBER})\b(.*)", r"a product is written `\2 * \3`", r"\1 \2 * \3\4"),
    (r".*\| (\S.*?) \|.*", r"write `abs(\1)`", ""),
    (rf".*\( {_TYPE} \) [\w(].*", "there are no casts: a float is rounded by `ceil(x)` or `floor(x)`", ""),
    (rf".*[^\w\s] {_TYPE} \(.*", "there are no casts: a float is rounded by `ceil(x)` or `floor(x)`", ""),
    (r".* (\d+) : (\d+)\b.*", r"a time is a number of ticks, without `:`", ""),
    # Prefix notation.
    (
        rf"\( = (?:\? )?({_VALUE}) (?:\? )?({_VALUE}) \) ;?",
        r"an operator stands between its operands: `\1 == \2`",
        r"\1 == \2;",
    ),
    (
        rf"\( not \( = (?:\? )?({_VALUE}) (?:\? )?({_VALUE}) \) \) ;?",
        r"an operator stands between its operands: `\1 != \2`",
        r"\1 != \2;",
    ),
    (
        rf"\( ([<>]=?) (?:\? )?({_VALUE}) (?:\? )?({_VALUE}) \) ;?",
        r"an operator stands between its operands: `\2 \1 \3`",
        r"\2 \1 \3;",
    ),
    (
        r"\( (?:=|<|>|<=|>=|not|and|or|forall|when) .*",
        "an operator stands between its operands: `a == b`, `a != b`, `a && b`",
        "",
    ),
    (
        r"\( (?:define|: ?\w+)\b.*",
        "this is PDDL; NDDL declares `Class name = new Class();` and `predicate Name { }`",
        "",
    ),
    # Declarations.
    (rf"\? ({_N}) - (\w+) ;", r"the type stands first: `\2 \1;`", r"\2 \1;"),
    (rf"({_N}) : ({_TYPE}) ;|({_TYPE}) : ({_N}) ;", r"the type stands first: `\2\3 \1\4;`", r"\2\3 \1\4;"),
    (rf"(?:void|def|fn|function) ({_N}) \( (.*) \) ;", r"what may hold is a predicate: `predicate \1 { }`", ""),
    (rf"void ({_N}) \( (.*) \) \{{", r"a constructor has no type: remove `void`", ""),
    (
        rf"(?:def|fn|function) ({_N}) \(.*",
        r"members of a class are variables, predicates, `predicate Name { }`, and constructors, `Class(int a) { }`",
        "",
    ),
    (
        rf"({_N}) \( .*\) : (?:super|{_N}) \(.*",
        r"the constructor of the base class is called first in the body: `{ super(...); }`",
        "",
    ),
    (r"super \(.*\) \. .*", "the constructor of the base class is called by `super(...);`", ""),
    (
        rf"({_TYPE}|{_N}) ({_N}) \[ ({_NUMBER}),? ({_NUMBER}) \] ;",
        r"a domain stands after `=`: `\1 \2 = [\3 \4];`",
        r"\1 \2 = [\3 \4];",
    ),
    (rf"(?:{_TYPE}|{_N}) (?:{_N} \[|\[ ?\S* ?\] {_N}\b).*", _NO_ARRAYS, ""),
    (
        rf"({_N}) [*&] ({_N}) (= new .*);|({_TYPE}) [*&] ({_N}.*);",
        r"there are no pointers, and no `*`: `\1\4 \2\5`",
        r"\1\4 \2\5 \3;",
    ),
    (
        rf"new ({_N}) ({_N}) \((.*)\) ;",
        r"an object is made so: `\1 \2 = new \1(\3);`",
        r"\1 \2 = new \1(\3);",
    ),
    (rf"(.*)\b({_N}) \. new \((.*)", r"an object is made by `new \2(...)`", r"\1new \2(\3"),
    (
        rf"(.*(?:=|in|==)) \( ({_NUMBER}) ,? ?({_NUMBER}) \) ;",
        r"an interval is written `[\2 \3]`",
        r"\1 [\2 \3];",
    ),
    (
        rf"(.*(?:=|in|==)) (?:\[ )?({_NUMBER}) (?:to|\. \.|\. \. \.|-|:|;) ({_NUMBER}) (?:\] )?;",
        r"an interval is written `[\2 \3]`",
        r"\1 [\2 \3];",
    ),
    (
        rf"(.*(?:=|in|==)) ({_NUMBER}) ({_NUMBER}) ;",
        r"an interval is written `[\2 \3]`",
        r"\1 [\2 \3];",
    ),
    (
        rf"(.*= new {_N}) ({_N}(?: , {_N})*) ;",
        r"the arguments stand in parentheses: `\1(\2);`",
        r"\1(\2);",
    ),
    (
        rf"new ({_N}) ({_N}) = ({_N}) \((.*)\) ;",
        r"an object is made so: `\1 \2 = new \3(\4);`",
        r"\1 \2 = new \3(\4);",
    ),
    (
        rf"(.*(?:=|in|==)) \[ ({_NUMBER} , {_NUMBER}(?: , {_NUMBER})+) \] ;",
        r"an interval has two bounds; single values stand in braces: `{\2}`",
        r"\1 {\2};",
    ),
    (rf"({_TYPE}) = (.*) ;", r"a variable has a name: `\1 name = \2;`", ""),
    (
        rf"({_ASKS}) ({_PATH}) \( ({_N}) \) ;",
        r"the token is named so: `\1(\2 \3);`",
        r"\1(\2 \3);",
    ),
    (
        rf"typedef ({_TYPE}) (?:\( )?({_NUMBER}) (?:to |\. \. |\. \. \. |- |: |, )?({_NUMBER}) (?:\) )?({_N}) ;",
        r"a domain stands in brackets: `typedef \1 [\2 \3] \4;`",
        r"typedef \1 [\2 \3] \4;",
    ),
    (
        rf"({_TYPE}|{_N}) ({_N}) - ({_N})(?: (=.*))? ;",
        r"a name holds letters, digits and `_` only: `\1 \2_\3 \4;`",
        r"\1 \2_\3 \4;",
    ),
    (
        rf"(.*?)({_PATH}) ([<>=!]=|[<>]) ({_VALUE}) (&&|\|\|) ([<>=!]=|[<>]) ({_VALUE})\b(.*)",
        r"each comparison has a left side: `\2 \3 \4 \5 \2 \6 \7`",
        r"\1 \2 \3 \4 \5 \2 \6 \7 \8",
    ),
    (
        rf"({_TYPE}|{_N}) (\[ .* \]|\{{ .* \}}) ({_N}) ;",
        r"a domain stands after `=`: `\1 \3 = \2;`",
        r"\1 \3 = \2;",
    ),
    (
        rf"({_N} |)({_RELATION}) \( ({_NUMBER}) ,? ?({_NUMBER}) \) (\(.*) ;",
        r"the bounds of a distance stand in brackets: `\1\2 [\3 \4] \5;`",
        r"\1\2 [\3 \4] \5;",
    ),
    (
        rf"[^?]* ({_PATH}|{_NUMBER}) : ({_PATH}|{_NUMBER}) ;",
        r"a quotient is written `\1 / \2`; a message behind `:` stands in quotes",
        "",
    ),
    (rf"enum {_N} \{{? ?.*=.*", "an enum lists names, without numbers: `enum E { a, b }`", ""),
    (
        rf"typedef (\[.*\]|\{{.*\}}) ({_TYPE}) ({_N}) ;",
        r"the domain stands behind the type: `typedef \2 \1 \3;`",
        r"typedef \2 \1 \3;",
    ),
    (
        rf"typedef ({_TYPE}) (\[.*\]|\{{.*\}}) ;",
        r"the name of the type stands last: `typedef \1 \2 Name;`",
        "",
    ),
    (
        rf"typedef ({_N}) ({_TYPE}) (\[.*\]|\{{.*\}}) ;|typedef ({_TYPE}) ({_N}) (\[.*\]|\{{.*\}}) ;",
        r"the name stands last: `typedef \2\4 \3\6 \1\5;`",
        r"typedef \2\4 \3\6 \1\5;",
    ),
    (
        rf"(?:.*\bnew {_N}|super|(?!(?:if|while|for|foreach|{_ASKS}) )(?:{_TYPE}|{_N})(?: {_N} =)?(?: new {_N})?)"
        rf" \( {_N} = .*",
        "arguments stand in the order of the parameters, without names",
        "",
    ),
    # Tokens.
    (
        rf"({_ASKS}) \( new ({_PATH} {_N}) \) ;",
        r"the token is made without `new`: `\1(\2);`",
        r"\1(\2);",
    ),
    (rf"new ({_ASKS}) \((.*) ;", r"the token is made without `new`: `\1(\2;`", r"\1(\2;"),
    (
        rf"\( ({_ASKS}) (?:\( )?({_PATH}) ({_N})(?: \))? \) ;?",
        r"the parenthesis stands behind the word: `\1(\2 \3);`",
        r"\1(\2 \3);",
    ),
    (rf"({_N}) = ({_ASKS}) \( ({_PATH}) \) ;", r"the token is named inside: `\2(\3 \1);`", r"\2(\3 \1);"),
    (rf"({_ASKS}) \( ({_PATH}) \( ({_N}) \) \) ;", r"the token is named so: `\1(\2 \3);`", r"\1(\2 \3);"),
    (
        rf"(?:{_ASKS}) \( {_PATH} ({_N}) ?,? [^)]*=.*",
        r"what holds of the token is stated after it: `\1.start == 20;`",
        "",
    ),
    (
        rf"({_N} |)({_RELATION}) ({_N}) (?:{_N} )?({_NUMBER})(?: {_N})? ;",
        r"a distance stands after the relation: `\1\2 [\4 \4] \3;`",
        "",
    ),
    (
        rf"({_ASKS}) \( ({_N}) ({_N}(?: \. {_N})+) \) ;",
        r"the name of the token stands last: `\1(\3 \2);`",
        r"\1(\3 \2);",
    ),
    (
        rf"({_ASKS}) \( ({_N}) ({_N}) ({_N}) \) ;",
        r"class and predicate are joined by a dot: `\1(\2.\3 \4);`",
        r"\1(\2.\3 \4);",
    ),
    # Files and comments.
    (rf"from ({_N}) import.*|import ({_N}) ;?", r'a file is included by `#include "\1\2.nddl"`', ""),
    (r'"" ".*', "a comment begins with `//`, one that editors show with `///`", ""),
    (r"close ;", "write `close();`", "close();"),
    (r"otherwise \{", "write `else`", "else {"),
    (r"(?:elif|elsif|elseif) \((.*)\) \{", "write `else if`", r"else if (\1) {"),
    (rf"class ({_N}) ({_N}) \{{", r"write `class \1 extends \2`", r"class \1 extends \2 {"),
    (
        rf"({_TYPE} {_N} =) ([-+]?\d+) , (\d+) ;",
        r"numbers have a decimal point: `\2.\3`",
        r"\1 \2.\3;",
    ),
    (
        r"(.*\[) ([-+]?\d+) , (\d+) ([-+]?[\d.]+) \] ;",
        r"numbers have a decimal point: `[\2.\3 \4]`",
        r"\1\2.\3 \4];",
    ),
    (
        r"(.*\[) ([-+]?\d+) , (\d+) ([-+]?\d+) , (\d+) \] ;",
        r"numbers have a decimal point: `[\2.\3 \4.\5]`",
        r"\1\2.\3 \4.\5];",
    ),
    (rf"({_N} :: {_N}) ([^{{]*[^{{\w ][^{{]*) \{{", r"a rule is written `\1 { }`, without `\2`", ""),
    (r"((?:[-=:>] ?)+) \{", r"the braces stand right after what they belong to, without `\1`", ""),
)
_TIDY = (
    (re.compile(r"([-=]) >"), r"\1>"),
    (re.compile(r" ?(\.|::) ?"), r"\1"),
    (re.compile(r" ([;,)\]])"), r"\1"),
    (re.compile(r"([(\[]) "), r"\1"),
)
_CALL = re.compile(r"(\w)(?<!\bif) \(")
_LONGEST = 1000  # characters of a statement that may be one: some patterns take the square of them
_PROSE = 4  # names in a row that are a sentence


@cache
def _table() -> tuple[tuple[re.Pattern[str], str, str], ...]:
    """The rows with their patterns; to compile these takes a tenth of a second, and only mistakes need them."""
    return tuple((re.compile(pattern, re.DOTALL), help_, written) for pattern, help_, written in _ROWS)


def find_idiom(b: Builder, first: int, index: int, is_inside: bool) -> Idiom | None:
    """What the statement that begins at the lexeme `first` is in another language; None where it is none.

    The parser could not go on with the lexeme `index`; `is_inside`: the statement stands in a block.
    """
    if b.kinds[first] in ("}", END):
        return None
    if b.kinds[first] == "(" and b.kinds[max(0, first - 2) : first] == ["::", "IDENT"]:
        first -= 3  # the statement begins behind the head of a rule, which may stand without braces
    last = first
    ends = ("}", END) if b.kinds[first] == "enum" else (";", "{", END)
    while b.kinds[last] not in ends and last - first < _MOST_WORDS:
        if last >= index > first and _begins_line(b, last):
            break
        last += 1
    is_whole = b.kinds[last] in (";", "{", "}")
    text = " ".join(b.texts[first : last + is_whole])
    if len(text) > _LONGEST:
        return None
    token = re.fullmatch(rf"({_N} \. {_PATH}) ({_N}) ;", text)
    if token is not None:
        verb = "any" if is_inside else "goal"
        written = _tidied(token.expand(rf"{verb}(\1 \2);"))
        return Idiom(f"a token is asked for by name: `{written}`", _fix(b, first, last, written))
    member = re.fullmatch(rf"({_N}) ({_N}) ([=!<>]=|[<>]) (.*) ;", text)
    if member is not None and _is_token(b, first, member[1]):
        written = _tidied(member.expand(r"\1.\2 \3 \4;"))
        return Idiom(f"a parameter of a token stands behind a dot: `{written}`", _fix(b, first, last, written))
    if _is_prose(b, first, index):
        start = b.at(first).start
        edit = Edit(Span(b.anchor, start, start), "// ")
        fix = Fix("make it a comment", (edit,), safe=False) if first == 0 or _begins_line(b, first) else None
        return Idiom("a comment begins with `//`", fix)
    for pattern, help_, written in _table():
        match = pattern.fullmatch(text)
        if match is not None and not (help_ == _NO_ARRAYS and _is_relation(b, first)):
            fix = _fix(b, first, last, _tidied(match.expand(written))) if written and is_whole else None
            return Idiom(_tidied(match.expand(help_)), fix)
    return None


def _is_relation(b: Builder, first: int) -> bool:
    """Whether the second word of the statement that begins at `first` is a relation, misspelt: `a befor [1 10] b`."""
    return b.kinds[first + 1] == "IDENT" and nearest(b.texts[first + 1], RELATIONS) is not None


def _is_token(b: Builder, first: int, name: str) -> bool:
    """Whether a token is named so before the lexeme `first`, as in `any(Class.predicate name)`."""
    at = 0
    for _ in range(_MOST_USES):
        try:
            at = b.texts.index(name, at + 1, max(1, first - 1))
        except ValueError:
            return False
        if b.kinds[at - 1] == "IDENT" and b.kinds[at + 1] == ")":
            return True
    return False


def _is_prose(b: Builder, first: int, index: int) -> bool:
    """Whether the words from `first` on, at least up to `index`, are a sentence and no statement."""
    last = first
    while b.kinds[last] != END and b.texts[last][:1].isalpha():
        last += 1
    if last - first < _PROSE or index < first or index > last:
        return False
    return b.kinds[first : first + _PROSE - 1].count("IDENT") == _PROSE - 1


def _begins_line(b: Builder, at: int) -> bool:
    offset = b.anchor.offset
    return "\n" in b.anchor.source.text[offset + b.ends[at - 1] : offset + b.starts[at]]


def _fix(b: Builder, first: int, last: int, written: str) -> Fix:
    return Fix(f"write `{written}`", (Edit(b.span(first, last), written),), safe=False)


def _tidied(text: str) -> str:
    """`text` without the blanks between lexemes that nobody writes."""
    for pattern, replacement in _TIDY:
        text = pattern.sub(replacement, text)
    return " ".join(_CALL.sub(r"\1(", text).split())
