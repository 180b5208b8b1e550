"""A value of the protocol of which some parts make no sense in; the same without these parts out."""

from collections.abc import Callable
from typing import Any, get_args, get_type_hints

import attrs

Structure = Callable[[Any, Any], Any]
_NOTHING = object()
_PLAIN = (str, int, float, bool, type(None))


def sensible(value: dict[str, Any], wanted: type, structure: Structure) -> dict[str, Any]:
    """What is left of an object of the protocol without the members, at any depth, that are not what they should be.

    `structure` raises where a value is not of a type. An object that lacks a member which it needs is left out whole.
    """
    left = _sensible(value, wanted, structure)
    return left if isinstance(left, dict) else {}


def _sensible(value: Any, wanted: Any, structure: Structure) -> Any:
    kinds = get_args(wanted) or (wanted,)
    classes = [each for each in kinds if isinstance(each, type) and attrs.has(each)]
    if isinstance(value, dict) and len(classes) == 1:
        types = {_camel(name): each for name, each in get_type_hints(classes[0]).items()}
        parts = {
            key: _sensible(each, types[key], structure) if key in types else each  # of what nobody knows
            for key, each in value.items()
        }
        value = {key: each for key, each in parts.items() if each is not _NOTHING}
    elif value is not None and all(each in _PLAIN for each in kinds) and type(value) not in kinds:
        return _NOTHING  # cattrs would take anything
    try:
        structure(value, wanted)
    except Exception:  # whatever cattrs and the hooks of lsprotocol raise
        return _NOTHING
    return value


def _camel(name: str) -> str:
    head, *rest = name.rstrip("_").split("_")
    return head + "".join(each.capitalize() for each in rest)
