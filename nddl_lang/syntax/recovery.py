"""Mend what does not fit the grammar, so that one mistake costs one message and the rest is understood.

First a small mend is tried that lets the parser go on: one lexeme put in, left out or read as another. Otherwise the
statement is given up: it becomes a `BrokenStatement`, and reading goes on after its `;`, after its block, or at the
end of the block that it stands in.
"""

from bisect import bisect_left
from typing import Any

from nddl_lang.syntax.advice import advise, describe_found, is_operator
from nddl_lang.syntax.braces import begins_declaration
from nddl_lang.syntax.builder import Builder, Maker
from nddl_lang.syntax.codes import (
    EQUALITY_SIGN,
    EXPECTED,
    FORMER_DIRECTIVE,
    MALFORMED_NUMBER,
    MISSING,
    MISSPELT,
    RESERVED_WORD,
    STRAY_BRACE,
    SUPERFLUOUS,
    UNCLOSED_BRACE,
    UNCLOSED_STRING,
    UNEXPECTED_CHARACTER,
)
from nddl_lang.syntax.expectation import accepts, describe_expected, expected_kinds
from nddl_lang.syntax.former import put_in_parentheses
from nddl_lang.syntax.idioms import Idiom, find_idiom
from nddl_lang.syntax.joined_names import join_names
from nddl_lang.syntax.lexemes import excerpt
from nddl_lang.syntax.misspelt import all_relations, meant_time, meant_word
from nddl_lang.syntax.nodes import BrokenStatement
from nddl_lang.syntax.placement import break_statement
from nddl_lang.syntax.reserved_names import read_as_name
from nddl_lang.syntax.rewrites import ELSE_ELSEWHERE, close_block, end_in_comment, link_tokens, rewrite
from nddl_lang.syntax.skipping import end_of_statement, unclosed_block
from nddl_lang.syntax.tables import ACTIONS, END, GOTOS
from nddl_lang.syntax.turned_signs import end_at_colon, join_paths, turn_signs
from nddl_lang.syntax.untyped import type_parameters
from nddl_lang.syntax.words import KINDS, RESERVED
from nddl_lang.text.diagnostic import Code, Edit, Fix, Note
from nddl_lang.text.source import Span

_STATEMENT_WORDS = frozenset(
    ("BASETYPE", "class", "enum", "typedef", "GOAL", "predicate", "action", "if", "foreach", "#include", "filter")
)
_PUNCTUATION = frozenset("=,:.)]+-*/<>!") | {"==", "!=", "<=", ">=", "&&", "||", "::"}
_VALUE_ENDS = frozenset(("IDENT", "INT", "FLOAT", "STRING", "BOOL", "this", ")", "]", "}"))
_LISTS = frozenset(("(", "SET"))
_LITERALS = frozenset(("INT", "FLOAT", "STRING", "BOOL"))
_DECLARING = frozenset(("class", "enum", "typedef", "predicate", "action", "GOAL"))
_MODIFIERS = frozenset(("const", "constexpr", "static", "final", "var", "let"))
_OPENERS = {")": "(", "]": "[", "}": "SET"}
_OPEN = frozenset(("(", "[", "{", "SET"))
# A lexeme that was already complained about explains whatever follows in its statement.
_LEXICAL = (UNEXPECTED_CHARACTER, UNCLOSED_STRING, MALFORMED_NUMBER, FORMER_DIRECTIVE)


class Recovery:
    """Mends the lexemes of one piece; works on copies, so that the piece keeps what was written."""

    def __init__(self, b: Builder, makers: list[tuple[str, int, Maker]]) -> None:
        self._makers = makers
        b.own()
        b.kinds.append(END)
        self._b = b
        self._kinds = b.kinds
        self._known = [diagnostic.span.start for diagnostic in b.piece.diagnostics if diagnostic.code in _LEXICAL]
        self._is_quiet = False
        self._renamed: set[str] = set()  # reserved words that are names in this piece
        self._said_unclosed = b.piece.is_cut_short

    def recover(self, states: list[int], values: list[Any], index: int) -> int:
        """Mend at the lexeme `index`, which does not fit; returns where to go on."""
        self._reduce(states, values)
        depth = len(states) - 1
        while "statement" not in GOTOS[states[depth]]:
            depth -= 1
        first = self._first_index(values[depth]) if depth < len(values) else index
        idiom = find_idiom(self._b, first, index, self._open_block(values[:depth]) is not None)
        self._is_quiet = idiom is None and self._was_complained_about(first, index)
        if idiom is not None:
            return self._give_up(states, values, depth, first, index, idiom)
        if (
            turn_signs(self._b, first, index, is_quiet=self._is_quiet)
            or self._end_declaration(first, index)
            or (
                self._may_begin_statement(index)
                and end_at_colon(self._b, states, first, index, is_quiet=self._is_quiet)
            )
            or (not self._is_quiet and type_parameters(self._b, first, index))
            or (not self._is_quiet and self._reread_word(states[: depth + 1], values[:depth], first, index))
        ):
            del states[depth + 1 :]
            del values[depth:]
            return first
        if any(at > first and is_operator(self._b, at) for at in (index, index - 1)):
            return self._give_up(states, values, depth, first, index)
        if not self._is_quiet and (
            self._leave_modifier_out(first, index)
            or link_tokens(self._b, first, index)
            or join_names(self._b, first, index)
        ):
            del states[depth + 1 :]
            del values[depth:]
            return first
        if (
            self._insert(states, values, index)
            or self._reread(states, index)
            or self._leave_out(states, values, first, index)
        ):
            return index
        if not self._is_quiet and put_in_parentheses(self._b, first, index):
            del states[depth + 1 :]
            del values[depth:]
            return first
        return self._give_up(states, values, depth, first, index)

    def _reduce(self, states: list[int], values: list[Any]) -> None:
        """Finish what is complete whatever follows: the tables wait for a lexeme that fits."""
        while True:
            row = ACTIONS[states[-1]]
            reductions = {action for action in row.values() if action < 0}
            if len(reductions) != 1 or any(action >= 0 for kind, action in row.items() if kind != "else"):
                return
            head, size, make = self._makers[-reductions.pop()]
            parts = values[len(values) - size :]
            del values[len(values) - size :], states[len(states) - size :]
            values.append(make(self._b, parts))
            states.append(GOTOS[states[-1]][head])

    # ---- small mends ----

    def _insert(self, states: list[int], values: list[Any], index: int) -> bool:
        """Put a missing lexeme in before `index` if that makes the next two fit."""
        kinds = self._kinds
        following = kinds[index : index + 2]
        if END in following and (open_brace := self._open_block(values)) is not None:
            following.remove(END)
            if not following and accepts(states, ["}"]):
                self._report_unclosed(open_brace, index)
                self._b.insert(index, "}")
                return True
        if index > 0 and self._may_begin_statement(index) and accepts(states, [";", *following]):
            self._report_missing(index, ";", "after this statement")
            self._b.insert(index, ";")
            return True
        opener = self._opener(values)
        if opener is not None and kinds[opener] in _LISTS and self._are_values(index):
            if not self._is_first_in_line(index) and accepts(states, [",", *following]):
                self._report_missing(index, ",", "here")
                self._b.insert(index, ",")
                return True
        for kind, opens in _OPENERS.items():
            if opener is None or kinds[opener] != opens:
                continue
            note = Note(f"this `{self._b.texts[opener]}` is open", self._b.at(opener))
            if accepts(states, [kind, *following]):
                self._report_missing(index, kind, "here", (note,))
                self._b.insert(index, kind)
                return True
            if self._may_begin_statement(index) and accepts(states, [kind, ";", *following]):
                self._report_missing(index, f"{kind};", "here", (note,))
                self._b.insert(index, ";")
                self._b.insert(index, kind)
                return True
        return False

    def _reread(self, states: list[int], index: int) -> bool:
        """Read the lexeme `index` as what it was evidently meant to be."""
        b, kinds = self._b, self._kinds
        following = kinds[index + 1 : index + 2]
        text = b.texts[index] if kinds[index] != END else ""
        if kinds[index] == "=" and accepts(states, ["==", *following]):
            fix = Fix("write `==`", (Edit(b.at(index), "=="),))
            self._report(EQUALITY_SIGN, index, help="write `==`", fixes=(fix,))
            kinds[index] = b.texts[index] = "=="
            return True
        if kinds[index] == "==" and accepts(states, ["=", *following]):
            fix = Fix("write `=`", (Edit(b.at(index), "="),))
            self._report(EXPECTED, index, expected="`=`", found="`==`", help="write `=`", fixes=(fix,))
            kinds[index] = b.texts[index] = "="
            return True
        if kinds[index - 1 : index + 2] == ["IDENT", "::", "IDENT"] and accepts(states, [".", "IDENT"]):
            join_paths(b, index, is_quiet=self._is_quiet)
            return True
        if kinds[index] == "[" and "]" in kinds[index:] and accepts(states, ["{", *following]):
            closer = kinds.index("]", index)
            fix = Fix("write `{ }`", (Edit(b.at(index), "{"), Edit(b.at(closer), "}")))
            self._report(EXPECTED, index, expected="`{`", found="`[`", help="a block stands in braces", fixes=(fix,))
            kinds[index], kinds[closer] = "{", "}"
            return True
        if text in RESERVED and kinds[index] != "IDENT" and accepts(states, ["IDENT", *following]):
            fixes = read_as_name(b, index)
            if text not in self._renamed and kinds[index - 1] != ".":  # else it is told where it is declared
                self._report(RESERVED_WORD, index, text=text, help="choose another name", fixes=fixes)
            self._renamed.add(text)
            return True
        return False

    def _end_declaration(self, first: int, index: int) -> bool:
        """Read the comma before a type as the `;` that it was meant to be: `float metres, float weight;`."""
        kinds = self._kinds
        is_between = begins_declaration(kinds, first) and begins_declaration(kinds, index)
        if index - 1 <= first or kinds[index - 1] != "," or not is_between:
            return False
        if not self._is_quiet:
            fix = Fix("write `;`", (Edit(self._b.at(index - 1), ";"),))
            help_ = "each declaration of a type ends with `;`"
            self._b.report(SUPERFLUOUS, self._b.at(index - 1), text=",", help=help_, fixes=(fix,))
        kinds[index - 1] = self._b.texts[index - 1] = ";"
        return True

    def _reread_word(self, states: list[int], values: list[Any], first: int, index: int) -> bool:
        """Read a name in the statement that begins at `first` as the word of the language that it was meant to be."""
        b = self._b
        meant = meant_time(self._kinds, b.texts, first, index) or meant_word(states, self._kinds, b.texts, first, index)
        if meant is None:
            return False
        at, word = meant
        if word is None and self._open_block(values) is None:
            self._report(
                MISSPELT, at, text=b.texts[at], help="what asks for tokens here is `goal`, `fact`, `rejectable`"
            )
            word = "goal"
        elif word is None:
            self._report(MISSPELT, at, text=b.texts[at], help=f"the relations are {all_relations()}")
            word = "any"
        else:
            fix = Fix(f"write `{word}`", (Edit(b.at(at), word),), safe=False)
            code = MISSPELT if word in KINDS else RESERVED_WORD
            self._report(code, at, text=b.texts[at], help=f"did you mean `{word}`?", fixes=(fix,))
        self._kinds[at], b.texts[at] = KINDS.get(word, "IDENT"), word
        return True

    def _leave_modifier_out(self, first: int, index: int) -> bool:
        """Leave out the `const` of `const int x = 3;`, or any word before `class` and the like in its line."""
        b, kinds = self._b, self._kinds
        if not first < index <= first + 2 or kinds[first] != "IDENT":
            return False
        is_before_word = index == first + 1 and kinds[index] in _DECLARING and not self._is_first_in_line(index)
        is_modifier = b.texts[first] in _MODIFIERS and kinds[index] in ("IDENT", "BASETYPE")
        if not is_before_word and not is_modifier:
            return False
        gap = Span(b.anchor, b.starts[first], b.starts[first + 1])
        self._report(
            SUPERFLUOUS, first, text=b.texts[first], fixes=(Fix(f"remove `{b.texts[first]}`", (Edit(gap, ""),)),)
        )
        b.remove(first, first + 1)
        return True

    def _leave_out(self, states: list[int], values: list[Any], first: int, index: int) -> bool:
        """Leave out the lexeme `index`, or a comma before it, if that makes the next ones fit."""
        b, kinds = self._b, self._kinds
        if kinds[index] == "/" and index == first and (index == 0 or self._is_first_in_line(index)):
            fix = Fix("write `//`", (Edit(b.at(index), "//"),))
            self._report(SUPERFLUOUS, index, text="/", help="a comment begins with `//`", fixes=(fix,))
            last = index + 1
            while kinds[last] != END and not self._is_first_in_line(last):
                last += 1
            b.remove(index, last)
            return True
        is_after_comma = index > 0 and kinds[index - 1] == "," and values and values[-1] == index - 1
        if is_after_comma and accepts(states[:-1], kinds[index : index + 2]):
            self._report_superfluous(index - 1)
            del states[-1], values[-1]
            return True
        if kinds[index] in _PUNCTUATION and accepts(states, kinds[index + 1 : index + 3]):
            self._report_superfluous(index)
            b.remove(index, index + 1)
            return True
        return False

    # ---- giving up ----

    def _give_up(
        self, states: list[int], values: list[Any], depth: int, first: int, index: int, idiom: Idiom | None = None
    ) -> int:
        """Turn the statement that begins at lexeme `first` into a broken one and go on behind it."""
        b, kinds = self._b, self._kinds
        is_inside = self._open_block(values[:depth]) is not None
        end = end_of_statement(kinds, first, index, self._begins_next)
        is_stray = end == index == first and kinds[index] == "}" and not is_inside
        if is_stray:
            end += 1
        start = b.starts[first] if end > first else b.ends[first - 1] if first else 0
        finish = b.ends[end - 1] if end > first else start
        span = b.piece.span(start, finish)
        node: BrokenStatement = break_statement(b, span)
        if idiom is not None:
            b.piece.forget(UNEXPECTED_CHARACTER, span)
        if is_stray:
            run = b.piece.span(start, b.piece.length)  # of those that follow too
            text = excerpt("".join(run.text.split()))
            fix = Fix(f"remove the `{text}`", (Edit(run, ""),), safe=False)
            if not self._is_quiet:
                b.report(STRAY_BRACE, run, text=text, fixes=(fix,))
        else:
            self._report_expected(states, first, index, idiom)
        del states[depth + 1 :]
        del values[depth:]
        states.append(GOTOS[states[depth]]["statement"])
        values.append(node)
        return end

    # ---- reports ----

    def _report(self, code: Code, index: int, **values: Any) -> None:
        if not self._is_quiet:
            self._b.report(code, self._b.at(index), **values)

    def _report_missing(self, index: int, text: str, place: str, notes: tuple[Note, ...] = ()) -> None:
        if self._is_quiet:
            return
        b = self._b
        at = b.ends[index - 1]
        span = b.piece.span(at, at)
        help_, fixes = end_in_comment(b, index) if text == ";" else (None, ())
        fixes = fixes or (Fix(f"add `{text}`", (Edit(span, text),)),)
        b.report(MISSING, span, text=text, place=place, help=help_, notes=notes, fixes=fixes)

    def _report_superfluous(self, index: int) -> None:
        text = self._b.texts[index]
        # What else is left out may have been meant as something else.
        fix = Fix(f"remove `{text}`", (Edit(self._b.at(index), ""),), safe=text in (",", ";"))
        self._report(SUPERFLUOUS, index, text=text, fixes=(fix,))

    def _report_unclosed(self, opener: int, index: int) -> None:
        if not self._said_unclosed:
            self._said_unclosed = True
            opener, end = unclosed_block(self._b, opener, index)
            fixes = (close_block(self._b, opener, end),) if end is not None else ()
            self._report(UNCLOSED_BRACE, opener, text="{", fixes=fixes)

    def _report_expected(self, states: list[int], first: int, index: int, idiom: Idiom | None) -> None:
        if self._is_quiet:
            return
        b, kinds = self._b, self._kinds
        expected = describe_expected(expected_kinds(states))
        help_text = advise(kinds, b.texts, first, index) if idiom is None else idiom.help
        is_behind = index > 0 and (kinds[index] == END or (index > first and self._is_first_in_line(index)))
        span = b.piece.span(b.ends[index - 1], b.ends[index - 1]) if is_behind else b.at(index)
        fix = rewrite(b, first, index) if idiom is None or idiom.fix is None else idiom.fix
        fixes = (fix,) if fix is not None else ()
        if fix is not None and help_text is None:
            help_text = fix.title
        if b.texts[first] in ELSE_ELSEWHERE and first < index:
            b.report(MISSPELT, b.at(first), text=b.texts[first], help=help_text, fixes=fixes)
            return
        b.report(EXPECTED, span, expected=expected, found=describe_found(b, kinds, index), help=help_text, fixes=fixes)

    # ---- where things are ----

    def _opener(self, values: list[Any]) -> int | None:
        """The lexeme that opened the innermost bracket."""
        return next((value for value in reversed(values) if type(value) is int and self._kinds[value] in _OPEN), None)

    def _open_block(self, values: list[Any]) -> int | None:
        """The lexeme that opened the innermost block."""
        return next((value for value in reversed(values) if type(value) is int and self._kinds[value] == "{"), None)

    def _are_values(self, index: int) -> bool:
        """Whether a value ends before the lexeme `index` and one begins with it; a name may be that of a token."""
        before, kind = self._kinds[index - 1], self._kinds[index]
        return (kind in _LITERALS and before in _VALUE_ENDS) or (kind == "IDENT" and before in _LITERALS)

    def _may_begin_statement(self, index: int) -> bool:
        """Whether the lexeme `index` looks as if the statement before it had ended."""
        kinds = self._kinds
        return kinds[index] in ("}", END) or kinds[index] in _STATEMENT_WORDS or self._is_first_in_line(index)

    def _begins_next(self, index: int) -> bool:
        """Whether the lexeme `index` is the first in its line, and a word that only begins statements."""
        return self._kinds[index] in _STATEMENT_WORDS and index > 0 and self._is_first_in_line(index)

    def _is_first_in_line(self, index: int) -> bool:
        b = self._b
        offset = b.anchor.offset
        return "\n" in b.anchor.source.text[offset + b.ends[index - 1] : offset + b.starts[index]]

    def _first_index(self, value: Any) -> int:
        """The first lexeme of a part that the parser holds."""
        while type(value) is list:
            if not value:
                return 0
            value = value[0]
        if type(value) is int:
            return value
        return bisect_left(self._b.starts, value.span.start)

    def _was_complained_about(self, first: int, index: int) -> bool:
        """Whether a lexeme of the statement, or one left out of it, is known to be wrong."""
        if not self._known:
            return False
        b = self._b
        start = b.ends[first - 1] if first else 0
        end = b.ends[index] if index < len(b.ends) else b.piece.length
        return (found := bisect_left(self._known, start)) < len(self._known) and self._known[found] <= end
