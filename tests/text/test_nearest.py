"""The nearest known name is the one that a slip of the finger turns into the unknown one."""

import pytest

from nddl_lang.text.nearest import nearest

KNOWN = ["speed", "speedLimit", "horizon", "addEq", "temporalDistance", "a", "Lamp"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sped", "speed"),
        ("psede", None),
        ("spede", "speed"),
        ("SPEED", "speed"),
        ("adEQ", "addEq"),
        ("temporaldistance", "temporalDistance"),
        ("temproalDistnce", "temporalDistance"),
        ("hirizan", "horizon"),
        ("Lmap", "Lamp"),
        ("b", "a"),
        ("altitude", None),
        ("speedlimits", "speedLimit"),
    ],
)
def test_a_slip_is_recognised(name: str, expected: str | None) -> None:
    assert nearest(name, KNOWN) == expected


@pytest.mark.parametrize(
    ("name", "known", "expected"),
    [
        ("Of", ["On", "Off"], "Off"),
        ("Of", ["Off", "On"], "Off"),
        ("Offf", ["On", "Off"], "Off"),
        ("no", ["On", "Off"], "On"),
        ("Idel", ["Idea", "Idle"], "Idle"),
        ("hed", ["bed", "head", "hood"], "head"),
        ("goal_1", ["goal_2", "goal_11"], "goal_11"),
        ("strat", ["start", "state"], "start"),
        ("en", ["end", "in"], "end"),
        ("durration", ["duration", "end"], "duration"),
        ("gpsHitrate", ["gpsHitRates", "gpsHitRate"], "gpsHitRate"),
        ("latitud", ["altitude", "latitude", "attitude"], "latitude"),
        ("alittude", ["latitude", "altitude", "attitude"], "altitude"),
        ("Teh", ["Tea", "The"], "The"),
        ("maxx", ["minx", "maxy", "maxX2"], "maxX2"),
        ("x11", ["x12", "x1"], "x1"),
        ("Ascned", ["Descend", "Ascend"], "Ascend"),
        ("GPSfix", ["gpsFix", "gpsMix"], "gpsFix"),
        ("mets", ["meets", "met_by"], "meets"),
        ("completely", ["other", "names"], None),
    ],
)
def test_the_likeliest_of_several_is_chosen(name: str, known: list[str], expected: str | None) -> None:
    assert nearest(name, known) == expected


def test_of_equally_near_names_the_first_is_taken() -> None:
    assert nearest("gx", ["gy", "gz"]) == "gy"
    assert nearest("gx", ["gz", "gy"]) == "gz"
