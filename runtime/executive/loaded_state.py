"""Snapshot: the state of a loaded plan database and its planner, written back in place before each mission.

A walk from the roots finds every object that can change: instances of the runtime's classes, containers and arrays.
Restoring gives each its former content under its former identity, so no reference has to be followed anew. Programs
and what else stands above the runtime never change and are shared.
"""

from array import array
from collections import deque
from collections.abc import Iterable, Iterator
from enum import Enum
from functools import partial
from types import BuiltinFunctionType, FunctionType, GetSetDescriptorType, MemberDescriptorType, MethodType, ModuleType
from typing import Any

_LEAVES = (
    type(None),
    bool,
    int,
    float,
    str,
    bytes,
    type,
    Enum,
    BuiltinFunctionType,
    ModuleType,
    range,
)
_HOME = "runtime."
_ABSENT = object()


class LoadedState:
    """What the objects that can be reached from some roots hold at present; `restore` brings it back.

    What `kept` names, and what only that leads to, stays as it is.
    """

    def __init__(self, roots: Iterable[object], kept: Iterable[object] = ()) -> None:
        self._lists: list[tuple[list[Any] | deque[Any], list[Any]]] = []
        self._tables: list[tuple[dict[Any, Any] | set[Any], Any]] = []
        self._fields: list[tuple[object, str, Any]] = []
        self._arrays: list[tuple[memoryview, bytes]] = []
        self._seen: dict[int, object] = {id(thing): thing for thing in kept}
        self._buffers: dict[int, memoryview] = {}
        stack = list(roots)
        while stack:
            thing = stack.pop()
            if isinstance(thing, _LEAVES) or id(thing) in self._seen:
                continue
            self._seen[id(thing)] = thing  # kept alive: an address names one object only as long as it lives
            stack.extend(self._keep(thing))

    def restore(self) -> None:
        """Give every object what it held when the snapshot was taken."""
        for sequence, items in self._lists:
            if isinstance(sequence, list):
                sequence[:] = items
            else:
                sequence.clear()
                sequence.extend(items)
        for table, content in self._tables:
            table.clear()
            table.update(content)
        for owner, name, value in self._fields:
            setattr(owner, name, value)
        for view, content in self._arrays:
            view[:] = content

    def _keep(self, thing: Any) -> Iterator[object]:
        """Note what a thing holds; gives what it refers to."""
        match thing:
            case list() | deque():
                self._lists.append((thing, list(thing)))
                yield from thing
            case dict():
                self._tables.append((thing, dict(thing)))
                yield from thing.keys()
                yield from thing.values()
            case set():
                self._tables.append((thing, set(thing)))
                yield from thing
            case tuple() | frozenset():
                yield from thing
            case array() | memoryview():
                self._keep_array(thing)
            case MethodType():
                yield thing.__self__
            case partial():
                yield from (thing.func, thing.args, thing.keywords)
            case FunctionType():
                yield from (cell.cell_contents for cell in thing.__closure__ or ())
            case _ if type(thing).__module__.startswith(_HOME):
                yield from self._keep_fields(thing)
            case _ if type(thing).__module__ == "builtins":
                raise TypeError(f"a snapshot cannot hold a `{type(thing).__name__}`")
            case _:
                pass  # of the compiler or the language, which nothing changes, or of the modeler

    def _keep_fields(self, thing: Any) -> Iterator[object]:
        """Note the attributes of an instance."""
        parameters = getattr(thing, "__dataclass_params__", None)
        is_frozen = parameters is not None and parameters.frozen
        for name in _slots(type(thing)):
            value = getattr(thing, name, _ABSENT)
            if value is _ABSENT:
                continue
            if type(value).__name__ == "_memoryviewslice":
                value = self._keep_array(value)
            elif not isinstance(value, _LEAVES):
                yield value
            if not is_frozen and _is_writable(thing, name, value):
                self._fields.append((thing, name, value))
        if hasattr(thing, "__dict__"):
            yield vars(thing)

    def _keep_array(self, given: Any) -> Any:
        """Note what an array holds; compiled attributes give a view of it, anew at each reading."""
        owner = getattr(given, "base", given)
        if id(owner) not in self._buffers:
            self._seen[id(owner)] = owner
            view = memoryview(owner).cast("B")
            self._buffers[id(owner)] = view
            self._arrays.append((view, bytes(view)))
        return owner


def _is_writable(thing: object, name: str, value: object) -> bool:
    """Whether an attribute is stored: what a compiled class derives from others cannot be set."""
    try:
        setattr(thing, name, value)
    except AttributeError:
        return False
    return True


def _slots(cls: type) -> list[str]:
    """The names of the attributes that instances of a class hold outside a dictionary."""
    return [
        name
        for each in cls.__mro__
        for name, value in vars(each).items()
        if isinstance(value, (GetSetDescriptorType, MemberDescriptorType)) and not name.startswith("__")
    ]
