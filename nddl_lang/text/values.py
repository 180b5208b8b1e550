"""Texts of TOML and JSON and their values; what is too deep or too long for the reader is a mistake of the text."""

import json
import re
import tomllib
from collections.abc import Callable
from typing import Any

from nddl_lang.text.toml_places import toml_of

_DEEP, _LONG = "it is nested too deep", "a number in it is too long"
# Readers of TOML take a time that grows with the square of the parts of a key.
_MANY_PARTS = re.compile(r"""^(?:[^=\n#"'.]*\.){200}""", re.MULTILINE)


def toml_value(text: str) -> dict[str, Any]:
    """The table of a text; raises TOMLDecodeError."""
    if _MANY_PARTS.search(text):
        raise tomllib.TOMLDecodeError(_DEEP)
    try:
        return tomllib.loads(toml_of(text))
    except tomllib.TOMLDecodeError:
        raise
    except RecursionError:
        raise tomllib.TOMLDecodeError(_DEEP) from None
    except ValueError:
        raise tomllib.TOMLDecodeError(_LONG) from None


def json_value(text: str, parse_constant: Callable[[str], Any] | None = None) -> Any:
    """The value of a text; raises JSONDecodeError."""
    try:
        return json.loads(text, parse_constant=parse_constant)
    except RecursionError:
        raise json.JSONDecodeError(_DEEP, text, 0) from None
    except ValueError as problem:
        if type(problem) is not ValueError:
            raise
        raise json.JSONDecodeError(_LONG, text, 0) from None


def json_text(value: Any, indent: int | None = 1) -> str:
    """The text of a value, without a line's end; JSON has no infinite numbers, so these raise ValueError."""
    return json.dumps(value, ensure_ascii=False, indent=indent, allow_nan=False)
