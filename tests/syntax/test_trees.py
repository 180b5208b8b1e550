"""Text in, tree out."""

import pytest

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import BinaryExpr
from nddl_lang.syntax.parser import parse
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.source import Source
from tests.syntax.outline import outline

# What both dialects understand.
PORTABLE = {
    "int a = 1, b, c = [2 3];": (
        "(VariableDecl int [(Declarator a 1) (Declarator b) (Declarator c (IntervalExpr 2 3))])"
    ),
    "filter Color c;": "(VariableDecl Color [(Declarator c)] is_filter)",
    "float f = [-inff, 2.5];": "(VariableDecl float [(Declarator f (IntervalExpr -4503599627370495.0 2.5))])",
    "int a = [-inf +inf];": "(VariableDecl int [(Declarator a (IntervalExpr -4503599627370495 4503599627370495))])",
    "int a = [1-2];": "(VariableDecl int [(Declarator a (IntervalExpr 1 -2))])",
    "int a = 5L;": "(VariableDecl int [(Declarator a 5)])",
    "float f = 3f;": "(VariableDecl float [(Declarator f 3.0)])",
    "float f = 1.5E-2d;": "(VariableDecl float [(Declarator f 0.015)])",
    "float f = .5;": "(VariableDecl float [(Declarator f 0.5)])",
    "float f = 5.;": "(VariableDecl float [(Declarator f 5.0)])",
    "bool b = {true, x.y};": "(VariableDecl bool [(Declarator b (SetExpr [true x.y]))])",
    'string s = "a\\n\\"b\\\\c";': '(VariableDecl string [(Declarator s "a\\n\\"b\\\\c")])',
    'string s = "two\nlines";': '(VariableDecl string [(Declarator s "two\nlines")])',
    "A a = new A(1, b);": "(VariableDecl A [(Declarator a (NewExpr A [1 b]))])",
    "new A();": "(Allocation (NewExpr A []))",
    "typedef int [0 10] Percent;": "(TypedefDecl int (IntervalExpr 0 10) Percent)",
    "typedef E {a, b} F;": "(TypedefDecl E (SetExpr [a b]) F)",
    "enum E { a, b }": "(EnumDecl E [a b])",
    "a.b = {1, 2};": "(Assignment a.b = (SetExpr [1 2]))",
    "g.state = ACTIVE;": "(Assignment g.state = ACTIVE)",
    "eq(a, 3);": "(CallConstraint eq [a 3])",
    'eq(a, 3) : "why";': '(CallConstraint eq [a 3] "why")',
    "enforce a == 3;": "(ExprConstraint (BinaryExpr == a 3) enforce)",
    'a == 3 : "why";': '(ExprConstraint (BinaryExpr == a 3) "why")',
    "a + b * 2 == c - 1;": "(ExprConstraint (BinaryExpr == (BinaryExpr + a (BinaryExpr * b 2)) (BinaryExpr - c 1)))",
    "x == y - -1;": "(ExprConstraint (BinaryExpr == x (BinaryExpr - y -1)))",
    "a || b && c;": "(ExprConstraint (BinaryExpr || a (BinaryExpr && b c)))",
    "a < b < c;": "(ExprConstraint (BinaryExpr < (BinaryExpr < a b) c))",
    "a == (b == (c));": "(ExprConstraint (BinaryExpr == a (BinaryExpr == b c)))",
    "x == sampledParameter(RATE);": "(ExprConstraint (BinaryExpr == x (CallExpr sampledParameter [RATE])))",
    "a;": "(ExprConstraint a)",
    "close();": "(MethodCall () close [])",
    "C.close();": "(MethodCall C close [])",
    "g.x.specify(3);": "(MethodCall g.x specify [3])",
    "class A;": "(ClassDecl A)",
    "class A extends B { int x; };": "(ClassDecl A B [(VariableDecl int [(Declarator x)])])",
    "class A { A(int x, B b) { super(x); k = b; } }": (
        "(ClassDecl A [(ConstructorDecl A [(FormalParameter int x) (FormalParameter B b)]"
        " [(SuperCall [x]) (Assignment k = b)])])"
    ),
    "class A { predicate p { int x; x <= 3; } action q { } }": (
        "(ClassDecl A [(PredicateDecl p [(VariableDecl int [(Declarator x)])"
        " (ExprConstraint (BinaryExpr <= x 3))]) (PredicateDecl q is_action [])])"
    ),
    "goal(t.p g, T.q);": "(GoalStatement goal [(Instance t.p g) (Instance T.q)])",
    "rejectable(t.p g);": "(GoalStatement rejectable [(Instance t.p g)])",
    "g meets h;": "(Relation g meets [] [] h)",
    "this before g;": "(Relation this before [] [] g)",
    "g contains (t.p a, t.q);": "(Relation g contains [] [(Instance t.p a) (Instance t.q)])",
    "T::p { meets(effect object.q r); any(); starts q; }": (
        "(RuleDecl T p [(Relation meets [] [(Instance effect object.q r)]) (Relation any [] [])"
        " (Relation starts [] [] q)])"
    ),
    "T::p eq(duration, 3);": "(RuleDecl T p [(CallConstraint eq [duration 3])])",
    "T::p { ;; }": "(RuleDecl T p [])",
    "T::p { if (x == 1) y; else if (z) { w; } else ; }": (
        "(RuleDecl T p [(IfStatement (BinaryExpr == x 1) [(ExprConstraint y)]"
        " [(IfStatement z [(ExprConstraint w)] [])])])"
    ),
    "T::p if (a) b; else c;": "(RuleDecl T p [(IfStatement a [(ExprConstraint b)] [(ExprConstraint c)])])",
    "T::p { foreach (x in object.all) { eq(x, y); } }": (
        "(RuleDecl T p [(Foreach x object.all [(CallConstraint eq [x y])])])"
    ),
    '#include "a.nddl"': '(Include "a.nddl")',
    'class A { #include "a.nddl"\n int x; }': (
        '(ClassDecl A [(Include "a.nddl") (VariableDecl int [(Declarator x)])])'
    ),
    "/// A thing.\n///   Indented.\nclass A { /// Not for x.\n  /// Its size.\n  int x; }": (
        "(ClassDecl A [(VariableDecl int [(Declarator x)] Its size.)] A thing.\n  Indented.)"
    ),
    "int\ta\f=\r\n 3\t;\fint  b=4;\n": "(VariableDecl int [(Declarator a 3)])\n(VariableDecl int [(Declarator b 4)])",
    "/* one /* two */ int a = 3; // end\n": "(VariableDecl int [(Declarator a 3)])",
    "int start = 3; int $y = 4; int private = 5;": (
        "(VariableDecl int [(Declarator start 3)])\n(VariableDecl int [(Declarator $y 4)])\n"
        "(VariableDecl int [(Declarator private 5)])"
    ),
    "": "",
    ";;": "",
    "// nothing\n": "",
}

# What only nddlc understands without a complaint.
EXTENSIONS = {
    "int a = 1 + 2;": "(VariableDecl int [(Declarator a (BinaryExpr + 1 2))])",
    "int a = max(b, 2);": "(VariableDecl int [(Declarator a (CallExpr max [b 2]))])",
    "eq(x + 1, y);": "(CallConstraint eq [(BinaryExpr + x 1) y])",
    "A a = new A(x * 2);": "(VariableDecl A [(Declarator a (NewExpr A [(BinaryExpr * x 2)]))])",
    "a = b - 1;": "(Assignment a = (BinaryExpr - b 1))",
    "x == y-1;": "(ExprConstraint (BinaryExpr == x (BinaryExpr - y 1)))",
    "x == y -1;": "(ExprConstraint (BinaryExpr == x (BinaryExpr - y 1)))",
    "x == 5-3;": "(ExprConstraint (BinaryExpr == x (BinaryExpr - 5 3)))",
    "x == y+inf;": "(ExprConstraint (BinaryExpr == x (BinaryExpr + y 4503599627370495)))",
    "f(a -1, -1);": "(CallConstraint f [(BinaryExpr - a 1) -1])",
    "x == -y;": "(ExprConstraint (BinaryExpr == x (UnaryExpr - y)))",
    "x == -(y + 1) * 2;": "(ExprConstraint (BinaryExpr == x (BinaryExpr * (UnaryExpr - (BinaryExpr + y 1)) 2)))",
    "!a && b;": "(ExprConstraint (BinaryExpr && (UnaryExpr ! a) b))",
    "x == a / b;": "(ExprConstraint (BinaryExpr == x (BinaryExpr / a b)))",
    "class A { int x = 3; }": "(ClassDecl A [(VariableDecl int [(Declarator x 3)])])",
    "T::p { before [1 5] (object.q r); }": (
        "(RuleDecl T p [(Relation before [(IntervalExpr 1 5)] [(Instance object.q r)])])"
    ),
    "g contains [0 10] [0 5] h;": "(Relation g contains [(IntervalExpr 0 10) (IntervalExpr 0 5)] [] h)",
    "T::p { any [0 1] [2 3] (); }": "(RuleDecl T p [(Relation any [(IntervalExpr 0 1) (IntervalExpr 2 3)] [])])",
    '#include"a.nddl"': '(Include "a.nddl")',
    "// the end": "",
    "\ufeffint a;": "(VariableDecl int [(Declarator a)])",
    "class T { predicate p { int x;; } }": "(ClassDecl T [(PredicateDecl p [(VariableDecl int [(Declarator x)])])])",
}


@pytest.mark.parametrize("text", PORTABLE)
@pytest.mark.parametrize("dialect", Dialect)
def test_both_dialects_understand(text: str, dialect: Dialect) -> None:
    parsed = parse(Source("t", text + "\n"), dialect)
    assert (outline(parsed.module), parsed.diagnostics) == (PORTABLE[text], ())


@pytest.mark.parametrize("text", EXTENSIONS)
def test_nddlc_understands(text: str) -> None:
    parsed = parse(Source("t", text))
    assert (outline(parsed.module), parsed.diagnostics) == (EXTENSIONS[text], ())


@pytest.mark.parametrize("text", EXTENSIONS)
def test_nddl3_complains_but_sees_the_same_tree(text: str) -> None:
    parsed = parse(Source("t", text), Dialect.NDDL3)
    assert outline(parsed.module) == EXTENSIONS[text]
    assert parsed.diagnostics


# What cannot be understood leaves the rest as it is.
BROKEN = {
    "int a = 1\nint b = 2;": "(VariableDecl int [(Declarator a 1)])\n(VariableDecl int [(Declarator b 2)])",
    "int a = ;\nint b = 2;": "(BrokenStatement)\n(VariableDecl int [(Declarator b 2)])",
    "class A { int x; int = 3; int y; }": (
        "(ClassDecl A [(VariableDecl int [(Declarator x)]) (BrokenStatement) (VariableDecl int [(Declarator y)])])"
    ),
    "class A {\n int x;\n predicate\n int k;\n}": (
        "(ClassDecl A [(VariableDecl int [(Declarator x)]) (BrokenStatement) (VariableDecl int [(Declarator k)])])"
    ),
    "class A {\n int x;\n\nclass B { }": "(ClassDecl A [(VariableDecl int [(Declarator x)])])\n(ClassDecl B [])",
    "T::p { x == 1;": "(RuleDecl T p [(ExprConstraint (BinaryExpr == x 1))])",
    "T::p { x = 3; y == 4; }": "(RuleDecl T p [(BrokenStatement) (ExprConstraint (BinaryExpr == y 4))])",
    "}\nint a;": "(BrokenStatement)\n(VariableDecl int [(Declarator a)])",
    "int before = 3;": "(VariableDecl int [(Declarator before 3)])",
    "T::p { meets object.q r; }": "(RuleDecl T p [(Relation meets [] [(Instance object.q r)])])",
    "T::p { after { A a, B b }; }": "(RuleDecl T p [(Relation after [] [(Instance A a) (Instance B b)])])",
    "class A { private int x; }": "(ClassDecl A [(VariableDecl int [(Declarator x)])])",
    "int a = 0x1F;": "(VariableDecl int [(Declarator a 31)])",
    "string s = 'a';": '(VariableDecl string [(Declarator s "a")])',
    "int a(5);": "(VariableDecl int [(Declarator a 5 call_form)])",
    "a in [1 5];": "(Assignment a in (IntervalExpr 1 5))",
    "int a = 1; /* the rest": "(VariableDecl int [(Declarator a 1)])",
    'string s = "abc;\nint a;': '(VariableDecl string [(Declarator s "abc")])\n(VariableDecl int [(Declarator a)])',
}


@pytest.mark.parametrize("text", BROKEN)
def test_a_mistake_leaves_the_rest(text: str) -> None:
    parsed = parse(Source("t", text))
    assert outline(parsed.module) == BROKEN[text]
    assert len(parsed.diagnostics) == 1


def test_spans_cover_what_they_name() -> None:
    text = "int a;\nT::p { meets(object.q r);\n  x == (a + 1) * y.z; }\n"
    module = parse(Source("t", text)).module
    assert module.statements[1].span.text == text.partition("\n")[2].rstrip()
    nodes = [node for statement in module.statements for node in descendants(statement)]
    named = {type(node).__name__: node.span for node in nodes}
    assert named["Relation"].text == "meets(object.q r);"
    assert named["ExprConstraint"].text == "x == (a + 1) * y.z;"
    assert named["IntLiteral"].text == "1"
    assert (named["PathExpr"].text, named["PathExpr"].line, named["PathExpr"].column) == ("y.z", 3, 18)
    operators = [(node.op_span.text, node.span.text) for node in nodes if isinstance(node, BinaryExpr)]
    assert operators == [("==", "x == (a + 1) * y.z"), ("*", "(a + 1) * y.z"), ("+", "(a + 1)")]


def test_comments_are_at_hand() -> None:
    text = "// one\nint a; /* two */\nclass A { // three\n}\n/// four"
    assert [comment.text for comment in parse(Source("t", text)).comments] == [
        "// one",
        "/* two */",
        "// three",
        "/// four",
    ]
