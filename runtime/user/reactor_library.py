"""Find the reactors that users wrote in Python."""

from pathlib import Path

from nddl_lang.text.nearest import nearest
from runtime.user.fault import UserCodeError
from runtime.user.library import load_module
from runtime.user.log_player import LogPlayer
from runtime.user.reactor import Reactor

OWN = {"LogPlayer": LogPlayer}  # what `code = ":Name"` names


def load_reactor(root: Path, file: str, class_name: str) -> type[Reactor]:
    """The class `class_name` in `file`, relative to `root`, or one of nddlc's own; raises UserCodeError."""
    known = vars(load_module(root / file)) if file else OWN
    found = known.get(class_name)
    if not isinstance(found, type) or not issubclass(found, Reactor):
        place = (root / file).as_posix() if file else "nddlc"
        meant = nearest(class_name, [name for name, each in known.items() if _is_reactor(each)])
        advice = f"did you mean `{meant}`?" if meant is not None else "docs/agent.md tells how a reactor is written"
        text = f"{place}: `{class_name}` is no reactor: no subclass of `runtime.user.reactor.Reactor`"
        raise UserCodeError(text, advice=advice)
    return found


def _is_reactor(thing: object) -> bool:
    return isinstance(thing, type) and issubclass(thing, Reactor) and thing is not Reactor
