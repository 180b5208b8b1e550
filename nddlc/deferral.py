"""Deferred imports: `import z3` costs nothing until a name of z3 is asked for; most commands never ask."""

import signal
import sys
from importlib.util import find_spec, module_from_spec
from threading import RLock
from types import ModuleType
from typing import Any

from checker.batch.signals import FirstSignals

# What explains and proves, large, and not needed to lint, or to fly missions that pass.
LARGE = ("networkx", "z3")
_LOADING = RLock()
_BEGUN = "__begun__"


class _Deferred(ModuleType):
    """A module whose code runs when a name is asked of it that it does not have.

    Unlike `importlib.util.LazyLoader`'s, it stays deferred when a second file imports it: `__spec__` is a name it has.
    """

    def __getattr__(self, name: str) -> Any:
        with _LOADING:  # where its own code asks, or another thread has run that code meanwhile, nothing is left to run
            if _BEGUN not in self.__dict__:
                self._load()
        return ModuleType.__getattribute__(self, name)

    def _load(self) -> None:
        """Run the code; a signal that comes meanwhile is heeded afterwards: half a module is of no use."""
        assert self.__spec__ is not None
        assert self.__spec__.loader is not None
        self.__dict__[_BEGUN] = True
        try:
            with FirstSignals() as signals:
                self.__spec__.loader.exec_module(self)
        except BaseException:
            del self.__dict__[_BEGUN]
            raise
        self.__class__ = ModuleType  # type: ignore[assignment]
        if signals.first is not None:
            signal.raise_signal(signals.first)


def defer(*names: str) -> None:
    """Let later imports of these modules, where they are there and not yet imported, wait until they are used."""
    for name in names:
        spec = None if name in sys.modules else find_spec(name)
        if spec is not None:
            module = module_from_spec(spec)
            module.__class__ = _Deferred
            sys.modules[name] = module


def defer_large() -> None:
    """Defer what most commands never need."""
    defer(*LARGE)
