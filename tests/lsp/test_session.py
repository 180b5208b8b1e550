"""A real client and a real server: what comes back over the wire."""

import asyncio
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from lsp.project import ServerSettings
from lsp.server import make_session

MODEL = """\
#include "vehicle.nddl"

/// Seconds per hit.
float GPS_HIT_RATE = [0.1 4.0];

Gps::Active {
  float rate;
  rate == sampledParameter(GPS_HIT_RATE);
  duration <= rate * minHitz;
  met_by(Inactive);
}
"""
VEHICLE = """\
class Gps extends Timeline {
  predicate Inactive { }
  predicate Active { int minHits; }
}
"""


def place(line: int, start: int, end: int) -> dict[str, Any]:
    return {"start": {"line": line, "character": start}, "end": {"line": line, "character": end}}


def model(directory: Path) -> tuple[str, str]:
    """The URIs of a model and of what it includes."""
    (directory / "vehicle.nddl").write_text(VEHICLE)
    (directory / "model.nddl").write_text(MODEL)
    return (directory / "model.nddl").as_uri(), (directory / "vehicle.nddl").as_uri()


def test_a_session_from_the_first_complaint_to_the_exit(client: Any, tmp_path: Path) -> None:
    capabilities = client.start()
    assert capabilities["textDocumentSync"]["change"] == 2
    assert capabilities["positionEncoding"] == "utf-16"
    uri, _ = model(tmp_path)

    told = client.open(uri, MODEL)
    assert told["version"] == 1
    (complaint,) = told["diagnostics"]
    assert complaint["range"] == place(8, 21, 28)
    assert complaint["code"] == "NDDL201"
    assert complaint["severity"] == 1
    assert complaint["source"] == "nddlc"
    assert complaint["message"].splitlines() == [
        "nothing named `minHitz` is in scope here",
        "help: did you mean `minHits`?",
    ]
    assert complaint["data"] == {"fixes": [{"title": "write `minHits`", "isSafe": False}]}

    shown = client.hover(uri, 7, 28)
    assert "float GPS_HIT_RATE = [0.1 4.0]" in shown
    assert "Seconds per hit." in shown
    assert "`Gps::Active` [model.nddl:8]" in shown
    assert "Here, for this token (`Gps.Active`) and `Inactive` (`Gps.Inactive`):" in client.hover(uri, 9, 4)
    assert client.hover(uri, 1, 0) is None

    told = client.change(uri, {"range": place(8, 27, 28), "text": "s"})
    assert told == {"uri": uri, "version": 2, "diagnostics": []}

    assert client.leave() == 0


def test_what_is_wrong_in_an_included_file_is_told_of_that_file(client: Any, tmp_path: Path) -> None:
    client.start()
    uri, included = model(tmp_path)
    sound = MODEL.replace("minHitz", "minHits")
    assert client.open(uri, sound)["diagnostics"] == []
    assert client.open(included, VEHICLE)["diagnostics"] == []

    # The included text is edited and not saved: the model that includes it is analysed again.
    client.change(included, {"range": place(2, 25, 32), "text": "hits"})
    (complaint,) = client.complaints(uri)["diagnostics"]
    assert complaint["code"] == "NDDL201"
    told = client.change(included, {"range": place(1, 2, 11), "text": "predicat"})
    assert [each["range"]["start"]["line"] for each in told["diagnostics"]] == [1]
    assert told["diagnostics"][0]["relatedInformation"][0]["location"]["uri"] == uri

    # Closed without saving, the text on the disk counts again.
    client.notify("textDocument/didClose", textDocument={"uri": included})
    assert client.complaints(included) == {"uri": included, "diagnostics": []}
    assert client.leave() == 0


def test_positions_count_what_the_editor_counts(start_client: Callable[..., Any]) -> None:
    text = 'string s = "🛰é"; int x = y;\n'
    for encodings, column in ((None, 26), (["utf-8", "utf-16"], 29), (["utf-32"], 25)):
        client = start_client()
        client.start(encodings=encodings)
        (complaint,) = client.open("untitled:one", text)["diagnostics"]
        assert complaint["range"] == place(0, column, column + 1)
        told = client.change("untitled:one", {"range": place(0, column, column + 1), "text": "3"})
        assert told["diagnostics"] == []
        assert client.leave() == 0


def test_questions_that_make_no_sense_get_an_answer_and_the_server_lives(client: Any, tmp_path: Path) -> None:
    client.start()
    client.send_bytes(b'{"jsonrpc": "2.0", "id": 7, "method')
    client.send_bytes(b"[1, 2]")
    client.send_bytes(b'{"method": "initialized"}')
    assert client.ask("nddlc/unheardOf", x=1)["error"]["code"] == -32601
    assert client.ask("textDocument/hover", position=3)["error"]["code"] == -32602
    client.notify("nddlc/unheardOf", x=1)
    client.notify("textDocument/didChange", textDocument={"uri": "untitled:no", "version": 2}, contentChanges=[])
    missing = (tmp_path / "missing.nddl").as_uri()
    document = {"uri": missing}
    position = {"line": 3, "character": 4}
    assert client.hover(missing, 0, 0) is None
    assert client.ask("textDocument/definition", textDocument=document, position=position) is None
    assert client.ask("textDocument/documentSymbol", textDocument=document) == []
    assert client.ask("textDocument/completion", textDocument=document, position=position) == []
    assert (
        client.ask("textDocument/formatting", textDocument=document, options={"tabSize": 2, "insertSpaces": True}) == []
    )
    assert client.open("untitled:one", "int a;")["diagnostics"] == []
    assert client.leave() == 0


def test_an_editor_that_leaves_without_a_word_is_noticed(client: Any) -> None:
    client.start()
    client.process.stdin.close()
    assert client.process.wait(60) == 1


def test_an_exit_without_shutdown_is_a_failure(client: Any) -> None:
    client.start()
    client.send(method="exit")
    assert client.process.wait(60) == 1


def test_included_files_are_found_where_the_editor_says(start_client: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    model(tmp_path / "parts")
    text = '#include "vehicle.nddl"\n'
    for client, options in (
        (start_client("--stdio", "-I", str(tmp_path / "parts")), None),
        (start_client(), {"includeDirectories": [str(tmp_path / "parts")]}),
    ):
        client.start(options)
        assert client.open((tmp_path / "else.nddl").as_uri(), text)["diagnostics"] == []
        assert client.leave() == 0


def test_the_dialect_can_be_asked_for(start_client: Callable[..., Any]) -> None:
    client = start_client("--dialect", "nddl3")
    client.start()
    codes = [each["code"] for each in client.open("untitled:one", "int a = 6 / 2;\n")["diagnostics"]]
    assert "NDDL150" in codes
    assert client.leave() == 0


def test_the_other_questions_are_answered_over_the_wire(client: Any, tmp_path: Path) -> None:
    client.start()
    uri, included = model(tmp_path)
    client.open(uri, MODEL)
    document = {"uri": uri}
    found = client.ask("textDocument/definition", textDocument=document, position={"line": 5, "character": 6})
    assert found == {"uri": included, "range": place(2, 12, 18)}
    names = [each["name"] for each in client.ask("textDocument/documentSymbol", textDocument=document)]
    assert names == ["GPS_HIT_RATE", "Gps::Active"]
    completed = client.ask("textDocument/completion", textDocument=document, position={"line": 5, "character": 5})
    assert [each["label"] for each in completed["items"]] == ["Inactive", "Active"]
    action, *others = client.ask(
        "textDocument/codeAction",
        textDocument=document,
        range=place(8, 22, 22),
        context={"diagnostics": []},
    )
    assert [each["title"] for each in others] == [
        "add parameter `float minHitz;` to `Gps.Active`",
        "declare `float minHitz;`",
    ]
    assert action["edit"]["changes"] == {uri: [{"range": place(8, 21, 28), "newText": "minHits"}]}
    client.change(uri, {"text": "int   a;\n"})
    options = {"tabSize": 2, "insertSpaces": True}
    edits = client.ask("textDocument/formatting", textDocument=document, options=options)
    assert edits == [{"range": place(0, 4, 6), "newText": ""}]
    assert client.leave() == 0


def test_a_misspelt_word_is_mended_from_its_complaint(client: Any, tmp_path: Path) -> None:
    client.start()
    uri, _ = model(tmp_path)
    text = MODEL.replace("minHitz", "minHits").replace("met_by(Inactive)", "metby(object.Inactive ahead)")
    (complaint,) = client.open(uri, text)["diagnostics"]
    assert (complaint["code"], complaint["range"]) == ("NDDL126", place(9, 2, 7))
    assert complaint["codeDescription"]["href"].endswith("/rules/NDDL126.md")
    (action,) = client.ask(
        "textDocument/codeAction",
        textDocument={"uri": uri},
        range=complaint["range"],
        context={"diagnostics": [complaint]},
    )
    (edit,) = action["edit"]["changes"][uri]
    assert (action["title"], edit) == (
        "write `met_by` (check the meaning)",
        {"range": place(9, 2, 7), "newText": "met_by"},
    )
    told = client.change(uri, {"range": edit["range"], "text": edit["newText"]})
    assert [each["code"] for each in told["diagnostics"]] == ["NDDL502"]
    assert client.leave() == 0


def test_findings_that_an_error_elsewhere_hid_come_back_as_they_were(wire: Any, tmp_path: Path) -> None:
    (tmp_path / "part.nddl").write_text("int UNUSED = 5;\nint AGAIN = 6;\n")
    root = tmp_path / "model.nddl"
    text = '#include "part.nddl"\nclass C extends Timeline { predicate p { } }\nC c = new C();\nint x = 3;\n'
    root.write_text(text)
    part = (tmp_path / "part.nddl").as_uri()
    wire.start()
    wire.open(root.as_uri(), text)
    own = wire.open(part, "int UNUSED = 5;\nint AGAIN = 6;\n")["diagnostics"]
    assert [each["range"]["start"]["line"] for each in own] == [0, 1]
    version = iter(range(2, 100))
    for line in 1, 3:
        begin, more = place(line, 0, 0), place(line, 0, 1)
        wire.change(root.as_uri(), next(version), {"range": begin, "text": "?"})
        assert wire.session.documents.complaints(part) == ()
        document = {"uri": root.as_uri(), "version": next(version)}
        said = wire.tell("textDocument/didChange", textDocument=document, contentChanges=[{"range": more, "text": ""}])
        (told,) = [each["params"] for each in said if each["params"]["uri"] == part]
        assert told["diagnostics"] == own
    # Moved by an edit above them, they are told where they stand now.
    moved = wire.change(part, 2, {"range": place(0, 0, 0), "text": "\n"})["diagnostics"]
    assert [each["range"]["start"]["line"] for each in moved] == [1, 2]


def test_an_include_that_is_being_written_in_an_open_model_silences_nothing(wire: Any, tmp_path: Path) -> None:
    for name, text in ("part.nddl", "int UNUSED = 5;\n"), ("model.nddl", '#include "part.nddl"\nint x = y;\n'):
        (tmp_path / name).write_text(text)
    root, part = (tmp_path / "model.nddl").as_uri(), (tmp_path / "part.nddl").as_uri()
    wire.start()
    wire.open(root, '#include "part.nddl"\nint x = y;\n')
    wire.open(part, "int UNUSED = 5;\n")
    broken = wire.change(root, 2, {"range": place(0, 0, 0), "text": "?"})["diagnostics"]
    assert broken[0]["range"]["start"]["line"] == 0
    whole = wire.change(root, 3, {"range": place(0, 0, 1), "text": ""})["diagnostics"]
    assert [each["code"] for each in whole] == ["NDDL201"]


def test_what_was_sent_of_a_text_is_forgotten_when_it_is_closed(tmp_path: Path) -> None:
    session = make_session(ServerSettings(), lambda *_: ())
    protocol: Any = session.protocol
    sent: list[bytes] = []
    protocol.set_writer(SimpleNamespace(write=sent.append, close=lambda: None))
    uri, _ = model(tmp_path)

    async def publish() -> None:
        session.publish(session.documents.open(uri, 1, MODEL))
        assert b"NDDL201" in sent[-1]
        assert uri in protocol.written.known
        session.publish(session.documents.close(uri))
        assert protocol.written.known == {}

    asyncio.run(publish())
