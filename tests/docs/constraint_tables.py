"""The tables of docs/constraints.md, made from the tables of the language; run it to write them anew."""

from collections.abc import Iterator
from pathlib import Path

from nddl_lang.semantics.constraints import CONSTRAINTS, ConstraintRow, Origin
from nddl_lang.semantics.functions import FUNCTIONS, FunctionRow

PAGE = Path(__file__).parents[2] / "docs" / "constraints.md"
BEGIN = "<!-- made by tests/docs/constraint_tables.py from here on -->\n"


def tables() -> str:
    """What stands below the mark."""
    return "\n".join(_lines()) + "\n"


def _lines() -> Iterator[str]:
    yield ""
    yield "| constraint | what it says | follows |"
    yield "| --- | --- | --- |"
    for row in CONSTRAINTS.values():
        yield f"| `{row.name}({row.signature.text})` | {_meaning(row)} | {_follows(row)} |"
    yield ""
    yield "## Built-in functions"
    yield ""
    yield "A function stands in an expression; a constraint of the table above binds its value."
    yield ""
    yield "| function | gives | bound by |"
    yield "| --- | --- | --- |"
    for function in FUNCTIONS.values():
        yield f"| `{function.name}({function.signature.text})` | {_gives(function)} | `{function.constraint}` |"


def _meaning(row: ConstraintRow) -> str:
    text = row.meaning if row.alias_of is None else f"the same as `{row.alias_of}`"
    return f"{text}{_origin(row.origin)}"


def _gives(row: FunctionRow) -> str:
    return f"{row.meaning}{_origin(row.origin)}"


def _origin(origin: Origin) -> str:
    return "" if origin is Origin.EUROPA else f" ({origin.value})"


def _follows(row: ConstraintRow) -> str:
    if row.forward_only:
        return "once the others are known"
    return "both ways"


def main() -> None:
    """Write the tables into the page."""
    head, _, _ = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    PAGE.write_text(head + BEGIN + tables(), encoding="utf-8")


if __name__ == "__main__":
    main()
