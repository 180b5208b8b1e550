"""Text in; the meaning of a model and all that is wrong with it out."""

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path

from nddl_lang.semantics.allocation import check_deferred
from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.semantics.codes import UNKNOWN_CLASS, UNKNOWN_NAME, UNKNOWN_TYPE
from nddl_lang.semantics.schema import Schema, SideTables
from nddl_lang.semantics.scope import Context, Deferred, names_in
from nddl_lang.semantics.statement import check_statement
from nddl_lang.semantics.symbol_table import ALL_NAMES, Entry, LeftBehind, SymbolTable, declare_below, doubt
from nddl_lang.syntax.codes import MISSING_FILE, TOO_DEEP, TOO_LARGE, UNCLOSED_COMMENT, UNREADABLE_FILE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LoadedModules, load_module_graph
from nddl_lang.syntax.nodes import (
    BrokenStatement,
    ClassDecl,
    EnumDecl,
    GoalStatement,
    Identifier,
    Include,
    PredicateDecl,
    Relation,
    Statement,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.parser import MOST_LEXEMES
from nddl_lang.text.diagnostic import Diagnostic, Note, Severity
from nddl_lang.text.source import Source, Span
from nddl_lang.told_once import told_once

_TEXT_IS_MISSING = (MISSING_FILE, UNREADABLE_FILE, TOO_DEEP, TOO_LARGE, UNCLOSED_COMMENT)
_UNKNOWN = (UNKNOWN_NAME, UNKNOWN_TYPE, UNKNOWN_CLASS)
_NAMELESS = re.compile(
    r"(?:int|float|bool|string)\s*=[^=].*|typedef\s+(?:int|float|bool|string)[^A-Za-z_$]*", re.DOTALL
)
_INCLUDING = frozenset(("include", "import", "using"))
_TABLES = tuple(table.name for table in fields(SideTables))


@dataclass(frozen=True, eq=False)
class Analysis:
    """The checked meaning of a text and all that it includes.

    `statements` are those that are executed, in order, from all files; `span.source` tells where each stands.
    `by_statement` holds the tables of each: the same object as before where a statement was not checked again.
    `diagnostics` stand in that order too. Where one of them is an error, the rest is what could be understood.
    """

    loaded: LoadedModules
    statements: tuple[Statement, ...]
    schema: Schema
    by_statement: Mapping[Statement, SideTables]
    diagnostics: tuple[Diagnostic, ...]
    callables: Callables = NATIVE_CALLABLES

    @cached_property
    def tables(self) -> SideTables:
        """The tables of all statements."""
        whole = SideTables()
        for each in self.by_statement.values():
            for name in _TABLES:
                if table := getattr(each, name):
                    getattr(whole, name).update(table)
        return whole

    @property
    def dialect(self) -> Dialect:
        """The dialect that the text was read in."""
        return self.loaded.dialect

    @property
    def has_errors(self) -> bool:
        """Whether the model cannot be executed as it stands."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self.diagnostics)


@dataclass(frozen=True, eq=False, slots=True)
class _Unit:
    """What became of one statement: what it looked at, left behind, and what was found out about it."""

    reads: dict[Entry, object]
    left: LeftBehind
    tables: SideTables
    complaints: tuple[Diagnostic, ...]
    deferred: tuple[Deferred, ...]


class Analyser:
    """Analyses a model again and again while it is edited.

    A statement is checked again only if it changed, or if something that it looked up did; what the others leave
    behind is put again, without a look.
    """

    def __init__(self, callables: Callables = NATIVE_CALLABLES) -> None:
        self._callables = callables
        self._units: dict[Statement, _Unit] = {}
        self._noted: dict[Statement, dict[Entry, object]] = {}
        self._supposed: dict[Entry, object] = {}
        self._dialect: Dialect | None = None

    def _check_all(self, loaded: LoadedModules) -> SymbolTable:
        """Check all statements, or keep what is known of them; what they leave behind together."""
        if loaded.dialect is not self._dialect:
            self._units, self._dialect = {}, loaded.dialect
        statements = loaded.module.statements
        before = list(self._units.items())
        first, last = _replaced([statement for statement, _ in before], statements)
        gone = [unit for _, unit in before[first : len(before) - len(statements) + last]]
        symbols = SymbolTable()
        self._note_declarations(symbols, loaded)
        supposed = symbols.entries()
        # What a look-up may find otherwise than before, at the statement at hand; all others get their old answers.
        changed = _differences(self._supposed, supposed)
        units: dict[Statement, _Unit] = {}

        def check(statement: Statement, unit: _Unit | None) -> None:
            """Check a statement, or leave behind what it left, where it would get the same answers."""
            if unit is not None and symbols.answers(unit.reads):
                symbols.replay(unit.left)
                units[statement] = unit
            else:
                units[statement] = _check(symbols, statement, loaded.dialect, self._callables)

        def keep(pairs: Iterable[tuple[Statement, _Unit]]) -> None:
            """Leave behind what statements left that stand as they stood, unless what they looked up has changed."""
            for statement, unit in pairs:
                if not changed or unit.reads.keys().isdisjoint(changed):
                    symbols.replay(unit.left)
                    units[statement] = unit
                else:
                    check(statement, unit)
                    if units[statement] is not unit:
                        changed.update(_changed_by([unit], [units[statement]]))

        keep(before[:first])
        for statement in statements[first:last]:
            check(statement, self._units.get(statement))
        changed |= _changed_by(gone, [units[each] for each in statements[first:last]])
        keep(before[len(before) - len(statements) + last :])
        self._units, self._supposed = units, supposed
        return symbols

    def analyse(self, loaded: LoadedModules) -> Analysis:
        """The analysis of what has been read."""
        symbols = self._check_all(loaded)
        units = self._units
        echoes = _Echoes(loaded)
        complaints: list[tuple[int, tuple[Diagnostic, ...]]] = []
        for index, unit in enumerate(units.values()):
            if unit.complaints or unit.deferred:
                all_of = (*unit.complaints, *_deferred(symbols, unit, loaded, self._callables))
                complaints.append((index, tuple(echoes._without(all_of))))
        declared = (name for unit in units.values() for name in unit.tables.declared)
        found = told_once(loaded, symbols.schema, tuple(_in_order(loaded, complaints)), declared, _declared_names)
        by_statement = {statement: unit.tables for statement, unit in units.items()}
        return Analysis(loaded, loaded.module.statements, symbols.schema, by_statement, found, self._callables)

    def is_sound(self, loaded: LoadedModules) -> bool:
        """Whether nothing is wrong with the meaning of what has been read: a trial."""
        symbols = self._check_all(loaded)
        return not any(
            each.severity is Severity.ERROR
            for unit in self._units.values()
            for each in (*unit.complaints, *_deferred(symbols, unit, loaded, self._callables))
        )

    def _note_declarations(self, symbols: SymbolTable, loaded: LoadedModules) -> None:
        """Note what is declared where, and which names are doubtful because text was not understood or is missing."""
        noted: dict[Statement, dict[Entry, object]] = {}
        all_of: dict[Entry, object] = {}
        for statement in loaded.module.statements:
            entries = self._noted.get(statement)
            noted[statement] = entries = _supposed_of(statement) if entries is None else entries
            if entries:
                all_of.update(entries)
        symbols.suppose(all_of)
        self._noted = noted
        if any(diagnostic.code in _TEXT_IS_MISSING for diagnostic in loaded.diagnostics):
            symbols.suppose(doubt())


def _replaced(old: Sequence[Statement], new: Sequence[Statement]) -> tuple[int, int]:
    """Where in `new` those statements stand, from and to, that are not as in `old` before or after them."""
    most = min(len(old), len(new))
    first = 0
    while first < most and old[first] is new[first]:
        first += 1
    kept = 0
    while kept < most - first and old[-1 - kept] is new[-1 - kept]:
        kept += 1
    return first, len(new) - kept


def _changed_by(old: Iterable[_Unit], new: Iterable[_Unit]) -> set[Entry]:
    """What a look-up may find otherwise below the statements `new` than below `old`, which stood in their place."""
    gone = [each for unit in old for each in unit.left.entries.items()]
    put = [each for unit in new for each in unit.left.entries.items()]
    changed = _differences(dict(gone), dict(put))
    if [entry for entry, _ in gone] != [entry for entry, _ in put]:
        changed.add(ALL_NAMES)
    return changed


def _differences(old: Mapping[Entry, object], new: Mapping[Entry, object]) -> set[Entry]:
    changed = set(old.keys() - new.keys())
    for entry, value in new.items():
        before = old.get(entry)
        if (before is not value and before != value) or (value is None and entry not in old):
            changed.add(entry)
    return changed


def analyse(loaded: LoadedModules, callables: Callables = NATIVE_CALLABLES) -> Analysis:
    """The meaning of what has been read, and what is wrong with it."""
    return Analyser(callables).analyse(loaded)


def analyse_file(
    path: Path | str,
    dialect: Dialect | None = None,
    include_directories: Sequence[Path | str] = (),
    callables: Callables = NATIVE_CALLABLES,
    most: int = MOST_LEXEMES,
) -> Analysis:
    """Read and analyse the file at `path` with all that it includes; raises OSError if it cannot be read.

    Without `dialect` the first line of the file decides, and where it is silent, nddlc.
    """
    return analyse(load_module_graph(path, include_directories, dialect, most=most), callables)


def analyse_text(
    name: str,
    text: str,
    dialect: Dialect | None = None,
    include_directories: Sequence[Path | str] = (),
    callables: Callables = NATIVE_CALLABLES,
    most: int = MOST_LEXEMES,
) -> Analysis:
    """Analyse a text that need not be in a file; `name` is what it is called, and where its includes start from."""
    return analyse(load_module_graph(Source(name, text), include_directories, dialect, most=most), callables)


def _check(symbols: SymbolTable, statement: Statement, dialect: Dialect, callables: Callables) -> _Unit:
    symbols.begin()
    context = Context(symbols, dialect, callables=callables)
    check_statement(context, statement)
    return _Unit(symbols.reads, symbols.leave(), context.tables, tuple(context.complaints), tuple(context.deferred))


def _deferred(symbols: SymbolTable, unit: _Unit, loaded: LoadedModules, callables: Callables) -> tuple[Diagnostic, ...]:
    """What had to wait until the whole script was read."""
    if not unit.deferred:
        return ()
    symbols.begin()
    context = Context(symbols, loaded.dialect, unit.tables, callables=callables)
    for deferred in unit.deferred:
        check_deferred(context, deferred)
    return tuple(context.complaints)


def _supposed_of(statement: Statement) -> dict[Entry, object]:
    """What a statement tells of the script as a whole: the names that it declares, or may declare."""
    entries: dict[Entry, object] = {}
    for broken in _broken(statement):
        words = names_in(broken.span.text)
        for word in words:
            entries |= doubt(word)
        if not _INCLUDING.isdisjoint(words) or _NAMELESS.fullmatch(broken.span.text):
            entries |= doubt()  # what it was to declare is not told
    for name in _declared_names(statement):
        entries |= declare_below(name.name, name.span)
    return entries


def _broken(statement: Statement) -> Iterator[BrokenStatement]:
    """The statement, or what it declares for others, where it was not understood."""
    match statement:
        case BrokenStatement():
            yield statement
        case ClassDecl(members=members) if members is not None:
            for member in members:
                if isinstance(member, PredicateDecl):
                    yield from (each for each in member.body if isinstance(each, BrokenStatement))
        case _:
            pass


def _declared_names(statement: Statement) -> Iterator[Identifier]:
    match statement:
        case VariableDecl(declarators=declarators):
            for declarator in declarators:
                yield declarator.name
        case ClassDecl(name=name, members=members) if members is not None:
            yield name
        case TypedefDecl(name=name):
            yield name
        case EnumDecl(name=name, values=values):
            yield name
            yield from values
        case GoalStatement(instances=instances) | Relation(created=instances):
            for instance in instances:
                if instance.name is not None:
                    yield instance.name
        case _:
            pass


def _in_order(loaded: LoadedModules, checked: list[tuple[int, tuple[Diagnostic, ...]]]) -> Iterator[Diagnostic]:
    """All complaints in the order of execution, those of the syntax stand so already; `checked` by statement."""
    starts: dict[Source, tuple[list[int], list[int]]] = {}
    if loaded.diagnostics:
        for index, statement in enumerate(loaded.module.statements):
            begins, indices = starts.setdefault(statement.span.source, ([], []))
            begins.append(statement.span.begin)
            indices.append(index)
    reached = 0
    pending: list[tuple[int, Diagnostic]] = []
    for diagnostic in loaded.diagnostics:
        begins, indices = starts.get(diagnostic.span.source, ([], []))
        place = bisect_right(begins, diagnostic.span.begin) - 1
        reached = max(reached, indices[place] if place >= 0 else 0)
        pending.append((reached, diagnostic))
    pending.reverse()
    chains = _Chains(loaded)
    for index, complaints in checked:
        while pending and pending[-1][0] <= index:
            yield pending.pop()[1]
        for complaint in complaints:
            yield chains.extend(complaint)
    for _, diagnostic in reversed(pending):
        yield diagnostic


class _Echoes:
    """Leaves out what only repeats an earlier message: one mistake costs one message.

    That is a complaint about a place in which a mistake of the syntax was mended, and one more use of a name for which
    nothing is known that could have been meant.
    """

    def __init__(self, loaded: LoadedModules) -> None:
        self._mended: dict[Source, list[int]] = {}
        for each in loaded.diagnostics:
            if each.severity is Severity.ERROR and not "NDDL150" <= each.code.id < "NDDL170":  # of one dialect only
                self._mended.setdefault(each.span.source, []).append(each.span.begin)
        for places in self._mended.values():
            places.sort()
        self._unknown: set[str] = set()

    def _without(self, complaints: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
        """The complaints that say something new."""
        for complaint in complaints:
            if self._mended and self._is_mended(complaint.span):
                continue
            if complaint.code in _UNKNOWN and not complaint.notes and not _replaces(complaint):
                if complaint.message in self._unknown:
                    continue
                self._unknown.add(complaint.message)
            yield complaint

    def _is_mended(self, span: Span) -> bool:
        places = self._mended.get(span.source, [])
        at = bisect_left(places, span.begin)
        return at < len(places) and places[at] < span.finish and "\n" not in span.text


def _replaces(complaint: Diagnostic) -> bool:
    """Whether a fix writes something else in this place: then each place is told, with its own."""
    return any(edit.span.finish > edit.span.begin for fix in complaint.fixes for edit in fix.edits)


class _Chains:
    """Tells on the way of which includes a text was read."""

    def __init__(self, loaded: LoadedModules) -> None:
        self._includes: dict[Source, Include] = {}
        for include, source in loaded.included.items():
            self._includes.setdefault(source, include)

    def extend(self, diagnostic: Diagnostic) -> Diagnostic:
        """The diagnostic with a note for each include that led to its text."""
        notes: list[Note] = []
        source = diagnostic.span.source
        while (include := self._includes.get(source)) is not None and len(notes) < len(self._includes):
            notes.append(Note("included from here", include.span))
            source = include.span.source
        return replace(diagnostic, notes=(*diagnostic.notes, *notes)) if notes else diagnostic
