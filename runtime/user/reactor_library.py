"""Find the reactors that users wrote in Python."""

from pathlib import Path

from runtime.user.fault import UserCodeError
from runtime.user.library import load_module
from runtime.user.log_player import LogPlayer
from runtime.user.reactor import Reactor

OWN = {"LogPlayer": LogPlayer}  # what `code = ":Name"` names


def load_reactor(root: Path, file: str, class_name: str) -> type[Reactor]:
    """The class `class_name` in `file`, relative to `root`, or one of nddlc's own; raises UserCodeError."""
    found = OWN.get(class_name) if not file else getattr(load_module(root / file), class_name, None)
    if not isinstance(found, type) or not issubclass(found, Reactor):
        place = (root / file).as_posix() if file else "nddlc"
        raise UserCodeError(f"{place}: `{class_name}` is no reactor: no subclass of `runtime.user.reactor.Reactor`")
    return found
