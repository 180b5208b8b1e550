"""Commands: what the user asks to be run, by `nddlc` as a process of its own, with progress, until it is cancelled.

Nothing is run that the user did not ask for; Python of a project only as `nddlc` itself would (docs/security.md).
"""

import asyncio
import json
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from uuid import uuid4

from lsprotocol import types

from lsp.check_results import REPORT
from lsp.mission_answers import CERTIFY, CHECK, EXPLAIN
from lsp.session import RequestFailed, Session
from lsp.uris import path_of

_PLAN = "nddl/viewPlan"
_NETWORK = "nddl/viewNetwork"
_CONFLICT = "nddl/viewConflict"
_HOLDS, _FINDINGS = 0, 1
_SECONDS = "20"  # for a plan that somebody waits for


@dataclass(frozen=True, slots=True)
class _Ended:
    """How a process ended, and what it wrote."""

    code: int
    output: str
    errors: str


def answer_commands(session: Session) -> None:
    """Let a session carry out commands, and answer what the views of an editor ask."""

    @session.command(CHECK)
    async def check(uri: Any, *missions: Any) -> dict[str, Any]:
        path = _path(uri)
        folder = _folder(session, path)
        wanted = missions[0] if missions and isinstance(missions[0], int) else 0
        count = ["--missions", str(wanted)] if wanted > 0 else []
        title = f"nddlc: flying the missions of {path.name}"
        ended = await _run(session, title, folder, "check", _seen_from(folder, path), "--format", "json", *count)
        if ended.code not in (_HOLDS, _FINDINGS):
            raise RequestFailed(ended.errors.strip() or ended.output.strip() or f"nddlc ended with {ended.code}")
        report = json.loads(ended.output)
        session.results.load(folder / REPORT, path)
        session.publish(session.documents.refresh())
        _show(session, _summary(report), is_good=ended.code == _HOLDS)
        return {
            "verdict": report["verdict"],
            "counts": report["counts"],
            "run": report["run"],
            "faults": [
                {key: fault[key] for key in ("code", "meaning", "because", "count", "place")}
                for fault in report["faults"]
            ],
            "report": (folder / REPORT.with_name("report.html")).as_uri(),
        }

    @session.command(EXPLAIN)
    async def explain(uri: Any) -> str:
        path = _path(uri)
        folder = _folder(session, path)
        title = f"nddlc: explaining the last failure of {path.name}"
        ended = await _run(session, title, folder, "explain", _seen_from(folder, path))
        if ended.code not in (_HOLDS, _FINDINGS):
            raise RequestFailed(ended.errors.strip() or ended.output.strip())
        _show(session, ended.output, is_good=False)
        return ended.output

    @session.command(CERTIFY)
    async def certify(uri: Any) -> str:
        path = _path(uri)
        ended = await _run(
            session, f"nddlc: certifying {path.name}", path.parent, "certify", _seen_from(path.parent, path)
        )
        if ended.code not in (_HOLDS, _FINDINGS):
            raise RequestFailed(ended.errors.strip() or ended.output.strip() or f"nddlc ended with {ended.code}")
        _show(session, ended.output, is_good=ended.code == _HOLDS)
        return ended.output

    async def view(params: Any, *options: str) -> dict[str, Any]:
        path = _path(_field(params, "uri"))
        plan = ("plan", _seen_from(path.parent, path), "--max-seconds", _SECONDS, *options)
        ended = await _run(session, f"nddlc: planning {path.name}", path.parent, *plan)
        return {"code": ended.code, "text": ended.output, "errors": ended.errors}

    @session.feature(_PLAN)
    async def view_plan(params: Any) -> dict[str, Any]:
        return await view(params, "--format", "html", "--explain")

    @session.feature(_NETWORK)
    async def view_network(params: Any) -> dict[str, Any]:
        return await view(params, "--json")

    @session.feature(_CONFLICT)
    async def view_conflict(params: Any) -> dict[str, Any]:
        return await view(params, "--explain")


def _summary(report: dict[str, Any]) -> str:
    """One line for the missions of a check, and one for each fault."""
    counts = report["counts"]
    lines = [f"{sum(counts.values())} missions: {counts['fail']} failed, {counts['error']} ended with an error"]
    lines += [f"{each['count']} × {each['code']}, {each['meaning']}: {each['because']}" for each in report["faults"]]
    return "\n".join(lines)


def _show(session: Session, text: str, *, is_good: bool) -> None:
    """Show the user how a command ended; an editor drops the answer to a command that a lens has called."""
    if not session.shows_results:
        kind = types.MessageType.Info if is_good else types.MessageType.Warning
        session.window_show_message(types.ShowMessageParams(kind, text.strip()))


def _field(params: Any, name: str) -> str:
    value = params.get(name) if isinstance(params, dict) else getattr(params, name, None)
    if not isinstance(value, str):
        raise RequestFailed(f"`{name}` is missing")
    return value


def _path(uri: Any) -> Path:
    path = path_of(uri) if isinstance(uri, str) else None
    if path is None or not path.is_file():
        raise RequestFailed(f"`{uri}` is no saved file")
    return path


def _folder(session: Session, path: Path) -> Path:
    """The folder of the workspace that holds a file: there `nddlc` keeps its runs and reports; else its own folder."""
    holding = [folder for folder in session.documents.folders if path.is_relative_to(folder)]
    return max(holding, key=lambda folder: len(folder.parts), default=path.parent)


def _seen_from(folder: Path, path: Path) -> str:
    """The path of a file as a user in that folder would write it; no option, whatever it begins with."""
    return f".{os.sep}{path.relative_to(folder)}"


async def _run(session: Session, title: str, folder: Path, *arguments: str) -> _Ended:
    """Run `nddlc` in a folder, which Python does not search for modules; raises RequestFailed if it was cancelled."""
    if session.is_distrusted:
        raise RequestFailed("the workspace is not trusted: nothing of it is run")
    async with asyncio.TaskGroup() as group:
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-P", "-m", "nddlc.main", *arguments),
            stdin=asyncio.subprocess.DEVNULL,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE,
            cwd=folder,
        )
        watching = group.create_task(_show_progress(session, title, process))
        try:
            output, errors = await process.communicate()
        finally:
            if process.returncode is None:
                process.terminate()
            watching.cancel()
    if process.returncode is not None and process.returncode in (-15, 143):
        raise RequestFailed("cancelled")
    return _Ended(process.returncode or 0, output.decode("utf-8", "replace"), errors.decode("utf-8", "replace"))


async def _show_progress(session: Session, title: str, process: asyncio.subprocess.Process) -> None:
    """Show that something runs, where the editor can; end it when the user does not want it any more."""
    window = session.client_capabilities.window
    if window is None or not window.work_done_progress:
        return
    progress, token = session.work_done_progress, str(uuid4())
    await progress.create_async(token)
    progress.begin(token, types.WorkDoneProgressBegin(title, cancellable=True))
    try:
        while not progress.tokens[token].cancelled():
            await asyncio.sleep(0.1)
        process.terminate()
    finally:
        progress.end(token, types.WorkDoneProgressEnd())
        del progress.tokens[token]
