"""Offsets and the editor's positions: the same places, whatever is counted."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import Position, Range

from lsp.positions import Encoding, Lines, replaced

TEXTS = st.text(alphabet=st.sampled_from("ab \t\n\r\x0b\x0c\u2028é🛰\ud800"), max_size=30)


@pytest.mark.parametrize(("encoding", "unit"), [(Encoding.UTF8, 6), (Encoding.UTF16, 3), (Encoding.UTF32, 2)])
def test_a_column_counts_the_units_before_it(encoding: Encoding, unit: int) -> None:
    lines = Lines("x\né🛰!", encoding)
    assert lines.position(4) == Position(1, unit)
    assert lines.offset(Position(1, unit)) == 4


def test_only_cr_and_lf_end_lines() -> None:
    lines = Lines("a\r\nb\rc\nd\x0ce\u2028f", Encoding.UTF16)
    assert lines.starts == (0, 3, 5, 7)


def test_a_position_past_the_end_of_its_line_is_that_end() -> None:
    lines = Lines("ab\r\ncd", Encoding.UTF16)
    assert lines.offset(Position(0, 99)) == 2
    assert lines.offset(Position(1, 99)) == 6
    assert lines.offset(Position(9, 0)) == 6


def test_a_position_inside_a_character_is_its_beginning() -> None:
    assert Lines("🛰x", Encoding.UTF16).offset(Position(0, 1)) == 0
    assert Lines("🛰x", Encoding.UTF8).offset(Position(0, 3)) == 0


@given(TEXTS, st.sampled_from(Encoding))
def test_every_offset_comes_back(text: str, encoding: Encoding) -> None:
    lines = Lines(text, encoding)
    for offset in range(len(text) + 1):
        if text[offset - 1 : offset + 1] != "\r\n":  # a place between them does not exist
            assert lines.offset(lines.position(offset)) == offset


@given(TEXTS, TEXTS, st.sampled_from(Encoding), st.data())
def test_an_edit_replaces_what_stands_there(text: str, new: str, encoding: Encoding, data: st.DataObject) -> None:
    lines = Lines(text, encoding)
    offsets = [at for at in range(len(text) + 1) if text[at - 1 : at + 1] != "\r\n"]
    begin, finish = sorted(data.draw(st.lists(st.sampled_from(offsets), min_size=2, max_size=2)))
    place = Range(lines.position(begin), lines.position(finish))
    assert replaced(lines, place, new) == text[:begin] + new + text[finish:]
