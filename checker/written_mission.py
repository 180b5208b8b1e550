"""The tables of a mission in, the text of its mission file out."""

import json
from collections.abc import Iterator

from checker.mission_table import TomlTable


def mission_toml(values: TomlTable) -> str:
    """The tables as TOML; what is empty is left out."""
    return "\n".join(_lines(values, ())).strip("\n") + "\n"


def _lines(table: TomlTable, path: tuple[str, ...]) -> Iterator[str]:
    """The values of a table, then the tables in it."""
    inner = {key: value for key, value in table.items() if isinstance(value, dict) or _are_tables(value)}
    yield from (f"{key_text(key)} = {_text(value)}" for key, value in table.items() if key not in inner)
    for key, value in inner.items():
        header = ".".join(key_text(each) for each in (*path, key))
        if isinstance(value, dict) and value:
            yield from ("", f"[{header}]", *_lines(value, (*path, key)))
        for each in value if isinstance(value, list) else ():
            yield from ("", f"[[{header}]]", *_lines(each, (*path, key)))


def _are_tables(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(each, dict) for each in value)


def key_text(name: str) -> str:
    """A key, in quotes where it needs them."""
    is_bare = all(sign.isascii() and (sign.isalnum() or sign in "_-") for sign in name)
    return name if name and is_bare else quoted(name)


def _text(value: object) -> str:
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return quoted(value)
        case list() | tuple():
            return f"[{', '.join(map(_text, value))}]"
        case _:
            return repr(value)


def quoted(text: str) -> str:
    """A basic string of TOML."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
