"""What is written as other languages write it has a fix, after which it is NDDL."""

import pytest

from nddl_lang.analysis import analyse_text
from nddl_lang.text.diagnostic import Fix, Severity

BEFORE = "class C extends Timeline { predicate p { int x; } predicate q { } }\nC c = new C();\n"
AFTER = "goal(c.p one);\n"


def applied(text: str, fix: Fix) -> str:
    for edit in sorted(fix.edits, key=lambda edit: edit.span.begin, reverse=True):
        text = text[: edit.span.begin] + edit.text + text[edit.span.finish :]
    return text


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("class D : C { }", "class D extends C { }"),
        ("class D:C { }", "class D extends C { }"),
        ("class D extends C { predicate r(int a, float b); }", "class D extends C { predicate r { int a; float b; } }"),
        ("class D extends C { predicate r(int a) }", "class D extends C { predicate r { int a; } }"),
        ("class D extends C { predicate r(int a) { } }", "class D extends C { predicate r { int a; } }"),
        ("class D extends C { predicate r() { } }", "class D extends C { predicate r { } }"),
        ("class D extends C { predicate r() { int a; } }", "class D extends C { predicate r { int a; } }"),
        ("class D extends C { predicate r; }", "class D extends C { predicate r { } }"),
        ("C.p { duration >= 1; }", "C::p { duration >= 1; }"),
        ("C:p { duration >= 1; }", "C::p { duration >= 1; }"),
        ("rule C::p { duration >= 1; }", "C::p { duration >= 1; }"),
        ("C::p { met_by(C::q before_it); }", "C::p { met_by(C.q before_it); }"),
        ("C::p { met_by(object.q it); it->duration >= 1; }", "C::p { met_by(object.q it); it.duration >= 1; }"),
        ("C::p { duration >= 1;", "C::p { duration >= 1; }"),
        ("C::p {\n  duration >= 1;", "C::p {\n  duration >= 1;\n}"),
        (
            "class D extends C {\n  predicate r { int a;\n  predicate s { }\n}",
            "class D extends C {\n  predicate r { int a; }\n  predicate s { }\n}",
        ),
        ("C d = new C;", "C d = new C();"),
        ("C d = C();", "C d = new C();"),
        ("goal C.p two;", "goal(C.p two);"),
        ("goal(C::p two);", "goal(C.p two);"),
        ("# a remark", "// a remark"),
        ("#include <Plasma.nddl>", '#include "Plasma.nddl"'),
        ('import "Plasma.nddl"', '#include "Plasma.nddl"'),
        ('include "Plasma.nddl"', '#include "Plasma.nddl"'),
        ('#include "Plasma"', '#include "Plasma.nddl"'),
        ("class D extends Timeline { predicate r { } } D::r { met_by(p it); }", None),
    ],
)
def test_what_was_meant_is_offered(written: str, meant: str | None) -> None:
    text = f"{BEFORE}{written}\n{AFTER}"
    meant = meant if meant is not None else written.replace("(p it)", "(C.p it)")
    errors = [each for each in analyse_text("a.nddl", text).diagnostics if each.severity is Severity.ERROR]
    fixes = [fix for each in errors for fix in each.fixes]
    assert len(errors) == 1, [each.message for each in errors]
    results = [applied(text, fix) for fix in fixes]
    assert f"{BEFORE}{meant}\n{AFTER}" == results[0]
    assert [each.message for each in analyse_text("a.nddl", results[0]).diagnostics] == []


@pytest.mark.parametrize(
    "written",
    ["class D extends C { predicate r(int a) { int b; } }", "C::p { ; } }", "goal C.p(two);", "C d = new;", "C.p one;"],
)
def test_what_is_not_plain_is_left_to_the_author(written: str) -> None:
    text = f"{BEFORE}{written}\n{AFTER}"
    for each in analyse_text("a.nddl", text).diagnostics:
        for fix in each.fixes:
            left = analyse_text("a.nddl", applied(text, fix)).diagnostics
            assert len(left) <= len(analyse_text("a.nddl", text).diagnostics), (written, fix.title)
