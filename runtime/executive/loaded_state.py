"""Snapshot: the state of a loaded plan database and its planner, written back in place before each mission.

A walk from the roots finds every object that can change: instances of the runtime's classes, containers and arrays.
Restoring gives each its former content under its former identity, so no reference has to be followed anew. Programs
and what else stands above the runtime never change and are shared.

Arrays are replaced by longer ones only where growth is noted (`runtime.constraints.domains.arrays`). What a mission
has made grow has that room from then on, so that the next one need not make it anew.
"""

from array import array
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from functools import partial
from types import BuiltinFunctionType, FunctionType, GetSetDescriptorType, MemberDescriptorType, MethodType, ModuleType
from typing import Any

from runtime.constraints.domains.arrays import Growth, grow_again

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
_LARGE = 2**18  # bytes of an array that is restored by itself
_ALIGNED = 64  # bytes, as processors read them
_MOST_GROWTHS = 8  # missions after which what has grown keeps its room
_ABSENT = object()


class LoadedState:
    """What the objects that can be reached from some roots hold at present; `restore` brings it back.

    What `kept` names, and what only that leads to, stays as it is.
    """

    def __init__(self, roots: Iterable[object], kept: Iterable[object] = ()) -> None:
        self._lists: list[tuple[list[Any] | deque[Any], list[Any]]] = []
        self._tables: list[tuple[dict[Any, Any] | set[Any], Any]] = []
        self._fields: dict[tuple[int, str], tuple[object, str, Any]] = {}
        self._array_fields: dict[tuple[int, str], tuple[object, Any]] = {}
        self._arrays: dict[int, tuple[memoryview, bytes]] = {}
        self._seen: dict[int, object] = {id(thing): thing for thing in kept}
        self._held: set[int] = set()  # arrays that others refer to than fields of compiled objects
        self._growths = 0
        self._is_packed = False
        stack = list(roots)
        while stack:
            thing = stack.pop()
            if isinstance(thing, _LEAVES) or id(thing) in self._seen:
                continue
            self._seen[id(thing)] = thing  # kept alive: an address names one object only as long as it lives
            stack.extend(self._keep(thing))

    def restore(self, growth: Sequence[Growth] | None = None) -> None:
        """Give every object what it held when the snapshot was taken; `growth`, if known, is all that has grown."""
        own = [one for one in growth or () if id(one[0]) in self._seen and not hasattr(one[0], "__dict__")]
        lengthened = _lengthened(own)
        for field in lengthened if growth is not None else self._array_fields:
            owner, before = self._array_fields[field]
            setattr(owner, field[1], before)
        for sequence, items in self._lists:
            if isinstance(sequence, list):
                sequence[:] = items
            else:
                sequence.clear()
                sequence.extend(items)
        for table, content in self._tables:
            table.clear()
            table.update(content)
        for owner, name, value in self._fields.values():
            setattr(owner, name, value)
        for view, content in self._arrays.values():
            view[:] = content
        if own and self._growths < _MOST_GROWTHS:
            self._growths += 1
            for one in own:
                grow_again(one)
            self._keep_lengthened(own, lengthened)
        elif not self._is_packed:
            self._pack()

    def _keep_lengthened(self, growth: Sequence[Growth], lengthened: Iterable[tuple[int, str]]) -> None:
        """Take longer arrays, that hold what was just restored, for those of the snapshot."""
        for field in lengthened:
            owner, before = self._array_fields[field]
            self._array_fields[field] = owner, self._keep_array(getattr(owner, field[1]))
            if not any(each is before for _, each in self._array_fields.values()):
                self._arrays.pop(id(before), None)
        for owner, name, _, fill in growth:
            for each in (f"{name}_first", f"{name}_last", f"{name}_mask") if fill is None else ():
                self._fields[id(owner), each] = owner, each, getattr(owner, each)

    def _pack(self) -> None:
        """Put arrays that are fields of compiled objects side by side, so that they are restored all at once."""
        self._is_packed = True
        fields = {id(each): each for _, each in self._array_fields.values() if id(each) not in self._held}
        views = {key: self._arrays[key] for key in fields if len(self._arrays[key][1]) < _LARGE}
        places, room = {}, 0
        for key, (_, content) in views.items():
            places[key] = room
            room += -(-len(content) // _ALIGNED) * _ALIGNED
        memory = memoryview(bytearray(room))
        packed = {}
        for key, (view, content) in views.items():
            part = memory[places[key] : places[key] + len(content)]
            part[:] = view
            code: Any = memoryview(fields[key]).format
            packed[key] = part.cast(code)
            del self._arrays[key]
        for (owner_id, name), (owner, each) in self._array_fields.items():
            if id(each) in packed:
                self._array_fields[owner_id, name] = owner, packed[id(each)]
                setattr(owner, name, packed[id(each)])
        self._arrays[id(memory)] = memory, bytes(memory)

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
                self._held.add(id(self._keep_array(thing)))
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
                self._array_fields[id(thing), name] = thing, self._keep_array(value)
                continue
            if not isinstance(value, _LEAVES):
                yield value
            if not is_frozen and _is_writable(thing, name, value):
                self._fields[id(thing), name] = thing, name, value
        if hasattr(thing, "__dict__"):
            yield vars(thing)

    def _keep_array(self, given: Any) -> Any:
        """Note what an array holds."""
        owner = _array_of(given)
        if id(owner) not in self._arrays:
            self._seen[id(owner)] = owner
            view = memoryview(owner).cast("B")
            self._arrays[id(owner)] = view, bytes(view)
        return owner


def _array_of(given: Any) -> Any:
    """The array behind what an attribute gives: compiled, a view of it, anew at each reading."""
    return getattr(given, "base", given)


def _lengthened(growth: Iterable[Growth]) -> dict[tuple[int, str], None]:
    """The attributes whose arrays were replaced by longer ones, by the identity of their owners."""
    found: dict[tuple[int, str], None] = {}
    for owner, names, _, fill in growth:
        for name in names.split() if fill is not None else [f"{names}_queue"]:
            found[id(owner), name] = None
    return found


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
