"""Commands: missions are flown because somebody asked, and what failed stands at its line until the model changes."""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder where somebody has flown 20 missions of the GPS model on the command line; it is left as it is."""
    folder = tmp_path_factory.mktemp("project")
    shutil.copytree(ROOT / "models" / "gps", folder / "gps")
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert run(["check", "gps/mission.toml", "--missions", "20", "--flights", "4"]) == 1
    finally:
        os.chdir(before)
    yield folder


@pytest.fixture
def checked(client: Any, tmp_path: Path) -> tuple[Any, Path, dict[str, Any]]:
    """A client whose user has had 20 missions of the GPS model flown."""
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start(folder=tmp_path)
    rules = tmp_path / "gps" / "rules.nddl"
    client.open(rules.as_uri(), rules.read_text())
    result = client.ask(
        "workspace/executeCommand",
        command="nddl.check",
        arguments=[(tmp_path / "gps" / "mission.toml").as_uri(), 20],
    )
    return client, rules, result


def failures(told: Any) -> list[Any]:
    return [each for each in told["diagnostics"] if each["source"] == "nddlc check"]


def test_a_failure_stands_at_its_line_until_the_model_changes(checked: Any, tmp_path: Path) -> None:
    client, rules, result = checked
    assert result["verdict"] == "fails"
    assert result["counts"]["fail"] > 0
    assert (tmp_path / "nddlc-report" / "report.html").as_uri() == result["report"]
    uri = rules.as_uri()
    text = rules.read_text()
    (failure,) = failures(client.change(uri, {"text": text}))
    line = failure["range"]["start"]["line"]
    assert "SURFACE_MAX" in text.split("\n")[line]
    assert failure["severity"] == 2
    assert "fails when GPS_HIT_RATE" in failure["message"]
    assert failure["relatedInformation"][0]["location"]["uri"].endswith("navigator.nddl")
    assert "fails when GPS_HIT_RATE" in client.hover(uri, line, 6)

    # The model changes: the failure is shown as one of before, and moves with its line.
    (failure,) = failures(client.change(uri, {"text": "// new\n" + text}))
    assert failure["range"]["start"]["line"] == line + 1
    assert (failure["severity"], failure["tags"]) == (4, [1])
    assert "before the last change" in failure["message"]
    (failure,) = failures(client.change(uri, {"text": text}))
    assert failure["severity"] == 2
    assert client.leave() == 0


def test_a_report_of_the_command_line_is_found(start_client: Any, project: Path) -> None:
    rules = project / "gps" / "rules.nddl"
    other = start_client()
    other.start(folder=project)
    told = other.open(rules.as_uri(), rules.read_text())
    assert [each["severity"] for each in failures(told)] == [2]
    later = (project / "nddlc-report" / "report.json").stat().st_mtime + 10
    navigator = rules.with_name("navigator.nddl")
    text, times = navigator.read_text(), navigator.stat()
    navigator.write_text(text + "// changed\n")
    os.utime(navigator, (later, later))
    third = start_client()
    third.start(folder=project)
    assert [each["severity"] for each in failures(third.open(rules.as_uri(), rules.read_text()))] == [4]
    navigator.write_text(text)
    os.utime(navigator, ns=(times.st_atime_ns, times.st_mtime_ns))


def test_the_last_failure_is_explained(client: Any, project: Path) -> None:
    client.start(folder=project)
    uri = (project / "gps" / "mission.toml").as_uri()
    told = client.ask("workspace/executeCommand", command="nddl.explain", arguments=[uri])
    assert "GPS_HIT_RATE" in told
    # The last run of that mission, whatever was flown since.
    other = uri.replace("mission.toml", "mended.toml")
    client.ask("workspace/executeCommand", command="nddl.check", arguments=[other, 1])
    assert client.ask("workspace/executeCommand", command="nddl.explain", arguments=[uri]) == told
    answer = client.ask("workspace/executeCommand", command="nddl.explain", arguments=[other])
    assert "no mission of run" in answer["error"]["message"]


def test_a_mission_is_certified(client: Any, tmp_path: Path) -> None:
    """The outcome is shown as well: an editor drops the answer to a command that a lens has called."""
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start(folder=tmp_path)
    for name, weight, word in ("mended.toml", 3, "gps: certified"), ("mission.toml", 2, "gps: refuted"):
        uri = (tmp_path / "gps" / name).as_uri()
        client.send(
            id="certify", method="workspace/executeCommand", params={"command": "nddl.certify", "arguments": [uri]}
        )
        shown = client.wait(lambda message: message.get("method") == "window/showMessage")["params"]
        answer = client.wait(lambda message: message.get("id") == "certify")
        assert answer["result"].strip() == shown["message"]
        assert (shown["type"], shown["message"].startswith(word)) == (weight, True)


def test_who_shows_results_is_told_nothing(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start({"showsResults": True}, folder=tmp_path)
    uri = (tmp_path / "gps" / "mission.toml").as_uri()
    client.send(id="check", method="workspace/executeCommand", params={"command": "nddl.check", "arguments": [uri, 1]})
    told = client.wait(lambda each: each.get("id") == "check" or each.get("method") == "window/showMessage")
    assert told["result"]["verdict"]


def test_views_show_a_plan_its_tokens_and_why_there_is_none(client: Any, tmp_path: Path) -> None:
    text = "class C extends Timeline { predicate p { } }\nC c = new C();\ngoal(c.p one);\none.start.specify(3);\n"
    (tmp_path / "model.nddl").write_text(text)
    (tmp_path / "never.nddl").write_text(text + "leq(10, one.end);\nleq(one.end, 5);\n")
    client.start(folder=tmp_path)
    uri = (tmp_path / "model.nddl").as_uri()
    assert "<svg" in client.ask("nddl/viewPlan", uri=uri)["text"]
    assert '"tokens"' in client.ask("nddl/viewNetwork", uri=uri)["text"]
    assert "never.nddl:6" in client.ask("nddl/viewPlan", uri=uri.replace("model", "never"))["text"]
    conflict = client.ask("nddl/viewConflict", uri=uri.replace("model", "never"))
    assert conflict["code"] == 1
    assert "never.nddl" in conflict["text"] + conflict["errors"]


def test_a_command_that_cannot_be_carried_out_says_why(client: Any, tmp_path: Path) -> None:
    client.start(folder=tmp_path)
    (tmp_path / "mission.toml").write_text("[mission]\n")
    for uri, word in ((tmp_path / "no.toml").as_uri(), "no saved file"), ((tmp_path / "mission.toml").as_uri(), "name"):
        answer = client.ask("workspace/executeCommand", command="nddl.check", arguments=[uri])
        assert word in answer["error"]["message"]
    assert client.ask("nddl/viewPlan")["error"]["code"] == -32803
    assert not (tmp_path / "nddlc-report").exists()


def test_a_check_shows_progress_and_can_be_cancelled(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start(folder=tmp_path, capabilities={"window": {"workDoneProgress": True}})
    uri = (tmp_path / "gps" / "mission.toml").as_uri()
    params = {"command": "nddl.check", "arguments": [uri, 100000]}
    client.send(id="check", method="workspace/executeCommand", params=params)
    created = client.wait(lambda message: message.get("method") == "window/workDoneProgress/create")
    client.send(id=created["id"], result=None)
    begun = client.wait(lambda message: message.get("method") == "$/progress")["params"]
    assert (begun["value"]["kind"], begun["value"]["cancellable"]) == ("begin", True)
    client.notify("window/workDoneProgress/cancel", token=begun["token"])
    answer = client.wait(lambda message: message.get("id") == "check")
    assert answer["error"]["message"] == "cancelled"
    assert client.leave() == 0


def test_a_check_ends_with_its_request(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start(folder=tmp_path, capabilities={"window": {"workDoneProgress": True}})
    uri = (tmp_path / "gps" / "mission.toml").as_uri()
    params = {"command": "nddl.check", "arguments": [uri, 100000]}
    client.send(id="check", method="workspace/executeCommand", params=params)
    created = client.wait(lambda message: message.get("method") == "window/workDoneProgress/create")
    client.send(id=created["id"], result=None)
    client.wait(lambda message: message.get("method") == "$/progress")
    client.notify("$/cancelRequest", id="check")
    ended = [client.wait(lambda message: message.get("id") == "check" or message.get("method") == "$/progress")]
    ended.append(client.wait(lambda message: message.get("id") == "check" or message.get("method") == "$/progress"))
    (answer,) = [each for each in ended if each.get("id") == "check"]
    (progress,) = [each["params"]["value"] for each in ended if "params" in each]
    assert answer["error"]["code"] == -32800
    assert progress["kind"] == "end"
    assert client.leave() == 0


def test_a_mission_that_is_not_trusted_has_no_lenses(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start({"isTrusted": False}, folder=tmp_path)
    mission = tmp_path / "gps" / "mission.toml"
    client.open(mission.as_uri(), mission.read_text())
    assert client.ask("textDocument/codeLens", textDocument={"uri": mission.as_uri()}) == []


def test_nothing_is_run_in_a_workspace_that_is_not_trusted(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models" / "gps", tmp_path / "gps")
    client.start({"isTrusted": False}, folder=tmp_path)
    uri = (tmp_path / "gps" / "mission.toml").as_uri()
    for answer in (
        client.ask("workspace/executeCommand", command="nddl.check", arguments=[uri, 1]),
        client.ask("workspace/executeCommand", command="nddl.explain", arguments=[uri]),
        client.ask("workspace/executeCommand", command="nddl.certify", arguments=[uri]),
        client.ask("nddl/viewPlan", uri=(tmp_path / "gps" / "navigator.nddl").as_uri()),
    ):
        assert "not trusted" in answer["error"]["message"]
    assert not (tmp_path / "nddlc-report").exists()
