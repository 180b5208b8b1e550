"""Least-cost repair: a text with slips in; the one message, or all that there were, out."""

from collections.abc import Sequence

import pytest

from nddl_lang.analysis import analyse_text
from nddl_lang.repair import repair, repaired
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.render import apply_edits

MODEL = """
int LEG_MAX = 300;
float RATE = [0.5 1.5];
class Sonar extends Timeline {
    predicate Off { }
    predicate Scan { float pings; }
}
class Survey extends Timeline {
    predicate Leg { float length; }
}
Survey::Leg {
    float rate;
    contains(Sonar.Scan scan);
    rate == sampledParameter(RATE);
    scan.pings == 2.0 * length;
    scan.end == end;
    duration <= LEG_MAX;
}
Survey survey = new Survey();
Sonar sonar = new Sonar();
"""


def told(text: str) -> Sequence[Diagnostic]:
    return repaired(analyse_text("model.nddl", text)).diagnostics


def slipped(right: str, wrong: str) -> str:
    assert MODEL.count(right) == 1
    return MODEL.replace(right, wrong)


def test_the_model_without_a_slip_is_in_order() -> None:
    assert told(MODEL) == ()


# What was typed for what; the line, which may be another than that of the first of several messages; the help.
SLIPS = [
    ("new Survey();", "new Survey;", "()"),
    ("duration <= LEG_MAX;", "duration LEG_MAX;", "`duration <= LEG_MAX;`"),
    ("duration <= LEG_MAX;", "duration <= LEG-MAX;", "LEG_MAX"),
    ("2.0 * length", "2.0 length", "2.0 * length"),
    ("2.0 * length", "(2.0 * length", "add `)`"),
    ("(Sonar.Scan scan)", "(scan Sonar.Scan)", "Sonar.Scan scan"),
    ("(Sonar.Scan scan)", "(Sonar,Scan scan)", "contains(Sonar.Scan scan);"),
    ("(Sonar.Scan scan)", "{Sonar.Scan scan}", "parentheses"),
    ("float RATE =", "let float RATE =", "`let`"),
    ("[0.5 1.5]", "(0.5 1.5)", "[0.5 1.5]"),
    ("scan.end == end;", "scan.end - end;", "`==`"),
    ("scan.end == end;", "scan.end : == end;", "scan.end == end;"),
    ("float rate;", "float; rate", "float rate;"),
    ("duration <= LEG_MAX;", "start + LEG_MAX =< end;", "write `<=`"),
    ("duration <= LEG_MAX;", "start + LEG_MAX => end;", "write `>=`"),
    ("[0.5 1.5]", "[0.5-1.5]", "[0.5 1.5]"),
    ("LEG_MAX = 300;", "LEG_MAX = 3 00;", "LEG_MAX = 300;"),
]


@pytest.mark.parametrize(("right", "wrong", "wanted"), SLIPS, ids=[wrong for _, wrong, _ in SLIPS])
def test_what_one_small_edit_mends_is_one_message_in_its_line(right: str, wrong: str, wanted: str) -> None:
    text = slipped(right, wrong)
    (one,) = told(text)
    assert one.span.line == text[: text.index(wrong)].count("\n") + 1
    assert wanted in f"{one.help} {[fix.title for fix in one.fixes]}"
    assert any(told(apply_edits(text, list(fix.edits))) == () for fix in one.fixes)


def test_a_repair_is_no_more_than_a_proposal() -> None:
    (one,) = told(slipped("2.0 * length", "2.0 length 3"))[:1]
    for slip in (one, *told(slipped("scan.end == end;", "scan.end - end;"))):
        assert all(not fix.safe for fix in slip.fixes)
    assert "perhaps" in str(told(slipped("scan.end == end;", "scan.end - end;"))[0].help)


def test_a_message_whose_own_fix_mends_the_model_stays_as_it_is() -> None:
    analysis = analyse_text("model.nddl", slipped("== end;", "== ned;"))
    (one,) = analysis.diagnostics
    assert one.fixes
    assert repaired(analysis).diagnostics == (one,)


def test_two_slips_stay_two() -> None:
    text = slipped("scan.end == end;", "scan.end - end;").replace("new Sonar()", "new Sonr(3)")
    analysis = analyse_text("model.nddl", text)
    assert len(analysis.diagnostics) == 2
    assert repaired(analysis).diagnostics == analysis.diagnostics


def test_what_nobody_can_mend_by_one_edit_stays_as_it_is() -> None:
    analysis = analyse_text("model.nddl", slipped("scan.end == end;", "these words are no constraint at all;"))
    assert analysis.has_errors
    assert repaired(analysis).diagnostics == analysis.diagnostics


def test_what_stands_in_a_neighbouring_file_takes_no_repair() -> None:
    analysis = analyse_text("model.nddl", '#include "nowhere.nddl"\n' + slipped("== end;", "- end;"))
    assert repaired(analysis).diagnostics == analysis.diagnostics


def test_nothing_is_tried_in_a_statement_of_many_characters() -> None:
    analysis = analyse_text("model.nddl", "int x =" + " " * 100_000 + "= 3;\n")
    assert analysis.has_errors
    assert not list(repair(analysis))[1:]


@pytest.mark.parametrize("count", [1, 40])
def test_trials_are_counted_so_that_a_long_rule_ends(count: int) -> None:
    body = "    scan.pings >= 0.5 * length;\n" * 1000
    broken = "    scan.pings , length , 3 ; ; , ;\n" * count
    analysis = analyse_text("model.nddl", slipped("    scan.end == end;\n", body + broken))
    assert analysis.has_errors
    trials = sum(1 for _ in repair(analysis))
    assert trials < (300 if count == 1 else 1000)


def test_a_token_without_the_name_by_which_lines_speak_of_it_is_named_where_it_is_asked_for() -> None:
    text = MODEL.replace("Scan scan", "Scan ping").replace("scan.", "ping.").replace("Scan ping", "Scan")
    (one,) = told(text)
    assert one.help is not None and "`contains(Sonar.Scan ping);`" in one.help
    (fix,) = one.fixes
    assert "contains(Sonar.Scan ping);" in apply_edits(text, [*fix.edits])


FILTERS = """
enum Filter { clear, red }
class Mount extends Timeline { predicate Track { Filter glass; } }
class Work extends Timeline { predicate Plate { Filter glass; int exposure; } }
Work::Plate {
    contains(Mount.Track track);
    track.glass == glass;
}
Mount mount = new Mount();
Work work = new Work();
"""


@pytest.mark.parametrize(
    ("wrong", "wanted"),
    [
        ("track.glass == exposure;", ["write `glass`"]),
        ("exposure == track.glass;", ["write `glass`"]),
        ("track.glass == 3;", []),
        ("exposure <= track + 3;", ["write `track.start`", "write `track.end`", "write `track.duration`"]),
    ],
)
def test_no_repair_leads_to_a_warning_in_its_line(wrong: str, wanted: Sequence[str]) -> None:
    (one,) = told(FILTERS.replace("track.glass == glass;", wrong))
    assert [fix.title for fix in one.fixes] == wanted
