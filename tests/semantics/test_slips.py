"""One slip of the hand in a model of a vehicle costs one message, in the line where the slip is.

The model is a draft of the project: `navigator.nddl`, which includes `auv_interface.nddl`.
"""

from pathlib import Path

import pytest

from nddl_lang.analysis import analyse_text
from nddl_lang.text.diagnostic import Severity

FOLDER = Path(__file__).parent / "auv"

# What was there, and what a slip made of it.
SLIPS = [
    ("Nav::Go {", "Nav::Go"),
    ("  if (how == ACROSS) { acrossOk == true; }", "  if (how == ACROSS) { acrossOk == true;"),
    ("  if (how == ACROSS) { acrossOk == true; }", "  if (how == ACROSS) acrossOk == true; }"),
    ("Nav::Surface {", "Nav::Surface {{"),
    ("if (start <= AGENT_CLOCK) { meets", "if (start <= AGENT_CLOCK)  meets"),
    ("duration <= worst;", "duration <= worst"),
    ("r.end == end;", "r.end == end"),
    ("  contains(Helm.Run up);", "  contains(Helm.Run up)"),
    ("float CRUISE;", "float CRUISE"),
    ("CRUISE = 1.5;", "CRUISE = 1.5"),
    ("bool featherOk;  bool", "bool featherOk  bool"),
    ("SURFACE_MAX = 900;  FIX", "SURFACE_MAX = 900  FIX"),
    ("float v;  v == CRUISE;", "float v  v == CRUISE;"),
    ("duration == 5;", "duration == 5:"),
    ("duration == 5;", "duration == 5,"),
    ("contains(Helm.Run r);", "contains(Helm.Run r;"),
    ("contains(Helm.Run r);", "contains Helm.Run r);"),
    ("contains(Helm.Run r);", "contains(Helm.Run r));"),
    ("contains(Helm.Run r);", "contains((Helm.Run r);"),
    ("if (mode == FEATHER) {", "if mode == FEATHER) {"),
    ("if (mode == FEATHER) {", "if (mode == FEATHER {"),
    ("if (mode == FEATHER) {", "if mode == FEATHER {"),
    ("if (mode == FEATHER) {", "if (mode = FEATHER) {"),
    ("sx == abs(here.cx);", "sx == abs(here.cx;"),
    ("sx == abs(here.cx);", "sx == abs here.cx;"),
    ("travelTime(t, xa, ya, xb, yb, v);", "travelTime(t, xa, ya, xb, yb, v;"),
    ("travelTime(t, xa, ya, xb, yb, v);", "travelTime(t, xa, ya, xb, yb, );"),
    ("travelTime(t, xa, ya, xb, yb, v);", "travelTime(t, xa,, ya, xb, yb, v);"),
    ("travelTime(t, xa, ya, xb, yb, v);", "travelTime(t xa, ya, xb, yb, v);"),
    ("travelTime(t, xa, ya, xb, yb, v);", "travelTime(t, xa ya, xb, yb, v);"),
    ("featherOk == (sy <= SIDE_LIMIT);", "featherOk == (sy <= SIDE_LIMIT;"),
    ("featherOk == (sy <= SIDE_LIMIT);", "featherOk == sy <= SIDE_LIMIT);"),
    ("if (how == ALONG)", "fi (how == ALONG)"),
    ("if (how == ALONG)", "IF (how == ALONG)"),
    ("contains(Helm.Run fix);", "contain(Helm.Run fix);"),
    ("contains(Helm.Run fix);", "during(Helm.Run fix);"),
    ("contains(Helm.Run fix);", "contians(Helm.Run fix);"),
    ("met_by(object.Quiet q0);", "metby(object.Quiet q0);"),
    ("met_by(object.Quiet q0);", "met by(object.Quiet q0);"),
    ("any(Nav.Rejoin r);", "any(Nav.Rejion r);"),
    ("any(Nav.Rejoin r);", "any(Nva.Rejoin r);"),
    ("any(Nav.Rejoin r);", "any(Nav:Rejoin r);"),
    ("any(Nav.Rejoin r);", "any(Nav::Rejoin r);"),
    ("float ax;", "flaot ax;"),
    ("float ax;", "Float ax;"),
    ("duration <= SURFACE_MAX;", "duration <= SURFACE_MXA;"),
    ("duration <= SURFACE_MAX;", "duraton <= SURFACE_MAX;"),
    ("Gps::Fix {", "Gsp::Fix {"),
    ("Gps::Fix {", "Gps::Fxi {"),
    ("Gps::Fix {", "Gps:Fix {"),
    ("Gps::Fix {", "Gps.Fix {"),
    ("Nav::Rejoin {", "Nav::Rejoin() {"),
    ("r.kind == YoYo;", "r.kind == YoYO;"),
    ("r.kind == YoYo;", "r.kidn == YoYo;"),
    ("r.kind == YoYo;", "r.kind = YoYo;"),
    ("r.kind == YoYo;", "r.kind == 'YoYo';"),
    ("r.kind == YoYo;", 'r.kind == "YoYo";'),
    ("r.kind == YoYo;", 'r.kind == "YoYo;'),
    ("r.kind == YoYo;", "r.kind === YoYo;"),
    ("r.kind == YoYo;", "r,kind == YoYo;"),
    ("r.kind == YoYo;", "r..kind == YoYo;"),
    ("duration <= worst;", "duration =< worst;"),
    ("duration >= GO_MIN;", "duration => GO_MIN;"),
    ("duration >= GO_MIN;", "duration > = GO_MIN;"),
    ("used == start + worst;", "used == start ++ worst;"),
    ("used == start + worst;", "used == start + ;"),
    ("used == start + worst;", "used := start + worst;"),
    ("used == start + worst;", "used += worst;"),
    ("worst == t * GO_WORST_NUM + GO_EXTRA;", "worst == t * GO_WORST_NUM + GO_EXTRA);"),
    ("worst == t * GO_WORST_NUM + GO_EXTRA;", "worst == t x GO_WORST_NUM + GO_EXTRA;"),
    ("worst == t * GO_WORST_NUM + GO_EXTRA;", "worst == (t * GO_WORST_NUM + GO_EXTRA;"),
    ("// how to hold", "/* how to hold"),
    ("// how to hold", "/ how to hold"),
    ("// after a fix:", "after a fix:"),
    (
        "// after a fix: pick a way back to the planned track",
        "/* after a fix: pick a way back to the planned track * /",
    ),
    ('#include "auv_interface.nddl"', '#include "auv_interface.nddl'),
    ('#include "auv_interface.nddl"', "#include auv_interface.nddl"),
    ('#include "auv_interface.nddl"', "#include <auv_interface.nddl>"),
    ('#include "auv_interface.nddl"', 'include "auv_interface.nddl"'),
    ('#include "auv_interface.nddl"', '#inclde "auv_interface.nddl"'),
    ('#include "auv_interface.nddl"', '#include "auv_interfase.nddl"'),
    ("float CRUISE;", "float float CRUISE;"),
    ("float CRUISE;", "CRUISE;"),
    ("CRUISE = 1.5;", "CRUISE = 1,5;"),
    ("CRUISE = 1.5;", "CRUISE = 1.5.0;"),
    ("CRUISE = 1.5;", "CRUISE == = 1.5;"),
    ("GO_EXTRA = 60;", "GO_EXTRA = 60s;"),
    ("up.kind == Ascend;   up.tx", "up.kind == Ascend   up.tx"),
    ("enum Leg        { Loiter,", "enum Leg         Loiter,"),
    ("YoYo, Ascend, GetFix }", "YoYo, Ascend, GetFix"),
    ("YoYo, Ascend, GetFix }", "YoYo Ascend, GetFix }"),
    ("YoYo, Ascend, GetFix }", "YoYo, Ascend, GetFix, }"),
    ("YoYo, Ascend, GetFix }", "YoYo, Ascend; GetFix }"),
    ("class Survey extends AgentTimeline {", "class Survey extends AgentTimeline "),
    ("class Survey extends AgentTimeline {", "class Survey extend AgentTimeline {"),
    ("class Survey extends AgentTimeline {", "class Survey : AgentTimeline {"),
    ("class Survey extends AgentTimeline {", "clas Survey extends AgentTimeline {"),
    ("class Survey extends AgentTimeline {", "class Survey extends AgentTimeLine {"),
    ("class Survey extends AgentTimeline {", "class extends AgentTimeline {"),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) { super(m, "Idle");'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) { super(m, "Idle) }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) { super(m, "Idle") }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) { super(m "Idle"); }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(m) { super(m, "Idle"); }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m { super(m, "Idle"); }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) super(m, "Idle"); }'),
    ('Survey(Mode m) { super(m, "Idle"); }', 'Survey(Mode m) { supre(m, "Idle"); }'),
    ("  predicate Hold    {}", "  predicate Hold    "),
    ("  predicate Hold    {}", "  predicate Hold;"),
    ("  predicate Hold    {}", "  predicate {}"),
    ("  predicate Hold    {}", "  predicat Hold {}"),
    ("  predicate Hold    {}", "  Hold {}"),
    ("predicate Surface { int minHits; }", "predicate Surface { int minHits }"),
    ("predicate Surface { int minHits; }", "predicate Surface { minHits; }"),
    ("predicate Surface { int minHits; }", "predicate Surface { int minHits; "),
    ("predicate Surface { int minHits; }", "predicate Surface  int minHits; }"),
    ("predicate Surface { int minHits; }", "predicate Surface ( int minHits; )"),
    ("predicate Surface { int minHits; }", "predicate Surface(int minHits);"),
    ("predicate Surface { int minHits; }", "predicate Surface { int minHits = [0 10; }"),
    ("predicate Surface { int minHits; }", "predicate Surface { int minHits = [0..10]; }"),
    ("predicate Surface { int minHits; }", "predicate Surface { int: minHits; }"),
    ("predicate Go      { float xa; float ya;", "predicate Go      { float xa, float ya;"),
    ("predicate Go      { float xa; float ya;", "predicate Go      { float xa, Leg ya;"),
    ("predicate Surface { int minHits; }", "predicate Surface { int minHits; }}"),
]
# Where something is left open to the end of its block, the message stands where it was opened.
LEFT_OPEN = [
    ("  contains(Comms.CheckIn c);\n}", "  contains(Comms.CheckIn c);\n", "Nav::Surface {"),
    (
        "    if (mode == PUNCH)   { punchOk == true; }\n  } ",
        "    if (mode == PUNCH)   { punchOk == true; }\n   ",
        "  if (start <= AGENT_CLOCK) {\n    Tracking",
    ),
    ('  Survey(Mode m) { super(m, "Idle"); }\n}', '  Survey(Mode m) { super(m, "Idle"); }\n', "class Survey extends"),
]


def complaints(old: str, new: str) -> tuple[str, list[int]]:
    """The text before the slip; the lines of the messages that the slip costs, -1 for those in another file."""
    for path in (FOLDER / "navigator.nddl", FOLDER / "auv_interface.nddl"):
        text = path.read_text(encoding="utf-8")
        if old in text:
            found = analyse_text(str(path), text.replace(old, new, 1)).diagnostics
            spans = [each.span for each in found if each.severity is Severity.ERROR]
            return text, [span.line if span.source.name == str(path) else -1 for span in spans]
    raise AssertionError(old)


def test_the_model_itself_is_in_order() -> None:
    for path in FOLDER.glob("*.nddl"):
        assert analyse_text(str(path), path.read_text(encoding="utf-8")).diagnostics == ()


@pytest.mark.parametrize(("old", "new"), SLIPS)
def test_a_slip_costs_one_message_in_its_line(old: str, new: str) -> None:
    text, lines = complaints(old, new)
    assert lines == [text.count("\n", 0, text.index(old)) + 1]


@pytest.mark.parametrize(("old", "new", "opened"), LEFT_OPEN)
def test_what_is_left_open_costs_one_message_where_it_was_opened(old: str, new: str, opened: str) -> None:
    text, lines = complaints(old, new)
    assert lines == [text.count("\n", 0, text.index(opened)) + 1]


def test_a_token_that_was_left_without_its_name_costs_one_message_that_tells_so() -> None:
    path = FOLDER / "navigator.nddl"
    text = path.read_text(encoding="utf-8").replace("contains(Helm.Run r);", "contains(Helm.Run);", 1)
    text = (
        text.replace("r.kind", "run.kind", 1).replace("r.tx", "run.tx", 1).replace("r.end == end", "end == run.end", 1)
    )
    found = analyse_text(str(path), text).diagnostics
    first = next(each for each in found if each.severity is Severity.ERROR)
    assert first.help == "name the token: `Helm.Run run`"
    assert first.fixes[0].edits[0].text == " run"
    assert not [each for each in found if "`run`" in each.message and each is not first]


def test_an_unclosed_comment_in_an_included_file_costs_one_message(tmp_path: Path) -> None:
    shared = (FOLDER / "auv_interface.nddl").read_text(encoding="utf-8")
    (tmp_path / "auv_interface.nddl").write_text(shared.replace("// Shared", "/* Shared", 1), encoding="utf-8")
    text = (FOLDER / "navigator.nddl").read_text(encoding="utf-8")
    (found,) = analyse_text(str(tmp_path / "navigator.nddl"), text).diagnostics
    assert found.message == "this comment is never closed"


def test_a_value_in_quotes_where_a_constructor_takes_it_is_told() -> None:
    path = FOLDER / "navigator.nddl"
    text = path.read_text(encoding="utf-8")
    text += 'Survey again = new Survey("Internal");\n'
    (found,) = [each for each in analyse_text(str(path), text).diagnostics if each.severity is Severity.ERROR]
    assert found.help == "`Internal` is a value of `Mode`: it stands without quotes"
