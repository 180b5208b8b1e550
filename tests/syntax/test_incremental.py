"""An edit parses again only what it changed, and every span stays right."""

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.incremental import Incremental, common_ends
from nddl_lang.syntax.nodes import Statement
from nddl_lang.syntax.parser import Parse

TEXT = "int a = 1;\nclass T { predicate p { int x; } }\nT::p { x == 1; }\nint b = 2;\n"


def statements(parsed: Parse) -> tuple[Statement, ...]:
    return parsed.module.statements


def kept(before: Parse, after: Parse) -> list[bool]:
    """For each statement after an edit, whether it was there before."""
    known = set(map(id, statements(before)))
    return [id(statement) in known for statement in statements(after)]


def test_an_edit_inside_a_statement_renews_only_that() -> None:
    incremental = Incremental("t")
    before = incremental.update(TEXT)
    after = incremental.update(TEXT.replace("x == 1", "x == 12"))
    assert kept(before, after) == [True, True, False, True]
    assert [statement.span.text for statement in statements(after)] == [
        "int a = 1;",
        "class T { predicate p { int x; } }",
        "T::p { x == 12; }",
        "int b = 2;",
    ]
    assert statements(after)[3].span.line == 4


def test_lines_put_in_above_move_what_is_below() -> None:
    incremental = Incremental("t")
    before = incremental.update(TEXT)
    after = incremental.update("\n// new\n" + TEXT)
    assert kept(before, after) == [False, True, True, True]
    assert [statement.span.line for statement in statements(after)] == [3, 4, 5, 6]


def test_a_statement_that_moves_stays_the_same() -> None:
    incremental = Incremental("t")
    before = incremental.update("int a;\nint b;\nint c;\n")
    after = incremental.update("int b;\nint c;\nint a;\n")
    assert sum(kept(before, after)) >= 1
    assert [statement.span.text for statement in statements(after)] == ["int b;", "int c;", "int a;"]


def test_an_opened_comment_swallows_the_rest_until_it_is_closed() -> None:
    incremental = Incremental("t")
    incremental.update(TEXT)
    opened = incremental.update(TEXT.replace("T::p", "/* T::p"))
    assert len(statements(opened)) == 2
    assert len(opened.diagnostics) == 1
    closed = incremental.update(TEXT.replace("T::p", "/* */ T::p"))
    assert len(statements(closed)) == 4
    assert closed.diagnostics == ()


def test_an_else_that_comes_later_belongs_to_its_if() -> None:
    incremental = Incremental("t")
    incremental.update("T::p if (a) b;\nint c;\n")
    after = incremental.update("T::p if (a) b;\nelse d;\nint c;\n")
    assert [type(statement).__name__ for statement in statements(after)] == ["RuleDecl", "VariableDecl"]


def test_the_dialect_is_kept() -> None:
    incremental = Incremental("t", Dialect.NDDL3)
    incremental.update("int a = 1;")
    assert len(incremental.update("int a = 1 + 1;").diagnostics) == 1


def test_common_ends_do_not_overlap() -> None:
    assert common_ends("aaa", "aaaa") == (3, 0)
    assert common_ends("abcd", "abxcd") == (2, 2)
    assert common_ends("", "x") == (0, 0)
    assert common_ends("same", "same") == (4, 0)
