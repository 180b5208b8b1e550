"""A slip in a word of the language or in a name costs one message, which says what was meant."""

import pytest

from nddl_lang.analysis import analyse_text

MODEL = """enum Mode { slow, fast }
typedef int [0 9] Level;
class Lamp extends Timeline {
    Mode mode;
    predicate Off { }
    predicate On { Level level; float power; bool isWarm; string who; }
    action Turn { }
    Lamp(Mode m) { mode = m; }
}
class Dimmer extends Lamp {
    Dimmer(Mode m) { super(m); }
}
Lamp::On {
    met_by(object.Off dark);
    dark.duration <= 5;
    contains_start(object.Off never);
    if (isWarm == true) {
        leq(level, duration);
    } else {
        ends_after_start(object.Off other);
    }
    foreach (lamp in object) { power == max(1.0, 2.0); }
}
Lamp lamp = new Lamp(slow);
close();
rejectable(lamp.On shine);
goal(lamp.Off dim);
shine.start.specify(7);
shine.activate();
shine before dim;
float most = inf;
"""


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("enmu", "enum"),
        ("enun", "enum"),
        ("Enum", "enum"),
        ("typedf", "typedef"),
        ("typdef", "typedef"),
        ("clas", "class"),
        ("calss", "class"),
        ("Class", "class"),
        ("CLASS", "class"),
        ("exends", "extends"),
        ("extend", "extends"),
        ("predicat", "predicate"),
        ("predciate", "predicate"),
        ("Predicate", "predicate"),
        ("acton", "action"),
        ("bolean", "bool"),
        ("boolean", "bool"),
        ("Bool", "bool"),
        ("boool", "bool"),
        ("double", "float"),
        ("flaot", "float"),
        ("Float", "float"),
        ("String", "string"),
        ("strng", "string"),
        ("Levle", "Level"),
        ("level", "Level"),
        ("Timelime", "Timeline"),
        ("TimeLine", "Timeline"),
        ("timeline", "Timeline"),
        ("Lmap", "Lamp"),
        ("Lam", "Lamp"),
        ("supper", "super"),
        ("metby", "met_by"),
        ("meet_by", "met_by"),
        ("Met_by", "met_by"),
        ("contains_strat", "contains_start"),
        ("ends_after_star", "ends_after_start"),
        ("durtion", "duration"),
        ("duratoin", "duration"),
        ("fi", "if"),
        ("If", "if"),
        ("esle", "else"),
        ("els", "else"),
        ("foreahc", "foreach"),
        ("forech", "foreach"),
        ("isWram", "isWarm"),
        ("iswarm", "isWarm"),
        ("levle", "level"),
        ("ture", "true"),
        ("True", "true"),
        ("lqe", "leq"),
        ("mxa", "max"),
        ("nwe", "new"),
        ("slwo", "slow"),
        ("Slow", "slow"),
        ("colse", "close"),
        ("Close", "close"),
        ("rejectible", "rejectable"),
        ("gaol", "goal"),
        ("Goal", "goal"),
        ("shien", "shine"),
        ("Of", "Off"),
        ("Offf", "Off"),
        ("spceify", "specify"),
        ("actviate", "activate"),
        ("befroe", "before"),
        ("befor", "before"),
        ("Inf", "inf"),
        ("strat", "start"),
    ],
)
def test_a_typo_costs_one_message_that_says_what_was_meant(typed: str, meant: str) -> None:
    place = _last_use(meant)
    model = MODEL[:place] + typed + MODEL[place + len(meant) :]
    (complaint,) = analyse_text("typo.nddl", model).diagnostics
    assert complaint.span.line == model.count("\n", 0, place) + 1
    assert complaint.help == f"did you mean `{meant}`?"


def _last_use(word: str) -> int:
    """Where the word stands for the last time by itself."""
    place = len(MODEL)
    while True:
        place = MODEL.rindex(word, 0, place)
        around = MODEL[place - 1 : place] + MODEL[place + len(word) : place + len(word) + 1]
        if not any(letter.isalnum() or letter == "_" for letter in around):
            return place


def test_the_model_itself_is_in_order() -> None:
    assert analyse_text("typo.nddl", MODEL).diagnostics == ()


@pytest.mark.parametrize(
    ("compared", "help_"),
    [
        ("level == levl", None),
        ("levl <= level", None),
        ("level == levl + 1", "did you mean `level`?"),
        ("power == levl", "did you mean `level`?"),
    ],
)
def test_a_name_is_never_proposed_to_be_compared_with_itself(compared: str, help_: str | None) -> None:
    model = MODEL.replace("leq(level, duration);", f"{compared};")
    (complaint,) = analyse_text("typo.nddl", model).diagnostics
    assert complaint.message == "nothing named `levl` is in scope here"
    assert complaint.help == help_


@pytest.mark.parametrize(
    ("compared", "help_"),
    [
        ("dark.start == dark.strat", None),
        ("dark.duration <= dark.duratoin", None),
        ("dark.end == dark.strat", "did you mean `start`?"),
        ("start == dark.strat", "did you mean `start`?"),
        ("object.mode == object.mod", None),
    ],
)
def test_a_dotted_name_is_never_proposed_to_be_compared_with_itself(compared: str, help_: str | None) -> None:
    model = MODEL.replace("leq(level, duration);", f"{compared};")
    (complaint,) = analyse_text("typo.nddl", model).diagnostics
    assert complaint.help == help_
