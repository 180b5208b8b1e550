"""Least-cost repair: an analysis with errors in; the same out, where the smallest edit that leaves none is the help.

The checker itself judges (as in Lerner, Flower, Grossman and Chambers, "Searching for type-error messages", PLDI 2007):
each small edit near an error is tried, cheapest first, and what vanishes with the first one that leaves the model
without errors is its consequence, and is not told. A fix that a message proposes itself is tried before all others. How
much is tried is counted in characters and statements, never in time.
"""

import re
from bisect import bisect_left
from collections.abc import Generator, Iterator, Sequence
from dataclasses import replace
from functools import cached_property

from nddl_lang.analysis import Analyser, Analysis
from nddl_lang.lint.codes import NEVER_DECIDED
from nddl_lang.lint.guards import lint_guards
from nddl_lang.lint.numbers import (
    lint_arrows,
    lint_chained_comparisons,
    lint_truths_as_numbers,
)
from nddl_lang.lint.part import Part, PartLint
from nddl_lang.lint.timing import lint_times
from nddl_lang.syntax.includes import LoadedModules
from nddl_lang.syntax.nodes import Include, Module, Statement
from nddl_lang.syntax.parser import Parse, parse_block
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.placement import TOP
from nddl_lang.syntax.token_edits import Lexemes, LineGrammar, TokenEdit, naming_edits, token_edits, vocabulary
from nddl_lang.syntax.words import KINDS
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Severity
from nddl_lang.text.source import Anchor, Source, Span

_MOST_ERRORS = 12  # of a model that was meant to be another one by one small edit
_MOST_LINES = 3  # that are searched
_MOST_CHARACTERS = 200_000  # that are parsed in trials
_LONGEST = 20_000  # characters of a statement that is tried at all
_MOST_STATEMENTS = 40_000  # that are looked at in trials
_MOST_WORDS = 20_000  # among which a misspelt one is looked for
_FARTHEST = 20  # lexemes from the error
_MOST_MEANT = 3  # repairs of one cost that are told side by side
_DEAREST_BESIDE_HELP = 1899  # what costs more is no better than what the message says itself
_WIDEST = 80
_PLAIN = re.compile(r"[\w$.]+")
_NAME = re.compile(r"[A-Za-z_$][\w$]*")
_SIGNS = frozenset("=<>!&|:+-*/")
_DOUBTS: tuple[PartLint, ...] = (  # what they find in the line of an edit nobody meant
    lint_arrows,
    lint_chained_comparisons,
    lint_guards,
    lint_times,
    lint_truths_as_numbers,
)


def repaired(analysis: Analysis) -> Analysis:
    """`analysis` with one message for what one small edit would mend, where there is such an edit."""
    search = repair(analysis)
    while True:
        try:
            next(search)
        except StopIteration as end:
            found: Analysis = end.value
            return found


def repair(analysis: Analysis) -> Generator[None, None, Analysis]:
    """Like `repaired`, in steps: one for each trial, so that an editor may stop between them."""
    errors = [each for each in analysis.diagnostics if each.severity is Severity.ERROR]
    if not errors or len(errors) > _MOST_ERRORS:
        return analysis
    told = yield from _told(_Trials(analysis), errors)
    if told is None:
        return analysis
    kept = (each for each in analysis.diagnostics if each.severity is not Severity.ERROR)
    return replace(analysis, diagnostics=(told, *kept))


def _told(trials: "_Trials", errors: Sequence[Diagnostic]) -> Generator[None, None, Diagnostic | None]:
    """The one message of a model that one edit would mend; None where none is found."""
    for error in errors:
        for fix in error.fixes:
            source = error.span.source
            if all(edit.span.source is source for edit in fix.edits):
                edits = tuple((edit.span.begin, edit.span.finish, edit.text) for edit in fix.edits)
                if trials.mends(source, edits):
                    return error
                yield
    is_helped = len(errors) == 1 and errors[0].help is not None and not errors[0].fixes
    best: list[TokenEdit] = []
    place: Diagnostic | None = None
    for error, edit in trials.edits(errors):
        if trials.are_spent or (is_helped and edit.cost > _DEAREST_BESIDE_HELP):
            break
        if place is not None and (error is not place or edit.cost > best[0].cost):
            break
        if trials.mends(error.span.source, edit.edits, without_doubt=True):
            best.append(edit)
            place = error
        yield
    if place is None or len(best) > _MOST_MEANT:
        return None
    return _proposed(place, best, place.help if is_helped else None)


def _proposed(error: Diagnostic, repairs: Sequence[TokenEdit], said: str | None) -> Diagnostic:
    """The message with what may have been meant, below what it has `said` that nobody can try."""
    anchor = Anchor(error.span.source)
    words = [_described(error.span.source, each) for each in repairs]
    help_ = f"perhaps {', or '.join(phrase for phrase, _ in words)}"
    help_ = help_ if said is None else f"{said}; {help_}"
    fixes = tuple(
        Fix(
            title,
            tuple(Edit(Span(anchor, begin, end), put) for begin, end, put in each.edits),
            safe=False,
            is_choice=len(repairs) > 1,
        )
        for each, (_, title) in zip(repairs, words, strict=True)
    )
    return replace(error, help=help_, fixes=fixes)


def _described(source: Source, repair: TokenEdit) -> tuple[str, str]:
    """A repair in words, and the title of the fix that carries it out."""
    first = source.locate(min(begin for begin, _, _ in repair.edits))[0]
    last = source.locate(max(end for _, end, _ in repair.edits))[0]
    begin, end = source.line_starts[first - 1], source.line_end(last)
    line = " ".join(repair.applied(source.text[begin:end], begin).split())
    shown = f"`{line}`" if len(line) <= _WIDEST else "so"
    if len(repair.edits) > 1:
        return shown, f"write {shown}"
    ((begin, end, put),) = repair.edits
    text = source.text
    while put[:1] in _SIGNS and text[begin - 1 : begin] in _SIGNS:  # both make one sign
        begin, put = begin - 1, text[begin - 1] + put
    while put[-1:] in _SIGNS and text[end : end + 1] in _SIGNS:
        end, put = end + 1, put + text[end]
    old, new = text[begin:end].strip(), put.strip()
    if old and new:
        is_plain = _PLAIN.fullmatch(old) and _PLAIN.fullmatch(new)
        return f"`{new}` in place of `{old}`{'' if is_plain else f': {shown}'}", f"write `{new}`"
    if new:
        return f"`{new}` is missing: {shown}", f"add `{new}`"
    return f"without `{old}`: {shown}", f"remove `{old}`"


class _Trials:
    """Tries what a model would be with edits of one of its texts."""

    def __init__(self, analysis: Analysis) -> None:
        self._analyser = Analyser(analysis.callables)
        self._callables = analysis.callables
        self._loaded = analysis.loaded
        self._characters = self._statements = 0
        self._parses = {parse.source: parse for parse in analysis.loaded.parses}
        self._mistaken = {
            (each.span.source, self._piece_at(each.span))
            for each in analysis.loaded.diagnostics
            if each.severity is Severity.ERROR
        }

    @property
    def are_spent(self) -> bool:
        """Whether no more is tried."""
        return self._characters > _MOST_CHARACTERS or self._statements > _MOST_STATEMENTS

    @cached_property
    def _places(self) -> dict[Statement, int]:
        return {statement: place for place, statement in enumerate(self._loaded.module.statements)}

    @cached_property
    def _known(self) -> tuple[str, ...]:
        """All words that mean something in the model."""
        words = dict.fromkeys((*KINDS, "object", *self._callables.functions, *self._callables.constraints))
        for parse in self._loaded.parses:
            for piece in parse.pieces:
                pairs = zip(piece.texts, piece.kinds, strict=True)
                words.update(dict.fromkeys(text for text, kind in pairs if kind == "IDENT"))
            if len(words) > _MOST_WORDS:
                return ()
        return tuple(words)

    def _piece_at(self, span: Span) -> int:
        """The number of the piece in which a place of its text lies; below 0 where there is none."""
        parse = self._parses.get(span.source)
        return -1 if parse is None else _piece_number(parse, span.begin)

    def edits(self, errors: Sequence[Diagnostic]) -> Iterator[tuple[Diagnostic, TokenEdit]]:
        """The edits of the lines with errors, cheapest first."""
        lines: dict[tuple[Source, int], Diagnostic] = {}
        for error in errors:
            lines.setdefault((error.span.source, error.span.line), error)
        unknown = (each.span.text for each in errors if each.code.kind == "name")
        missing = [name for name in dict.fromkeys(unknown) if _NAME.fullmatch(name)]
        found: list[tuple[int, int, Diagnostic, TokenEdit]] = []
        named: set[tuple[Source, int]] = set()
        for number, ((source, line), error) in enumerate(list(lines.items())[:_MOST_LINES]):
            parse = self._parses.get(source)
            place = self._piece_at(error.span)
            if parse is None or place < 0:
                continue
            piece = parse.pieces[place]
            if piece.length > _LONGEST:
                continue
            first, row = _row(piece, source, line, error.span)
            if not row.kinds:
                continue
            grammar = LineGrammar(piece.kinds, first, row)
            whole = _whole(piece)
            words = vocabulary(self._known, missing, whole)
            for edit in token_edits(row, (error.span.begin, error.span.finish), words):
                if piece.mends or grammar.may_fit(edit):
                    found.append((edit.cost, number, error, edit))
            if (source, place) not in named:
                named.add((source, place))
                found += [(edit.cost, number, error, edit) for edit in naming_edits(whole, words.missing)]
        found.sort(key=lambda each: each[:2])
        for _, _, error, edit in found:
            yield error, edit

    def mends(self, source: Source, edits: tuple[tuple[int, int, str], ...], *, without_doubt: bool = False) -> bool:
        """Whether the model would be without errors after these edits of one of its texts.

        Where that is asked, nothing in the edited lines may be in doubt then either.
        """
        parse = self._parses.get(source)
        if parse is None:
            return False
        first = _piece_number(parse, min(begin for begin, _, _ in edits))
        last = _piece_number(parse, max(end for _, end, _ in edits))
        if first < 0 or any(one is not source or not first <= at <= last for one, at in self._mistaken):
            return False
        pieces = parse.pieces[first : last + 1]
        begin = pieces[0].anchor.offset
        end = pieces[-1].anchor.offset + pieces[-1].length
        self._characters += end - begin
        if self.are_spent or end - begin > _LONGEST:
            return False
        text = TokenEdit(0, edits).applied(source.text[begin:end], begin)
        tried = parse_block(Source(source.name, text), self._loaded.dialect, TOP, len(text))
        if any(each.severity is Severity.ERROR for each in tried.diagnostics):
            return False
        statements = self._with(pieces, tried.module.statements)
        if statements is None:
            return False
        self._statements += len(statements)
        loaded = replace(self._loaded, module=Module(statements), diagnostics=())
        if not self._analyser.is_sound(loaded):
            return False
        first_edit, last_edit = min(edits)[0] - begin, len(text) - (end - max(one for _, one, _ in edits))
        return not without_doubt or not self._is_doubtful(loaded, tried.module.statements, first_edit, last_edit)

    def _is_doubtful(self, loaded: LoadedModules, tried: Sequence[Statement], begin: int, end: int) -> bool:
        """Whether there is a warning of what stands in the lines from `begin` to `end` of the statements `tried`."""
        if not tried:
            return False
        analysis = self._analyser.analyse(loaded)
        found = list(analysis.diagnostics)
        for statement in tried:
            part = Part(statement, analysis.by_statement[statement], analysis.dialect)
            found += (each for lint in _DOUBTS for each in lint(part) if isinstance(each, Diagnostic))
        found = [each for each in found if each.code is not NEVER_DECIDED]  # what is late may be meant
        source = tried[0].span.source
        lines = range(source.locate(begin)[0], source.locate(end)[0] + 1)
        return any(each.span.source is source and each.span.line in lines for each in found)

    def _with(self, pieces: Sequence[Piece], statements: Sequence[Statement]) -> tuple[Statement, ...] | None:
        """The statements of the model with others in place of those of `pieces`; None where that takes a file."""
        places = [self._places.get(each, -1) for piece in pieces for each in piece.statements]
        if not places or -1 in places or any(isinstance(each, Include) for each in statements):
            return None
        model = self._loaded.module.statements
        return (*model[: places[0]], *statements, *model[places[-1] + 1 :])


def _piece_number(parse: Parse, offset: int) -> int:
    """The number of the piece that the offset lies in, or ends; below 0 where there is none."""
    number = -1
    for at, piece in enumerate(parse.pieces):
        if piece.anchor.offset > offset or (piece.anchor.offset == offset and at):
            break
        number = at
    return number


def _whole(piece: Piece) -> Lexemes:
    """All lexemes of a piece."""
    offset = piece.anchor.offset
    starts, ends = [start + offset for start in piece.starts], [end + offset for end in piece.ends]
    return Lexemes(piece.anchor.source.text, piece.kinds, piece.texts, starts, ends)


def _row(piece: Piece, source: Source, line: int, focus: Span) -> tuple[int, Lexemes]:
    """The lexemes of a piece that stand in a line, not too far from the focus, and the number of the first."""
    offset = piece.anchor.offset
    first = bisect_left(piece.starts, source.line_starts[line - 1] - offset)
    last = bisect_left(piece.starts, source.line_end(line) - offset)
    first = max(first, bisect_left(piece.starts, focus.begin - offset) - _FARTHEST)
    last = min(last, bisect_left(piece.starts, focus.finish - offset) + _FARTHEST, first + 3 * _FARTHEST)
    starts = [start + offset for start in piece.starts[first:last]]
    ends = [end + offset for end in piece.ends[first:last]]
    return first, Lexemes(source.text, piece.kinds[first:last], piece.texts[first:last], starts, ends)
