"""Complaints about the reactor of a mission stand at its own table, whichever tables stand before it."""

from checker.mission_table import MissionText
from nddl_lang.text.source import Source
from nddl_lang.text.toml_places import find_places


def test_reactors_that_run_models_are_counted_without_those_in_code() -> None:
    tables = ('code = "ward.py:Ward"', 'model = "a.nddl"', 'code = ":LogPlayer"', 'model = "b.nddl"')
    content = "".join(f"[[reactor]]\n{each}\n" for each in tables)
    text = MissionText(Source("mission.toml", content), find_places(content))
    assert [text.reactor_path(number) for number in range(2)] == [("reactor", 1), ("reactor", 3)]
