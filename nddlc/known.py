"""What models of a project may call, as far as that is known without running the project's Python."""

from importlib.metadata import entry_points

from nddl_lang.lint.project_modules import read_callables
from nddl_lang.lint.settings import Settings
from nddl_lang.semantics.callables import ENTRY_POINTS, NATIVE_CALLABLES, Callables
from nddl_lang.text.diagnostic import Diagnostic
from nddlc.main import named


def known_callables(settings: Settings, *, is_trusted: bool) -> tuple[Callables, tuple[Diagnostic, ...]]:
    """The constraints of installed packages, and those of the project: read, or run where it is trusted."""
    if is_trusted and settings.modules:
        callables: Callables = named("runtime.user.library:library_of")(settings).callables
        return callables, ()
    native = NATIVE_CALLABLES
    if entry_points(group=ENTRY_POINTS):  # else the engine need not be imported
        native = named("runtime.user.library:library_of")(Settings()).callables
    return read_callables(settings, native)
