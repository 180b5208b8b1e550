"""Log that a player plays: the trace or transaction log that a `:LogPlayer` names is looked at before it is flown."""

import re
from pathlib import Path

from checker.codes import MISSING_KEY, NO_LOG
from checker.mission_table import MissionText
from checker.named_files import look_at
from nddl_lang.text.nearest import nearest
from nddl_lang.text.toml_places import Path as Keys
from nddl_lang.text.values import json_value
from runtime.user.transaction_log import SUFFIX, TransactionLogError, read_transaction_log

_REACTOR = re.compile(r'"reactor": ?"((?:[^"\\]|\\.)*)"')


def look_at_log(text: MissionText, path: Keys, root: Path, settings: dict[str, object]) -> None:
    """Complain of a player (the reactor at `path`) that cannot play: its settings, its file, or what is in it."""
    trace, reactor = settings.get("trace"), settings.get("reactor")
    needed = ("trace",) if isinstance(trace, str) and trace.endswith(SUFFIX) else ("trace", "reactor")
    place = (*path, "settings") if settings else path
    for key in needed:
        if not isinstance(settings.get(key), str):
            span = text.value_span((*place, key)) if key in settings else text.key_span(place)
            text.diagnostics.append(MISSING_KEY.at(span, table="[reactor.settings] of a player", key=key))
            return
    at = (*path, "settings", "trace")
    if not look_at(text, at, root, str(trace)):
        return
    problem, help_text = _problem(root / str(trace), str(reactor))
    if problem:
        text.diagnostics.append(NO_LOG.at(text.value_span(at), path=trace, problem=problem, help=help_text))


def _problem(file: Path, reactor: str) -> tuple[str, str | None]:
    """Why a log cannot be played, and what helps; empty if it can."""
    try:
        if file.name.endswith(SUFFIX):
            read_transaction_log(file)
            return "", None
        content = file.read_text(encoding="utf-8")
        first = json_value(content.partition("\n")[0])
    except (OSError, ValueError) as problem:
        is_told = isinstance(problem, TransactionLogError | OSError)
        return str(problem) if is_told else "it is no trace", "`nddlc run --trace FILE` writes one"
    if not isinstance(first, dict) or "kind" not in first:
        return "it is no trace", "`nddlc run --trace FILE` writes one"
    names = sorted(set(_REACTOR.findall(content)) - {""})
    if reactor in names:
        return "", None
    close = nearest(reactor, names)
    there = f"did you mean `{close}`?" if close else f"it has {', '.join(f'`{name}`' for name in names) or 'none'}"
    return f"it has no reactor `{reactor}`", there
