"""What is shown beside a place: the text marks it with `^` in the line below, as editors count."""

import pytest
from lsprotocol.types import DiagnosticSeverity, Position

from lsp.definition import definition_of
from lsp.documents import Documents
from lsp.hover import hover_at
from lsp.inlay_hints import HintSettings, inlay_hints
from lsp.meaning import meaning_at
from nddl_lang.semantics.constraints import CONSTRAINTS
from nddl_lang.semantics.functions import FUNCTIONS
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.syntax.words import PLAIN

URI = "untitled:model"
MODEL = """\
/// How a thing is run.
enum Mode { Internal, External }
typedef float [0.0 1.0] Share;
/// Hits per second.
float RATE = [0.1 4.0];
int MOST;
MOST = 7;

/// A receiver.
class Gps extends Timeline {
  Mode mode;
  predicate Idle { }
  /// Collecting hits.
  predicate Active { int hits; Share quality = 0.5; }
  Gps(Mode m) { mode = m; }
}
class Tank extends Reservoir {
  Tank() { super(1.0, 0.0, 2.0); }
}
Gps gps = new Gps(Internal);

Gps::Active {
  float rate;
  rate == sampledParameter(RATE);
  hits <= MOST;
  object.mode == External;
  met_by(Idle before_it);
  before_it.duration >= 2;
  meets(Idle);
  before_it before [1 5] this;
  any(Tank.produce p);
  p.time == end;
  this before p;
  addEq(rate, 1.0, abs(rate));
  foreach (g in gps) { contains_end(g.Active); }
}
goal(gps.Active first);
first.hits.specify(3);
first.activate();
close();
"""


def shown(where: str, text: str = MODEL, uri: str = URI) -> str:
    """What is shown at `where`, a line of the text with a `|` before the place."""
    documents = Documents()
    documents.open(uri, 1, text)
    view = documents.view(uri)
    assert view is not None
    line = where.replace("|", "")
    at = text.index(line) + where.index("|")
    hover = hover_at(view, view.document.lines.position(at), documents.conversion())
    if hover is None:
        return ""
    assert hover.range is not None
    content = hover.contents
    return str(getattr(content, "value", content))


def test_the_model_of_these_tests_is_sound() -> None:
    found = Documents().open(URI, 1, MODEL)[0].diagnostics
    assert [each.message for each in found if each.severity is DiagnosticSeverity.Error] == []


def test_a_constant_that_the_script_assigns_is_hinted_at() -> None:
    documents = Documents()
    documents.open(URI, 1, MODEL)
    view = documents.view(URI)
    assert view is not None
    lines = view.document.lines
    begin = MODEL.index("hits <= MOST")
    hints = inlay_hints(view, lines.range(begin, begin + len("hits <= MOST")), HintSettings())
    assert [hint.label for hint in hints] == ["= 7"]


@pytest.mark.parametrize(
    ("where", "expected"),
    [
        ("enum |Mode", ["enum Mode { Internal, External }", "How a thing is run."]),
        ("{ Internal, |External }", ["Mode.External", "Value 2 of 2"]),
        ("object.mode == |External", ["Mode.External"]),
        ("Share |quality", ["Share quality = 0.5", "Parameter of `Gps.Active`. Domain: `[0.0 1.0]` (`Share`)."]),
        ("|Share quality", ["typedef float [0.0 1.0] Share;"]),
        ("|float rate", ["Real numbers."]),
        ("float |rate", ["float rate", "Local variable."]),
        ("float |RATE", ["float RATE = [0.1 4.0]", "Hits per second.", "Global variable.", "**Sampled by missions.**"]),
        ("sampledParameter(|RATE", ["Range: `[0.1 4.0]`", "`Gps::Active` [untitled:model:24](untitled:model#L24)"]),
        ("|sampledParameter", ["what the mission draws", "float RATE = [0.1 4.0]", "`Gps::Active`"]),
        ("int |MOST", ["int MOST", "**Given**", "`MOST = 7` [untitled:model:7]"]),
        ("class |Gps", ["class Gps extends Timeline", "A receiver.", "never overlap", "`Gps(Mode m)`", "`Mode mode`"]),
        ("extends |Timeline", ["class Timeline extends Object", "Built in."]),
        ("extends |Reservoir", ["`produce(float quantity)`"]),
        ("Mode |mode;", ["Mode mode", "Member of `class Gps`.", "enum Mode { Internal, External }"]),
        ("  |Gps(Mode m)", ["Gps(Mode m)", "Constructor of `class Gps`", "A receiver."]),
        ("new |Gps", ["Gps(Mode m)"]),
        ("Gps(Mode |m)", ["Parameter of a constructor of `Gps`."]),
        ("{ |mode = m", ["Member of `class Gps`."]),
        ("predicate |Active", ["predicate Gps.Active {\n  int hits;\n  Share quality = 0.5;\n}", "Collecting hits."]),
        ("Gps::|Active", ["predicate Gps.Active", "**Rules**", "[untitled:model:22]", "`duration`, `start`, `end`"]),
        ("|Gps::Active", ["class Gps"]),
        ("|hits <= MOST", ["int hits", "Parameter of the token at hand, a `Gps.Active`.", "of this rule: `[-inf 7]`"]),
        ("|object.mode", ["Gps object", "on a timeline its tokens never overlap"]),
        ("before_it.|duration", ["int duration", "Of token `before_it`, a `Gps.Idle`."]),
        ("(Idle |before_it", ["Token `before_it`, a `Gps.Idle`.", "predicate Gps.Idle { }"]),
        ("meets(|Idle", ["predicate Gps.Idle { }"]),
        ("|met_by(", ["The origin starts when the target ends.", "before_it.end == start", "`target meets origin`"]),
        ("before_it |before [1 5] this", ["`before_it` (`Gps.Idle`)", "1 <= start - before_it.end <= 5"]),
        ("this |before p", ["end <= p.time"]),
        ("|contains_end(", ["start < Active.end", "Active.end <= end", "*EUROPA:*"]),
        ("|any(", ["The target exists"]),
        ("|addEq(", ["addEq(a, b, sum)", "a + b = sum", "`sum` is determined by the others"]),
        ("|abs(", ["the absolute value of x", "Gives an `int` over ints"]),
        ("(|g in gps", ["Gps g", "Local variable."]),
        ("(g in |gps", ["Gps gps", "Object."]),
        ("goal(gps.Active |first", ["Token `first`"]),
        ("|goal(gps", ["A token that the plan must achieve."]),
        ("first.hits.|specify", ["specify(value)", "Method of a variable: decide the variable."]),
        ("first.|activate", ["Method of a token"]),
        ("|close();", ["no further object"]),
        ("|foreach", ["Repeats its block"]),
        ("RATE|);", ["float RATE"]),
    ],
)
def test_what_stands_there_is_told(where: str, expected: list[str]) -> None:
    text = shown(where)
    for each in expected:
        assert each in text


@pytest.mark.parametrize("where", ["rate == sampledParameter(RATE)|;", "\n|\n/// A receiver", "MOST = |7", "[1 |5]"])
def test_where_nothing_has_a_meaning_nothing_is_told(where: str) -> None:
    assert shown(where) == ""


def test_a_parameter_may_be_a_value_whose_range_the_mission_gives() -> None:
    text = "enum P { RATE }\nclass C extends Timeline { predicate p { } }\nC::p { sampledParameter(RATE) == 1.0; }\n"
    assert "Its range and distribution come from the mission file." in shown("sampledParameter(|RATE", text)


def test_in_text_that_is_not_understood_known_words_still_mean_something() -> None:
    text = "class C extends Timeline { predicate p { } }\nC::p { meets meets C ( ; }\n"
    assert "The target starts when the origin ends." in shown("|meets meets", text)
    assert "class C extends Timeline" in shown("meets |C", text)


@pytest.mark.parametrize("name", [*RELATIONS, *CONSTRAINTS, *FUNCTIONS, *PLAIN, "goal", "fact", "rejectable", "inf"])
def test_every_word_of_the_language_is_explained(name: str) -> None:
    text = shown(f"|{name} ;;", f"{name} ;;")
    assert f"```nddl\n{name}" in text or f" {name} (" in text
    assert len(text.splitlines()) > 3


def test_a_definition_is_found_through_every_kind_of_name() -> None:
    documents = Documents()
    documents.open(URI, 1, MODEL)
    view = documents.view(URI)
    assert view is not None
    for where, target in {
        "Gps(|Internal)": "Internal, External",
        "hits <= |MOST": "MOST;\nMOST",
        "object.|mode": "mode;",
        "|first.activate": "first);",
        "first.|hits": "hits; Share",
        "new |Gps": "Gps(Mode m)",
        "met_by(|Idle": "Idle { }",
    }.items():
        at = MODEL.index(where.replace("|", "")) + where.index("|")
        meaning = meaning_at(view.snapshot.analysis, view.parse, at)
        assert meaning is not None
        span = definition_of(view.snapshot.analysis, meaning)
        assert span is not None
        assert span.begin == MODEL.index(target)
    nothing = meaning_at(view.snapshot.analysis, view.parse, MODEL.index("Timeline"))
    assert nothing is not None
    assert definition_of(view.snapshot.analysis, nothing) is None
    assert view.document.lines.offset(Position(0, 0)) == 0


LEFT = """\
enum Mode { Slow, Fast, Off }
int MOST = 7;
int LATER;
LATER = 6;
class C extends Timeline { predicate p { int n; Mode mode; float share; bool is_on; } predicate q { int n; n <= 5; } }
C::p {
  n <= MOST;
  2 < n;
  n <= LATER;
  int m = [0 100];
  m == n;
  starts(object.q other);
  other.n >= 1;
  mode != Off;
  if (mode == Fast) { n >= 4; share <= 0.5; if (is_on) { m >= 50; } }
  else { n <= 6; m <= 9; }
  duration <= 9;
  meets(object.q later);
}
"""


@pytest.mark.parametrize(
    ("place", "expected"),
    [
        ("^n <= MOST", "[3 6]"),
        ("int ^m = [0", None),  # what it is compared with is known only together with it
        ("^m == n", None),
        ("other.^n", "[1 5]"),
        ("^mode != Off", "{Slow, Fast}"),
        ("if (^mode", "{Slow, Fast}"),
        ("^n >= 4", "[4 6]"),
        ("^share <=", "[-inf 0.5]"),
        ("^is_on", None),
        ("^m >= 50", "[50 100]"),
        ("^n <= 6", "[3 6]"),
        ("^m <= 9", "[0 9]"),
        ("^duration", "[1 9]"),
        ("^MOST;", None),
        ("int ^n; Mode", None),
    ],
)
def test_a_rule_tells_what_it_leaves_of_a_domain(place: str, expected: str | None) -> None:
    at = LEFT.index(place.replace("^", "")) + place.index("^")
    documents = Documents()
    documents.open(URI, 1, LEFT)
    view = documents.view(URI)
    assert view is not None
    found = hover_at(view, view.document.lines.position(at), documents.conversion())
    assert found is not None
    text = getattr(found.contents, "value", "")
    _, _, left = text.partition("Left here by the comparisons of this rule: ")
    assert left == (f"`{expected}`." if expected is not None else "")
