"""The tables that the parser runs on are those of the grammar."""

from nddl_lang.syntax.generate import GRAMMAR, TABLES, render, tables


def test_the_tables_are_in_step_with_the_grammar() -> None:
    written = TABLES.read_text(encoding="utf-8")
    made = render(tables(GRAMMAR.read_text(encoding="utf-8")))
    assert written == made, "run python -m nddl_lang.syntax.generate"
