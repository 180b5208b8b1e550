"""A mission file is read whole, and each mistake in it is named where it stands."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from checker.mission import Mission, parse_mission, read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.rendering import describe
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.source import Source
from nddl_lang.text.toml_places import find_places
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.outcome import EventKind

GPS = Path("models/gps")
HEAD = """\
[mission]
name = "gps"
final_tick = 600

[[reactor]]
name = "navigator"
model = "navigator.nddl"
internal = ["nav"]
external = ["gps"]

[[reactor]]
name = "psim"
model = "psim.nddl"
internal = ["gps"]
"""


GOAL = '[[goal]]\ntimeline = "nav"\npredicate = "Hold"\n[goal.parameters]\n'


def read(text: str) -> Mission:
    mission, diagnostics = parse_mission(Source("m.toml", text), GPS)
    assert [diagnostic.message for diagnostic in diagnostics] == []
    assert mission is not None
    return mission


def complaints(text: str) -> list[tuple[int, str, str, str, str | None]]:
    mission, diagnostics = parse_mission(Source("m.toml", text), GPS)
    assert mission is None
    return [(one.span.line, one.span.text, one.code.id, one.message, one.help) for one in diagnostics]


def test_the_gps_mission_is_read() -> None:
    mission, diagnostics = read_mission(GPS / "mission.toml")
    assert not diagnostics
    assert mission is not None
    assert [reactor.name for reactor in mission.agent.reactors] == ["navigator", "psim"]
    assert mission.agent.goals[0].start == (5.0, 60.0)
    assert mission.agent.goals[0].parameters == (("distance", 240.0),)
    assert ParameterConfiguration("GPS_HIT_RATE", 0.1, 4.0) in mission.agent.parameters
    assert (mission.check.missions, mission.check.seed, mission.check.max_failure_rate) == (200, 7234, 0.01)


def test_defaults_fill_what_is_not_written() -> None:
    mission = read(HEAD)
    assert mission.agent.on_failure == "abort_agent"
    assert mission.agent.tick == 1.0
    assert mission.agent.reactors[0].max_steps is None
    assert mission.check.missions == 200


def test_every_kind_of_parameter_is_read() -> None:
    mission = read(
        HEAD
        + """
[parameters.A]
range = [0, 38]
kind = "int"
clip = [0, inf]
mode = "intra"
update = 5
[parameters.B]
values = [1, 2]
weights = [0.5, 1.5]
[parameters.C]
value = 7.5
[parameters.D]
"""
    )
    assert mission.agent.parameters == (
        ParameterConfiguration("A", 0.0, 38.0, "uniform", "intra", 5, (0, float("inf")), True),
        ParameterConfiguration("B", 1.0, 2.0, "discrete", values=(1.0, 2.0), weights=(0.5, 1.5)),
        ParameterConfiguration("C", 7.5, 7.5, "fixed", values=(7.5,)),
        ParameterConfiguration("D", 0.0, 0.0),
    )
    assert mission.needs_range == ("D",)


def test_values_are_told_with_how_often_they_come_where_that_differs() -> None:
    uneven = ParameterConfiguration("L", 20.0, 60.0, "discrete", values=(20.0, 40.0, 60.0), weights=(2.0, 1.0, 1.0))
    assert describe(uneven) == "one of 20 (50 %), 40 (25 %), 60 (25 %), one value per mission"
    assert describe(replace(uneven, weights=())) == "one of 20, 40, 60, one value per mission"
    assert describe(replace(uneven, weights=(3.0, 3.0, 3.0))) == "one of 20, 40, 60, one value per mission"


def test_parameters_that_depend_on_others_are_read() -> None:
    mission = read(
        HEAD
        + """
[parameters.A]
mean = 1.0
sigma = 0.5
[parameters.B]
range = [0, 1]
mode = "intra"
update = 6
[parameters.C]
expression = "2 * B + A"
clip = [0, 3]
[parameters.D]
expression = "C + E"
[joint.SEA]
parameters = ["E", "F"]
rows = [[1, 10], [2, 20]]
weights = [3, 1]
mode = "intra"
update = 4
"""
    )
    half = 0.5 * 3**0.5
    assert mission.agent.parameters == (
        ParameterConfiguration("A", 1.0 - half, 1.0 + half, "normal", mean=1.0, deviation=0.5),
        ParameterConfiguration("B", 0.0, 1.0, "uniform", "intra", 6),
        ParameterConfiguration("C", 0.0, 0.0, "dependent", "intra", 6, (0, 3), expression="2 * B + A"),
        ParameterConfiguration("D", 0.0, 0.0, "dependent", "intra", 2, expression="C + E"),
        ParameterConfiguration(
            "E", 1.0, 2.0, "discrete", "intra", 4, values=(1.0, 2.0), weights=(3.0, 1.0), stream="joint SEA"
        ),
        ParameterConfiguration(
            "F", 10.0, 20.0, "discrete", "intra", 4, values=(10.0, 20.0), weights=(3.0, 1.0), stream="joint SEA"
        ),
    )
    assert mission.needs_range == ()


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ('[parameters.A]\nexpression = "A + 1"\n', 15, "parameters read each other in a cycle: A → A"),
        ('[parameters.A]\nexpression = "B"\n[parameters.B]\nexpression = "A"\n', 15, "in a cycle: A → B → A"),
        ("[parameters.A]\nmean = 0\nsigma = -0.3\n", 17, "`sigma` must be greater than 0, not -0.3"),
        ("[parameters.A]\nmean = 0\nsigma = 0\n", 17, "`sigma` must be greater than 0, not 0"),
        ('[parameters.A]\nexpression = "open(B)"\n', 15, "`expression`: there is no function `open`"),
        ('[parameters.A]\nexpression = "3 + 4"\n', 15, "the expression reads no other parameter: write `value`"),
        ('[parameters.A]\ndistribution = "normal"\nmean = 3\n', 15, "without a `range` needs both `mean` and `sigma`"),
        ("[parameters.A]\nrange = [0, 1]\ndistribution = 'uniform'\nmean = 3\n", 15, "`mean` belongs to a normal or"),
        ('[joint.S]\nparameters = ["A", "B"]\nrows = [[1, 2], [3]]\n', 17, "`row 2` must be 2 numbers, one for"),
        ('[joint.S]\nparameters = ["A"]\nrows = [[1]]\nweights = [1, 2]\n', 18, "`weights` has 2 of 1"),
        ('[parameters.A]\nvalue = 1\n[joint.S]\nparameters = ["A"]\nrows = [[1]]\n', 18, "the parameter `A` is there"),
    ],
)  # fmt: skip
def test_a_mistake_in_what_depends_is_named_where_it_stands(text: str, line: int, message: str) -> None:
    first = complaints(HEAD + text)[0]
    assert first[0] == line
    assert message in first[3]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[check]\nmision = 3\n", (16, "mision", "NDDL702", "no key `mision` in [check]", "did you mean `missions`?")),
        ("[chek]\n", (15, "chek", "NDDL702", "no key `chek` in a mission file", "did you mean `check`?")),
        (
            "[check]\nmissions = '200'\n",
            (16, "'200'", "NDDL704", '`missions` must be a whole number, not the text "200"', None),
        ),
        ("[check]\nmissions = 0\n", (16, "0", "NDDL705", "`missions` must be at least 1, not 0", None)),
        (
            "[check]\nmax_failure_rate = 5.0\n",
            (16, "5.0", "NDDL705", "`max_failure_rate` must be from 0 to 1, not 5.0", "5 % is 0.05"),
        ),
        (
            "[parameters.A]\nrange = [4.0, 0.1]\n",
            (16, "[4.0, 0.1]", "NDDL706", "`range` runs backwards: 4.0 is above 0.1", "write [0.1, 4.0]"),
        ),
        (
            '[parameters.A]\nrange = [0, 1]\ndistribution = "unifrom"\n',
            (
                17,
                '"unifrom"',
                "NDDL707",
                "`distribution` cannot be `unifrom`; it is one of uniform, normal, truncated_normal, discrete, "
                "choice, fixed, dependent",
                "did you mean `uniform`?",
            ),
        ),
        (
            'early = ["nva"]\n',
            (15, '"nva"', "NDDL707", "`early` cannot be `nva`; it is one of gps", None),
        ),
        (
            'observe = ["nav"]\n',
            (15, '"nav"', "NDDL707", "`observe` cannot be `nav`; it is one of nothing", None),
        ),
        (
            '[parameters.A]\ndistribution = "discrete"\n',
            (15, "parameters.A", "NDDL713", "a discrete distribution needs `values`, a list of numbers", None),
        ),
        (
            '[[goal]]\ntimeline = "nva"\npredicate = "Hold"\n',
            (16, '"nva"', "NDDL710", "no reactor owns the timeline `nva`", "did you mean `nav`?"),
        ),
        (
            '[[reactor]]\nname = "x"\nmodel = "navigatr.nddl"\n',
            (17, '"navigatr.nddl"', "NDDL708", "there is no file `navigatr.nddl`", "did you mean `navigator.nddl`?"),
        ),
        (
            '[[reactor]]\nname = "x"\nmodel = "psim.nddl"\ninternal = ["a", "gps"]\n',
            (18, '"gps"', "NDDL709", "an owner of the timeline `gps` is there twice", None),
        ),
        ("a = 3\nb = = 2\n", (16, "=", "NDDL701", "this is not TOML: invalid value", "a value is given with one `=`")),
    ],
)
def test_a_mistake_is_named_where_it_stands(text: str, expected: tuple[int, str, str, str, str | None]) -> None:
    assert complaints(HEAD + text) == [expected]


_HUGE = "9" * 400


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("final_tick = 600", f"final_tick = {_HUGE}", "`final_tick` must be at most 1000000000000"),
        ("final_tick = 600", "final_tick = 600\ntick = inf", "`tick` must be finite, not inf"),
        ('name = "gps"', 'name = " "', "`name` must be a text that is not empty"),
        ('model = "psim.nddl"', 'model = ""', "`model` must be a text that is not empty"),
        ("[end]", "[check]\nmissions = 100_000_000", "`missions` must be at most 1000000, not 100000000"),
        ("[end]", "[check]\nseed = 9007199254740992", "`seed` must be at most 9007199254740991"),
        ("[end]", "[parameters.A]\nvalue = inf", "`value` must be finite, not inf"),
        ("[end]", "[parameters.A]\nmean = 1\nsigma = inf", "`sigma` must be finite, not inf"),
        ("[end]", f"[parameters.A]\nvalues = [1, {_HUGE}]", "`values` must be a list of finite numbers"),
        ("[end]", f"[parameters.A]\nrange = [0, {_HUGE}]", "`range` must be numbers that can be held"),
        ("[end]", "[parameters.A]\nrange = [-1e308, 1e308]", "`range` must be numbers that can be held"),
        ("[end]", "[parameters.A]\nrange = [0, 1]\nclip = [2, 3]", "`clip` must be such that it meets [0, 1]"),
        ("[end]", '[parameters.A]\nrange = [0.2, 3]\nkind = "int"', "`range` must be whole numbers at both ends"),
        ("[end]", "[parameters.A]\nrange = [0, 1]\nupdate = 5", '`update` has no effect without `mode = "intra"`'),
        ("[end]", f"{GOAL}distance = {_HUGE}", "`distance` must be a number that can be held"),
        *(
            ("[end]", text, "that can be held, below 2^51 in size")
            for size in ("2251799813685248", "-4503599627370495", "1e30")
            for text in (
                f"{GOAL}distance = {size}",
                f"{GOAL}distance = [{', '.join(sorted(('0', size)))}]",
                f"[parameters.A]\nvalue = {size}",
                f"[parameters.A]\nvalues = [{size}]",
                f'[joint.S]\nparameters = ["A"]\nrows = [[{size}]]',
                f'[[property]]\nname = "q"\nkind = "never"\ntimeline = "gps"\nparameters = {{ n = {size} }}',
            )
        ),
        ("[end]", f"{GOAL}distance = {{ a = 1 }}", "`distance` must be a number, a text in quotes, true or false, or"),
        ("[end]", f"{GOAL}distance = 2026-01-01", "a pair [lower, upper] of numbers, not a date or time"),
    ],
)
def test_a_value_that_no_mission_can_have_is_named(old: str, new: str, message: str) -> None:
    text = f"{HEAD}[end]".replace(old, new).replace("[end]", "")
    (found,) = complaints(text)
    assert message in found[3]
    assert len(found[3]) < 240


def test_of_a_name_that_is_there_twice_the_first_is_shown() -> None:
    text = (
        HEAD
        + '[joint.S]\nparameters = ["A", "A"]\nrows = [[1, 1]]\n[joint.T]\nparameters = ["A", "B"]\nrows = [[1, 2]]\n'
    )
    text += '[joint.U]\nparameters = ["B"]\nrows = [[1]]\n'
    mission, found = parse_mission(Source("m.toml", text), GPS)
    assert mission is None
    told = [(one.span.begin, one.notes[0].span) for one in found if one.code.id == "NDDL709"]
    a, b = ([each.start() for each in re.finditer(f'"{name}"', text)] for name in "AB")
    assert [(at, span and span.begin) for at, span in told] == [(a[1], a[0]), (a[2], a[0]), (b[1], b[0])]


def test_bytes_that_are_no_utf_8_are_told() -> None:
    mission, found = parse_mission(Source("m.toml", f"{HEAD}# caf\ufffd"), GPS)
    assert mission is not None
    assert [(one.code.id, one.help) for one in found if one.code.id == "NDDL107"] == [
        ("NDDL107", "save the file as UTF-8")
    ]


def test_all_mistakes_are_reported_in_one_go() -> None:
    found = complaints('[mission]\nnmae = "gps"\n[check]\nmissions = true\nsead = 3\n')
    assert [(line, code) for line, _, code, _, _ in found] == [
        (1, "NDDL703"),
        (1, "NDDL703"),
        (2, "NDDL702"),  # which says that `name` is meant
        (4, "NDDL704"),
        (5, "NDDL702"),
    ]


def test_reactors_that_use_each_other_are_refused() -> None:
    text = HEAD.replace('internal = ["gps"]', 'internal = ["gps"]\nexternal = ["nav"]')
    message = "the reactors use each other in a cycle: navigator → psim → navigator"
    assert [(code, said) for _, _, code, said, _ in complaints(text)] == [("NDDL711", message)]


def test_a_goal_for_an_owner_without_lookahead_is_told_and_refused_in_flight() -> None:
    text = (GPS / "mission.toml").read_text().replace("lookahead = 900", "lookahead = 0")
    mission, found = parse_mission(Source("m.toml", text), GPS)
    assert mission is not None
    assert {(one.code.id, one.severity) for one in found} == {("NDDL712", Severity.WARNING)}
    outcome = pinned(load_models(mission))(mission.agent)(1)
    refused = [(event.tick, event.timeline) for event in outcome.events if event.kind is EventKind.REFUSE]
    assert refused == [(0, "nav"), (0, "nav")] and outcome.abort is None


def test_places_survive_every_way_to_write_toml() -> None:
    text = "a.b = '''x\n]'''\n[ c . \"d e\" ] # [no]\nf = [1, # ]\n  {g = 2}]\n"
    text += '[[h]]\n[h.i]\nj = "a\\"b"\n[[h]]\nk = 1\n'
    places = find_places(text)
    assert {path: text[slice(*place.key)] for path, place in places.items()} == {
        ("a",): "a.b",
        ("a", "b"): "a.b",
        ("c",): 'c . "d e"',
        ("c", "d e"): 'c . "d e"',
        ("c", "d e", "f"): "f",
        ("c", "d e", "f", 0): "1",
        ("c", "d e", "f", 1): "{g = 2}",
        ("c", "d e", "f", 1, "g"): "g",
        ("h",): "h",
        ("h", 0): "h",
        ("h", 0, "i"): "h.i",
        ("h", 0, "i", "j"): "j",
        ("h", 1): "h",
        ("h", 1, "k"): "k",
    }
    assert text[slice(*places["a", "b"].value)] == "'''x\n]'''"
    assert text[slice(*places["h", 0, "i", "j"].value)] == '"a\\"b"'


def test_a_byte_order_mark_is_no_mistake() -> None:
    mission = (GPS / "mission.toml").read_text(encoding="utf-8")
    plain, _ = parse_mission(Source("m.toml", mission), GPS)
    marked, found = parse_mission(Source("m.toml", "\ufeff" + mission), GPS)
    assert found == ()
    assert plain is not None and marked is not None and plain.agent == marked.agent


def test_an_empty_file_costs_a_message_for_each_table(tmp_path: Path) -> None:
    _, found = parse_mission(Source("m.toml", ""), tmp_path)
    assert [one.message for one in found] == [
        "a mission file needs the key `mission`",
        "a mission file needs the key `reactor`",
    ]
