"""Which model an open text belongs to, and what is published when."""

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import DiagnosticTag, Position, Range

from lsp.completion import completions
from lsp.documents import Documents
from lsp.hover import hover_at
from lsp.mending import formatting, mends
from lsp.open_text import Publication
from lsp.project import ServerSettings
from lsp.symbols import Outlines

PART = "C::p { duration <= LIMIT; }\n"
MAIN = '#include "base.nddl"\nint LIMIT = 3;\n#include "part.nddl"\n'
BASE = "class C extends Timeline { predicate p { } }\n"


def uris(directory: Path, **texts: str) -> list[str]:
    for name, text in texts.items():
        (directory / f"{name}.nddl").write_text(text)
    return [(directory / f"{name}.nddl").as_uri() for name in texts]


def codes(news: list[Publication]) -> dict[str, list[str]]:
    return {each.uri.rpartition("/")[2]: [str(diagnostic.code) for diagnostic in each.diagnostics] for each in news}


def test_a_part_is_understood_as_part_of_the_model_beside_it(tmp_path: Path) -> None:
    part, *_ = uris(tmp_path, part=PART, main=MAIN, base=BASE)
    documents = Documents()
    assert codes(documents.open(part, 1, PART)) == {"part.nddl": []}
    assert codes(documents.change(part, 2, [(None, PART.replace("LIMIT", "LIMITS"))])) == {"part.nddl": ["NDDL201"]}
    assert codes(documents.close(part)) == {"part.nddl": []}


def test_what_a_model_does_not_use_of_a_part_is_told_if_nothing_else_includes_it(tmp_path: Path) -> None:
    base = "enum Hue { RED, GREEN, BLUE }\nclass C extends Timeline { predicate p { Hue hue; } }\n"
    main = '#include "base.nddl"\nC::p { if (hue == RED) { hue != BLUE; } }\nC c = new C();\nclose();\ngoal(c.p one);\n'
    part, _ = uris(tmp_path, base=base, main=main)
    assert codes(Documents().open(part, 1, base))["base.nddl"] == ["NDDL506"]
    uris(tmp_path, other=main.replace("BLUE", "GREEN"))
    assert codes(Documents().open(part, 1, base))["base.nddl"] == []


def test_that_another_model_has_come_to_include_a_part_is_seen_when_something_is_saved(tmp_path: Path) -> None:
    base = "enum Hue { RED, GREEN, BLUE }\nclass C extends Timeline { predicate p { Hue hue; } }\n"
    main = '#include "base.nddl"\nC::p { if (hue == RED) { hue != BLUE; } }\nC c = new C();\nclose();\ngoal(c.p one);\n'
    part, _ = uris(tmp_path, base=base, main=main)
    documents = Documents()
    documents.open(part, 1, base)
    uris(tmp_path, other=main.replace("BLUE", "GREEN"))
    assert codes(documents.save(part))["base.nddl"] == []


def test_a_part_that_nothing_includes_any_more_stands_by_itself(tmp_path: Path) -> None:
    part, main, _ = uris(tmp_path, part=PART, main=MAIN, base=BASE)
    documents = Documents()
    documents.open(main, 1, MAIN)
    assert codes(documents.open(part, 1, PART)) == {"part.nddl": []}
    (tmp_path / "main.nddl").write_text("")
    news = codes(documents.change(main, 2, [(None, "")]))
    assert news == {"main.nddl": [], "part.nddl": ["NDDL213"]}
    assert codes(documents.change(main, 3, [(None, MAIN)])) == {"main.nddl": [], "part.nddl": []}


def test_a_model_that_is_opened_after_its_part_takes_it_over(tmp_path: Path) -> None:
    part, other, *_ = uris(tmp_path, part=PART, other=MAIN.replace("LIMIT", "MOST"), base=BASE, main=MAIN)
    documents = Documents()
    assert codes(documents.open(part, 1, PART)) == {"part.nddl": []}
    assert codes(documents.open(other, 1, MAIN.replace("LIMIT", "MOST"))) == {
        "other.nddl": [],
        "part.nddl": ["NDDL201"],
    }
    assert codes(documents.close(other)) == {"part.nddl": []}


def test_files_that_include_each_other_are_one_model(tmp_path: Path) -> None:
    one, two = uris(tmp_path, one='#include "two.nddl"\n', two='#include "one.nddl"\n')
    documents = Documents()
    documents.open(one, 1, '#include "two.nddl"\nint a;\n')
    documents.open(two, 1, '#include "one.nddl"\nint a;\n')
    for uri in (one, two):
        view = documents.view(uri)
        assert view is not None
        assert view.parse.source.text.endswith("int a;\n")
    documents.close(one)
    assert documents.view(two) is not None
    assert documents.view(one) is None


def test_what_a_file_on_the_disk_gains_counts_once_something_is_saved(tmp_path: Path) -> None:
    main, *_ = uris(tmp_path, main=MAIN, part=PART, base=BASE)
    documents = Documents()
    documents.open(main, 1, MAIN)
    uris(tmp_path, part=PART + "int LIMIT;")
    assert codes(documents.save(main)) == {"part.nddl": ["NDDL228"]}
    assert codes(documents.refresh()) == {}
    uris(tmp_path, part=PART)
    assert codes(documents.refresh()) == {"part.nddl": []}


def test_a_word_of_an_earlier_dialect_is_struck_out() -> None:
    (news,) = Documents().open("untitled:a", 1, "class C { private int x; }\nclass Timeline { }\n")
    assert [(each.code, each.tags) for each in news.diagnostics] == [
        ("NDDL170", [DiagnosticTag.Deprecated]),
        ("NDDL222", [DiagnosticTag.Unnecessary]),
    ]


def test_a_note_with_a_place_is_a_link_and_one_without_is_text(tmp_path: Path) -> None:
    text = 'int a;\nint a;\n#include "no.nddl"\n'
    (news,) = Documents().open((tmp_path / "a.nddl").as_uri(), 1, text)
    missing, twice = news.diagnostics
    assert twice.related_information is not None
    assert twice.related_information[0].location.range == Range(Position(0, 4), Position(0, 5))
    assert "note: looked beside this file" in missing.message


def test_strange_names_of_files_are_names_all_the_same() -> None:
    for uri in (
        "",
        "file:",
        "file:///a%00b.nddl",
        "file:///a\ud800.nddl",
        "file://[x/y",
        "a b",
        "file:///" + "x" * 5000,
    ):
        documents = Documents()
        (news,) = documents.open(uri, 1, '#include "b.nddl"\n#include "\0"\n#include "\ud800"\n')
        assert news.uri == uri
        assert news.diagnostics
        documents.close(uri)


FRAGMENTS = st.sampled_from(
    [*'{}();,.:=[]"\r\n🛰 /*', "//", "class C ", "predicate p", "C::p", "int x", "new C", "this", "goal", "before "]
)


@given(st.lists(st.lists(FRAGMENTS, max_size=12).map("".join), min_size=1, max_size=4), st.data())
def test_nothing_that_is_typed_stops_the_answers(texts: list[str], data: st.DataObject) -> None:
    documents = Documents(ServerSettings())
    uri = "untitled:a"
    documents.open(
        uri, 1, "class C extends Timeline { predicate p { int x; } }\nC c = new C();\nC::p { meets(p q); }\n"
    )
    outlines = Outlines()
    for version, text in enumerate(texts, 2):
        document = documents.find(uri)
        assert document is not None
        size = len(document.lines.text)
        begin, finish = sorted((data.draw(st.integers(0, size)), data.draw(st.integers(0, size))))
        documents.change(uri, version, [(document.lines.range(begin, finish), text)])
        view = documents.view(uri)
        assert view is not None
        whole = document.lines.text
        conversion = documents.conversion()
        at = data.draw(st.integers(0, len(whole)))
        hover_at(view, document.lines.position(at), conversion)
        completions(view.snapshot.analysis, view.parse, at)
        assert outlines.outline(view.parse, document.lines) == Outlines().outline(view.parse, document.lines)
        mends(view, document.lines.range(0, len(whole)), conversion)
        formatting(view.parse, document.lines)
        fresh = Documents(ServerSettings()).open(uri, 1, whole)[0]
        assert documents.refresh() == []
        assert fresh.diagnostics == tuple(documents.change(uri, version, [])[0].diagnostics)
