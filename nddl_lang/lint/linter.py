"""An analysis in; all that is wrong with the model out: errors, what the lints find, and what a comment takes back."""

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from nddl_lang.analysis import Analysis
from nddl_lang.lint.declarations import lint_declarations
from nddl_lang.lint.gist import Gist, gist
from nddl_lang.lint.gist_counts import GistCounts
from nddl_lang.lint.guards import lint_guards
from nddl_lang.lint.local_names import lint_hidden_names, lint_unused_labels, lint_unused_locals
from nddl_lang.lint.names_of_values import lint_names_of_values
from nddl_lang.lint.numbers import (
    lint_arrows,
    lint_beyond_floats,
    lint_chained_comparisons,
    lint_float_equality,
    lint_int_among_floats,
    lint_int_results,
    lint_truths_as_numbers,
    lint_whole_floats,
)
from nddl_lang.lint.own_timeline import lint_own_timeline
from nddl_lang.lint.part import Conditional, Finding, Part, PartLint
from nddl_lang.lint.portability import lint_filters, lint_includes, lint_portability, lint_texts
from nddl_lang.lint.resources import lint_resources
from nddl_lang.lint.sampling import compare_draws, lint_draws
from nddl_lang.lint.scripts import lint_script
from nddl_lang.lint.structure import lint_structure
from nddl_lang.lint.subgoals import lint_subgoals
from nddl_lang.lint.suppression import suppress
from nddl_lang.lint.timing import lint_times, lint_times_together
from nddl_lang.lint.whole import Whole, assemble
from nddl_lang.semantics.schema import SideTables
from nddl_lang.text.diagnostic import Diagnostic

# What can be told from one statement; the findings are kept while the statement and all that it uses stay the same.
_PART_LINTS: tuple[PartLint, ...] = (
    lint_unused_locals,
    lint_unused_labels,
    lint_hidden_names,
    lint_guards,
    lint_times,
    lint_own_timeline,
    lint_subgoals,
    lint_float_equality,
    lint_beyond_floats,
    lint_int_among_floats,
    lint_int_results,
    lint_whole_floats,
    lint_chained_comparisons,
    lint_arrows,
    lint_truths_as_numbers,
    lint_draws,
    lint_texts,
    lint_filters,
    lint_portability,
)
_WHOLE_LINTS: tuple[Callable[[Whole], Iterable[Diagnostic]], ...] = (
    lint_declarations,
    lint_structure,
    lint_script,
    lint_resources,
    lint_includes,
    lint_times_together,
    lint_names_of_values,
    lambda whole: compare_draws(whole.parts),
)


class _Known:
    """What one statement gave: its part, its findings, and what it contributes to the whole."""

    __slots__ = ("certain", "conditional", "gist", "part")

    def __init__(self, part: Part, findings: list[Finding], contribution: Gist) -> None:
        self.part = part
        self.certain = [finding for finding in findings if isinstance(finding, Diagnostic)]
        self.conditional: list[Conditional] = [each for each in findings if not isinstance(each, Diagnostic)]
        self.gist = contribution


class Linter:
    """Lints a model again and again while it is edited, each time only the statements that changed.

    What nothing uses is told of the text itself, and of the files `judged`: included ones that no other model includes.
    """

    def __init__(self, judged: frozenset[Path] = frozenset()) -> None:
        self.judged = judged
        self.known: dict[SideTables, _Known] = {}
        self._usage = GistCounts()

    def lint(self, analysis: Analysis) -> tuple[Diagnostic, ...]:
        """All complaints: those of the analysis, then findings, in the order of the files and of the text.

        A model with errors is not linted: what is missing in it would look unused, and what is broken contradictory.
        """
        if analysis.has_errors:
            return suppress(analysis, analysis.diagnostics, is_linted=False)
        known: dict[SideTables, _Known] = {}
        order: list[_Known] = []
        for statement in analysis.statements:
            tables = analysis.by_statement[statement]
            each = self.known.get(tables)
            if each is None:
                each = _lint_statement(Part(statement, tables, analysis.dialect))
            known[tables] = each
            order.append(each)
        self.known = known
        gists = [each.gist for each in order]
        self._usage.update(gists)
        whole = assemble(analysis, [each.part for each in order], gists, self._usage, self.judged)
        found = [finding for finding in _findings(whole, order) if finding.span.source not in whole.library]
        places = {source: number for number, source in enumerate(analysis.loaded.sources)}
        found.sort(key=lambda finding: (places.get(finding.span.source, 0), finding.span.begin, finding.code.id))
        return suppress(analysis, (*analysis.diagnostics, *found), is_linted=True)


def _lint_statement(part: Part) -> _Known:
    findings = [finding for lint in _PART_LINTS for finding in lint(part)]
    return _Known(part, findings, gist(part))


def _findings(whole: Whole, order: list[_Known]) -> Iterator[Diagnostic]:
    facts = whole.facts()
    for each in order:
        yield from each.certain
        for conditional in each.conditional:
            if (finding := conditional(facts)) is not None:
                yield finding
    for lint in _WHOLE_LINTS:
        yield from lint(whole)


def lint(analysis: Analysis) -> tuple[Diagnostic, ...]:
    """All that is wrong with a model."""
    return Linter().lint(analysis)
