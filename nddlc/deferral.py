"""Deferred imports: `import z3` costs nothing until a name of z3 is asked for; most commands never ask."""

import sys
from importlib.util import find_spec, module_from_spec
from threading import RLock
from types import ModuleType
from typing import Any

# What explains and proves, large, and not needed to lint, or to fly missions that pass.
LARGE = ("networkx", "z3")
_LOADING = RLock()
_BEGUN: set[str] = set()


class _Deferred(ModuleType):
    """A module whose code runs when a name is asked of it that it does not have.

    Unlike `importlib.util.LazyLoader`'s, it stays deferred when a second file imports it: `__spec__` is a name it has.
    """

    def __getattr__(self, name: str) -> Any:
        with _LOADING:  # where its own code asks, or another thread has run that code meanwhile, nothing is left to run
            spec = self.__spec__
            if self.__name__ not in _BEGUN and spec is not None and spec.loader is not None:
                _BEGUN.add(self.__name__)
                try:
                    spec.loader.exec_module(self)
                except BaseException:
                    _BEGUN.discard(self.__name__)
                    raise
                self.__class__ = ModuleType  # type: ignore[assignment]
        return ModuleType.__getattribute__(self, name)


def defer(*names: str) -> None:
    """Let later imports of these modules, where they are there and not yet imported, wait until they are used."""
    for name in names:
        spec = None if name in sys.modules else find_spec(name)
        if spec is not None:
            module = module_from_spec(spec)
            module.__class__ = _Deferred
            sys.modules[name] = module
