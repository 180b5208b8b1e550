"""The tree-sitter grammar beside the parser of nddlc: in every model the same statements and the same grouping."""

import ctypes
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tree_sitter import Language, Node, Parser, Query

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import parse
from nddl_lang.syntax.walk import descendants
from nddl_lang.syntax.words import RELATIONS, RESERVED
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.source import Source

ROOT = Path(__file__).resolve().parents[2]
GRAMMAR = ROOT / "editors" / "tree-sitter-nddl"
QUERIES = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "editors").rglob("*.scm"))
KINDS = {
    "Include": "include",
    "TypedefDecl": "typedef",
    "EnumDecl": "enum",
    "VariableDecl": "variables",
    "Assignment": "assignment",
    "ClassDecl": "class",
    "PredicateDecl": "predicate",
    "ConstructorDecl": "constructor",
    "SuperCall": "super_call",
    "RuleDecl": "rule",
    "IfStatement": "if",
    "Foreach": "foreach",
    "GoalStatement": "goal",
    "Relation": "relation",
    "IntervalExpr": "interval",
    "SetExpr": "set",
}


@pytest.fixture(scope="module")
def language(tmp_path_factory: pytest.TempPathFactory) -> Language:
    """The grammar, compiled as an editor does it."""
    script = "import json, engine_build as one; print(json.dumps(one.machine_compiler() or one.zig_compiler()))"
    asked = subprocess.run([sys.executable, "-c", script], cwd=ROOT / "build_backend", check=True, capture_output=True)
    compiler = json.loads(asked.stdout)
    target = tmp_path_factory.mktemp("grammar") / "nddl.so"
    assert compiler is not None, "the engine was compiled, so there is a compiler"
    source = GRAMMAR / "src" / "parser.c"
    subprocess.run(
        [*compiler, "-O1", "-shared", "-fPIC", f"-I{source.parent}", str(source), "-o", str(target)], check=True
    )
    begin = ctypes.CDLL(str(target)).tree_sitter_nddl
    begin.restype = ctypes.c_void_p
    capsule = ctypes.pythonapi.PyCapsule_New
    capsule.restype, capsule.argtypes = ctypes.py_object, (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p)
    return Language(capsule(begin(), b"tree_sitter.Language", None))


def models() -> list[Path]:
    folders = ("models", "tests", "docs", "editors", "nddlc")
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*.nddl") if path.is_file())


def nodes(node: Node) -> Iterator[Node]:
    yield node
    for child in node.children:
        yield from nodes(child)


def statements(node: Node) -> set[tuple[str, int]]:
    kinds = set(KINDS.values())
    return {(each.type, each.start_byte) for each in nodes(node) if each.type in kinds}


def expected(module: Any, text: str) -> set[tuple[str, int]]:
    found = set()
    for node in descendants(module):
        kind = KINDS.get(type(node).__name__)
        if kind is not None:
            found.add((kind, len(text[: node.span.begin].encode())))
    return found


def shape(node: Any) -> str:
    """How an expression is grouped; operands are left out, and the sign of a number."""
    match type(node).__name__:
        case "BinaryExpr":
            return f"({shape(node.left)}{node.op}{shape(node.right)})"
        case "UnaryExpr" if type(node.operand).__name__ not in ("IntLiteral", "FloatLiteral"):
            return f"{node.op}{shape(node.operand)}"
        case _:
            return "."


def shape_of_node(node: Node) -> str:
    """The same in the tree of an editor."""
    if node.type == "parenthesised":
        return shape_of_node(node.named_children[0])
    fields = [node.child_by_field_name(name) for name in ("left", "operator", "right")]
    if node.type == "binary" and None not in fields:
        left, operator, right = (part for part in fields if part is not None)
        return f"({shape_of_node(left)}{operator.type}{shape_of_node(right)})"
    if node.type == "unary" and node.children[1].type != "number":
        return f"{node.children[0].type}{shape_of_node(node.children[1])}"
    return "."


def test_models_have_the_same_statements_in_both_parsers(language: Language) -> None:
    parser, compared = Parser(language), 0
    for path in models():
        data = path.read_bytes()
        try:
            text = data.decode()
        except UnicodeDecodeError:
            continue
        ours = parse(Source(path.name, text), Dialect.NDDLC)
        if any(one.severity is Severity.ERROR for one in ours.diagnostics):
            continue
        root = parser.parse(data).root_node
        assert not root.has_error, path
        assert statements(root) == expected(ours.module, text), path
        theirs = sorted(shape_of_node(each) for each in nodes(root) if each.type == "binary")
        assert theirs == sorted(shape(each) for each in descendants(ours.module) if type(each).__name__ == "BinaryExpr")
        compared += 1
    assert compared > 600


def test_every_word_of_the_language_is_a_word_of_the_grammar(language: Language) -> None:
    words = {language.node_kind_for_id(number) for number in range(language.node_kind_count)}
    assert sorted(RESERVED - words) == []
    relation = Parser(language).parse(b"A::b { equal c; }").root_node
    assert "relation_word" in {node.type for node in nodes(relation)} and "equal" in RELATIONS


@pytest.mark.parametrize("name", QUERIES)
def test_the_queries_of_editors_fit_the_grammar(language: Language, name: str) -> None:
    assert Query(language, (ROOT / name).read_text()).capture_count > 0


@pytest.mark.parametrize(
    ("copy", "source"),
    [("zed/languages/nddl/highlights.scm", "highlights.scm"), ("helix/queries/nddl/locals.scm", "locals.scm")],
)
def test_copies_of_queries_are_alike(copy: str, source: str) -> None:
    """An editor takes its whole folder, so it has its own."""
    theirs, ours = ((GRAMMAR.parent / copy).read_text(), (GRAMMAR / "queries" / source).read_text())
    assert [line for line in theirs.splitlines() if line[:1] != ";"] == [
        line for line in ours.splitlines() if line[:1] != ";"
    ]


def test_a_text_that_is_being_typed_keeps_what_is_whole(language: Language) -> None:
    text = b"class A extends Timeline { predicate p { int n; } }\nA::p { duration >= \nA::q { starts(B.r c); }\n"
    root = Parser(language).parse(text).root_node
    assert root.has_error
    assert {"class", "predicate", "rule"} <= {node.type for node in nodes(root)}
