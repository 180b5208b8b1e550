"""A statement written as other languages write it in; the edit that writes it in NDDL out."""

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.tables import END
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_INCLUDES = frozenset(("include", "import", "using", "require"))
_AFTER_OBJECT = frozenset((";", ",", ")"))


def rewrite(b: Builder, first: int, index: int) -> Fix | None:
    """How the statement that begins at lexeme `first` and cannot go on with `index` is written, where that is plain."""
    kinds, kind = b.kinds, b.kinds[index]
    if kind == END:
        return None
    before = kinds[first:index]
    match kinds[first]:
        case "class" if kind == ":":
            return Fix("write `extends`", (_word(b, index, "extends"),))
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
        case "IDENT" if kind == "STRING" and index == first + 1 and b.texts[first] in _INCLUDES:
            return Fix("write `#include`", (Edit(b.at(first), "#include"),))
        case "IDENT" if before == ["IDENT", "IDENT"] and kind == "::" and b.texts[first] == "rule":
            gap = Span(b.anchor, b.starts[first], b.starts[first + 1])
            return Fix("remove `rule`", (Edit(gap, ""),))
        case "IDENT" if before == ["IDENT", ".", "IDENT"] and kind == "{":
            return Fix("write `::`", (Edit(b.at(first + 1), "::"),))
        case "IDENT" if before == ["IDENT", ":"] and kinds[index : index + 2] == ["IDENT", "{"]:
            return Fix("write `::`", (Edit(b.at(first + 1), "::"),))
    if before[-2:] == ["new", "IDENT"] and kind in _AFTER_OBJECT:
        end = b.ends[index - 1]
        return Fix("add `()`", (Edit(Span(b.anchor, end, end), "()"),))
    return None


def _word(b: Builder, index: int, word: str) -> Edit:
    """Write a word for a sign, with blanks where it touches its neighbours."""
    left = " " if b.starts[index] == b.ends[index - 1] else ""
    right = " " if index + 1 < len(b.starts) and b.starts[index + 1] == b.ends[index] else ""
    return Edit(b.at(index), f"{left}{word}{right}")


def _braces_for_parameters(b: Builder, opener: int) -> Fix | None:
    """`predicate p(int a, C b);` becomes `predicate p { int a; C b; }`."""
    kinds = b.kinds
    if ")" not in kinds[opener:]:
        return None
    closer = kinds.index(")", opener)
    inside, after = kinds[opener + 1 : closer], kinds[closer + 1 : closer + 3]
    if after[:1] == ["{"] and after != ["{", "}"]:
        # What stands in braces is left as it is: only empty parentheses go.
        return Fix("remove `()`", (Edit(b.span(opener, closer), ""),)) if not inside else None
    last = closer + {"{": 2, ";": 1}.get(after[0] if after else "", 0)
    declared = " ".join("".join(";" if kind == "," else text for kind, text in _spaced(b, opener, closer)).split())
    body = f"{{ {declared}; }}" if inside else "{ }"
    at = Span(b.anchor, b.ends[opener - 1], b.ends[last])
    return Fix(f"write `{body}`", (Edit(at, f" {body}"),))


def _spaced(b: Builder, opener: int, closer: int) -> list[tuple[str, str]]:
    """The lexemes between two, each with a blank before it unless it is a comma."""
    return [(b.kinds[at], f" {b.texts[at]}") for at in range(opener + 1, closer)]


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


def close_block(b: Builder, opener: int, index: int) -> Fix:
    """Add the `}` of a block that ends before the lexeme `index`: in a line of its own where the block has several."""
    text, offset = b.anchor.source.text, b.anchor.offset
    begin, end = offset + b.starts[opener], offset + b.ends[index - 1]
    line = text.rfind("\n", 0, begin) + 1
    indent = text[line : len(text) - len(text[line:].lstrip(" \t"))]
    written = f"\n{indent}}}" if "\n" in text[begin:end] else " }"
    return Fix("add `}`", (Edit(Span(b.anchor, end - offset, end - offset), written),), safe=False)
