"""A statement written as other languages write it in; the edit that writes it in NDDL out."""

import re

from nddl_lang.syntax.advice import negated
from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import SUPERFLUOUS
from nddl_lang.syntax.tables import END
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_COMMENT_WITH_END = re.compile(r"[ \t]*(//[^/\n][^\n]*;)[ \t\r]*(?:\n|\Z)")
_INCLUDES = frozenset(("include", "import", "using", "require"))
_TYPES = ("BASETYPE", "IDENT")
_AFTER_OBJECT = frozenset((";", ",", ")"))
_RULE = [".", "IDENT", "{"]
_MEMBERS = frozenset(("predicate", "action", "}"))
_HEADS = frozenset(("class", "if", "foreach", "enum", "predicate", "action"))
_BETWEEN = "a relation stands between two tokens: `{text}`"
_ELSE_IF = frozenset(("elif", "elsif", "elseif"))
ELSE_ELSEWHERE = _ELSE_IF | {"otherwise"}  # how other languages begin what is done else
_SIGNS = {"is": "==", "and": "&&", "or": "||", "plus": "+", "minus": "-", "times": "*", "over": "/"}


def rewrite(b: Builder, first: int, index: int) -> Fix | None:
    """How the statement that begins at lexeme `first` and cannot go on with `index` is written, where that is plain."""
    kinds, kind = b.kinds, b.kinds[index]
    if kind == END:
        return None
    before = kinds[first:index]
    if kind == ":" and kinds[index + 1] == "{" and (kinds[first] in _HEADS or kinds[index - 1] in ("else", ")")):
        return Fix("remove `:`", (Edit(b.at(index), ""),))
    match kinds[first]:
        case "enum" if kind == "=" and index == first + 2 and kinds[index + 1] in ("{", "SET"):
            return Fix("remove `=`", (Edit(_from(b, index - 1, index), ""),))
        case "class" if kind == ":":
            return Fix("write `extends`", (_word(b, index, "extends"),))
        case "class" if index == first + 2 and kinds[index : index + 3] == ["(", "IDENT", ")"]:
            text = f" extends {b.texts[index + 1]}"
            return Fix(f"write `{text.strip()}`", (Edit(_from(b, index - 1, index + 2), text),))
        case "enum" if kind == "STRING" and "}" in kinds[index:]:
            strings = [at for at in range(index, kinds.index("}", index)) if kinds[at] == "STRING"]
            edits = tuple(Edit(b.at(at), b.texts[at].strip('"')) for at in strings)
            return Fix("write the names without quotes", edits)
        case "enum" if kind == ";" and "}" in kinds[index:]:
            return _commas_between_names(b, index)
        case "if" if index == first + 1 and "{" in kinds[index:]:
            return _parentheses_of_condition(b, index)
        case "predicate" | "action" if index == first + 2 and kind in _MEMBERS:
            end = b.ends[index - 1]
            return Fix("add `{ }`", (Edit(Span(b.anchor, end, end), " { }"),))
        case "predicate" | "action" if index == first + 2 and kind == "(":
            return _braces_for_parameters(b, index)
        case "predicate" | "action" if index == first + 2 and kind == ";":
            return Fix("write `{ }`", (Edit(b.at(index), " { }"),))
        case "GOAL" if index == first + 1:
            return _parentheses(b, index)
        case "GOAL" | "RELATION" if kind in (":", "::") and kinds[index - 1] == "IDENT":
            return Fix("write `.`", (Edit(b.at(index), "."),))
        case "#include" if kind == "<" and ">" in kinds[index:]:
            path = b.span(index, kinds.index(">", index))
            text = f'"{path.text[1:-1].strip()}"'
            return Fix(f"write `{text}`", (Edit(path, text),)) if "\n" not in text else None
        case "#include" if kind == "IDENT" and index == first + 1:
            return _quoted_path(b, index)
        case "IDENT" if kind == "STRING" and index == first + 1 and b.texts[first] in _INCLUDES:
            return Fix("write `#include`", (Edit(b.at(first), "#include"),))
        case "IDENT" if before == ["IDENT", "IDENT"] and kind == "::":
            gap = Span(b.anchor, b.starts[first], b.starts[first + 1])
            return Fix(f"remove `{b.texts[first]}`", (Edit(gap, ""),), safe=b.texts[first] == "rule")
        case "IDENT" if before == ["IDENT", "IDENT"] and b.texts[first] == "rule" and kinds[index : index + 3] == _RULE:
            gap = Span(b.anchor, b.starts[first], b.starts[first + 1])
            return Fix("write `::` and no `rule`", (Edit(gap, ""), Edit(b.at(index), "::")))
        case "IDENT" if before[1:2] == ["("] and before[-1] == ")" and kind == ";":
            return _commas_between_arguments(b, first, index)
        case "IDENT" if before[:3] == ["IDENT", "IDENT", "("] and kind in (",", ")"):
            text = f" = new {b.texts[first]}"
            end = b.ends[first + 1]
            return Fix(f"write `{text.strip()}`", (Edit(Span(b.anchor, end, end), text),))
        case "IDENT" if before == ["IDENT", ".", "IDENT"] and kind == "{":
            return Fix("write `::`", (Edit(b.at(first + 1), "::"),))
        case "IDENT" if before == ["IDENT", ":"] and kinds[index : index + 2] == ["IDENT", "{"]:
            return Fix("write `::`", (Edit(b.at(first + 1), "::"),))
    if b.texts[first] in _ELSE_IF and kinds[first + 1] == "(":
        return Fix("write `else if`", (Edit(b.at(first), "else if"),))
    for at in (index, index - 1):
        if at >= first and b.texts[at] == "not" and (contrary := negated(kinds, b.texts, at)) is not None:
            last, text = contrary
            return Fix(f"write `{text}`", (Edit(b.span(at, last), text),))
        if at > first and b.texts[at] == "not" and kinds[at - 1] == "IDENT" and kinds[at + 1] == "IDENT":
            return Fix("write `!=`", (Edit(b.at(at), "!="),))
        if at > first and kinds[at] == "IDENT" and (sign := _SIGNS.get(b.texts[at])) is not None:
            is_negated = b.texts[at : at + 2] == ["is", "not"]
            sign = "!=" if is_negated else sign
            return Fix(f"write `{sign}`", (Edit(b.span(at, at + is_negated), sign),))
    if kind == "," and before[-1:] == ["INT"] and kinds[index + 1] == "INT":
        return Fix(f"write `{b.texts[index - 1]}.{b.texts[index + 1]}`", (Edit(b.at(index), "."),), safe=False)
    if before[-2:] == ["new", "IDENT"] and kind in _AFTER_OBJECT:
        end = b.ends[index - 1]
        return Fix("add `()`", (Edit(Span(b.anchor, end, end), "()"),))
    return None


def _quoted_path(b: Builder, index: int) -> Fix:
    """The path of an include that stands without quotes, up to the end of its line, in quotes."""
    last = index
    while b.kinds[last + 1] != END and b.ends[last] == b.starts[last + 1] and b.kinds[last + 1] != ";":
        last += 1
    written = f'"{b.span(index, last).text}"'
    return Fix(f"write `{written}`", (Edit(b.span(index, last), written),), safe=False)


def _word(b: Builder, index: int, word: str) -> Edit:
    """Write a word for a sign, with blanks where it touches its neighbours."""
    left = " " if b.starts[index] == b.ends[index - 1] else ""
    right = " " if index + 1 < len(b.starts) and b.starts[index + 1] == b.ends[index] else ""
    return Edit(b.at(index), f"{left}{word}{right}")


def _from(b: Builder, before: int, last: int) -> Span:
    """What stands behind one lexeme, up to the end of another."""
    return Span(b.anchor, b.ends[before], b.ends[last])


def _commas_between_names(b: Builder, index: int) -> Fix | None:
    """`enum E { A; B; }` becomes `enum E { A, B }`."""
    kinds = b.kinds
    last = kinds.index("}", index)
    inside = kinds[index:last]
    if any(kind not in (";", "IDENT") for kind in inside):
        return None
    edits = [
        Edit(b.at(at), "" if at + 1 == last else ",") for at, kind in enumerate(inside, start=index) if kind == ";"
    ]
    return Fix("separate the names by commas", tuple(edits))


def _commas_between_arguments(b: Builder, first: int, index: int) -> Fix | None:
    """`f(a b);`, which begins like a constructor, becomes `f(a, b);`."""
    places = [at for at in range(first + 2, index - 2) if b.kinds[at : at + 2] == ["IDENT", "IDENT"]]
    edits = [Edit(Span(b.anchor, b.ends[at], b.ends[at]), ",") for at in places]
    return Fix("separate the arguments by commas", tuple(edits)) if edits else None


def _parentheses_of_condition(b: Builder, index: int) -> Fix | None:
    """`if a == b { }` becomes `if (a == b) { }`."""
    last = b.kinds.index("{", index) - 1
    if last < index or {";", "}"} & set(b.kinds[index:last]):
        return None
    begin, end = b.starts[index], b.ends[last]
    edits = (Edit(Span(b.anchor, begin, begin), "("), Edit(Span(b.anchor, end, end), ")"))
    return Fix("put the condition into parentheses", edits)


def link_tokens(b: Builder, first: int, index: int) -> bool:
    """Read `a.before(b)` and `a.before b` as `a before b`; `a.b.equals(c)`, where the left is no token, as `a.b == c`.

    The statement begins at the lexeme `first`, and the parser did not know what to make of the lexeme `index`; whether
    it is such a statement.
    """
    kinds, texts = b.kinds, b.texts
    if kinds[index] != "RELATION" or kinds[index - 1] != ".":
        return False
    if kinds[first] == "IDENT" and index == first + 2 and kinds[index + 1 : index + 3] == ["IDENT", ";"]:
        text = f"{texts[first]} {texts[index]} {texts[index + 1]}"
        fix = Fix(f"write `{text}`", (Edit(b.span(first, index + 1), text),))
        b.report(SUPERFLUOUS, b.at(index - 1), text=".", help=_BETWEEN.format(text=text), fixes=(fix,))
        b.remove(index - 1, index)
        return True
    if kinds[index + 1] != "(":
        return False
    if kinds[index + 2] not in ("IDENT", "this") or kinds[index + 3] != ")" or index < first + 2:
        return False
    is_between_tokens = index == first + 2
    if is_between_tokens:
        own = "" if kinds[first] == "this" else f"{texts[first]} "
        text = f"{own}{texts[index]} {texts[index + 2]}"
        help_text = _BETWEEN.format(text=text)
    elif texts[index] in ("equal", "equals"):
        text = f"{b.span(first, index - 2).text} == {texts[index + 2]}"
        kinds[index] = texts[index] = "=="
        help_text = f"write `{text}`"
    else:
        return False
    fix = Fix(f"write `{text}`", (Edit(b.span(first, index + 3), text),))
    b.report(SUPERFLUOUS, b.at(index - 1), text=".", help=help_text, fixes=(fix,))
    b.remove(index + 3, index + 4)
    b.remove(index + 1, index + 2)
    b.remove(index - 1, index)
    return True


def _braces_for_parameters(b: Builder, opener: int) -> Fix | None:
    """`predicate p(int a, C b);` and `predicate p(a: int, b - C);` become `predicate p { int a; C b; }`."""
    kinds = b.kinds
    if ")" not in kinds[opener:]:
        return None
    closer = kinds.index(")", opener)
    inside, after = kinds[opener + 1 : closer], kinds[closer + 1 : closer + 3]
    parameters = _parameters(b, opener + 1, closer)
    if parameters is None:
        return None
    if after[:1] == ["{"] and after != ["{", "}"]:
        # What stands in braces is left as it is: only empty parentheses go.
        return Fix("remove `()`", (Edit(b.span(opener, closer), ""),)) if not inside else None
    last = closer + {"{": 2, ";": 1}.get(after[0] if after else "", 0)
    body = f"{{ {'; '.join(parameters)}; }}" if inside else "{ }"
    at = Span(b.anchor, b.ends[opener - 1], b.ends[last])
    return Fix(f"write `{body}`", (Edit(at, f" {body}"),))


def _parameters(b: Builder, first: int, closer: int) -> list[str] | None:
    """Parameters between commas, the type first; None where something else stands there."""
    found = []
    while first < closer:
        last = b.kinds.index(",", first, closer) if "," in b.kinds[first:closer] else closer
        texts = b.texts[first:last]
        match b.kinds[first:last]:
            case [type_, "IDENT"] if type_ in _TYPES:
                found.append(f"{texts[0]} {texts[1]}")
            case ["IDENT", ":" | "-", type_] if type_ in _TYPES:
                found.append(f"{texts[2]} {texts[0]}")
            case _:
                return None
        first = last + 1
    return found


def _parentheses(b: Builder, index: int) -> Fix | None:
    """`goal C.p one;` becomes `goal(C.p one);`."""
    kinds = b.kinds
    last = index
    while kinds[last + 1] in ("IDENT", ".", ","):
        last += 1
    if kinds[index] != "IDENT" or kinds[last] != "IDENT" or kinds[last + 1] not in (";", END):
        return None
    begin, end = b.ends[index - 1], b.ends[last]
    opened = Edit(Span(b.anchor, begin, b.starts[index]), "(")
    return Fix("put the token into parentheses", (opened, Edit(Span(b.anchor, end, end), ")")))


def end_in_comment(b: Builder, index: int) -> tuple[str | None, tuple[Fix, ...]]:
    """Where the `;` before the lexeme `index` stands in a comment: what to say, and how it may have been meant."""
    offset = b.anchor.offset
    at = b.ends[index - 1]
    text = b.anchor.source.text
    line_end = text.find("\n", offset + at)
    b.piece.reach = max(b.piece.reach, (len(text) if line_end < 0 else line_end) - offset + 1)
    comment = _COMMENT_WITH_END.match(text, offset + at)
    if comment is None:
        return None, ()
    begin = comment.start(1) - offset
    missing = Span(b.anchor, at, at)
    fixes = (
        Fix("write `;` before the comment", (Edit(missing, ";"),), safe=False),
        Fix("write `/`", (Edit(Span(b.anchor, begin, begin + 2), "/"),), safe=False),
    )
    return "`//` begins a comment, in which the `;` stands; a division is written `/`", fixes


def close_block(b: Builder, opener: int, index: int) -> Fix:
    """Add the `}` of a block that ends before the lexeme `index`: in a line of its own where the block has several."""
    text, offset = b.anchor.source.text, b.anchor.offset
    begin, end = offset + b.starts[opener], offset + b.ends[index - 1]
    # What stands before the piece may change without it.
    line = max(text.rfind("\n", offset, begin) + 1, offset)
    before = text[line:begin]
    indent = before[: len(before) - len(before.lstrip(" \t"))]
    written = f"\n{indent}}}" if "\n" in text[begin:end] else " }"
    return Fix("add `}`", (Edit(Span(b.anchor, end - offset, end - offset), written),), safe=False)
