"""Offsets, lines and columns agree, whatever bytes a file holds."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nddl_lang.text.read import decode, read_source, read_text
from nddl_lang.text.source import Anchor, Source, Span


@given(st.text(alphabet="ab\r\n\v\u2028é", max_size=60))
def test_every_offset_has_its_line_and_column(text: str) -> None:
    source = Source("t", text)
    for offset in range(len(text) + 1):
        line, column = source.locate(offset)
        before = text[:offset].split("\n")
        assert (line, column) == (len(before), len(before[-1]) + 1)
        assert source.line(line) == text.split("\n")[line - 1].removesuffix("\r")


def test_a_span_moves_with_its_anchor() -> None:
    anchor = Anchor(Source("t", "int a;"))
    span = Span(anchor, 4, 5)
    assert (span.text, span.line, span.column) == ("a", 1, 5)
    anchor.source, anchor.offset = Source("t", "\n\n  int a;"), 4
    assert (span.text, span.line, span.column) == ("a", 3, 7)


@given(st.binary())
def test_any_bytes_make_a_text(content: bytes) -> None:
    text = decode(content)
    assert ("\ufffd" in text) or text.encode("utf-8") == content


def test_a_file_is_read_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_bytes(b"\xef\xbb\xbfint a;\r\n// \xe9\n")
    source = read_source(path)
    assert (source.name, source.text) == (str(path), "\ufeffint a;\r\n// \ufffd\n")


def test_a_missing_file_has_no_text(tmp_path: Path) -> None:
    assert read_text(tmp_path / "none.nddl") is None
    assert read_text(tmp_path / "none" / "none.nddl") is None
    with pytest.raises(OSError, match="directory"):
        read_text(tmp_path)
