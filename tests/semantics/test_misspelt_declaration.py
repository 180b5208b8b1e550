"""A name that is misspelt where it is declared is one message there, not one at each place that uses it."""

from pathlib import Path

import pytest

from nddl_lang.analysis import analyse_file, analyse_text

MODEL = """\
enum Mode2 { slow, quick }
int LIMIT = 3;
class Arm extends Timeline {
    float reach;
    predicate Grab { float force; Mode2 pace; }
    predicate Wait { Mode2 pace; }
    Arm(float r) { reach = r; }
}
Arm::Grab {
    force <= LIMIT;
    force <= object.reach;
    met_by(object.Wait w);
    pace == quick;
}
Arm::Wait { duration <= LIMIT; starts(object.Grab g); g.force <= object.reach; g.pace == quick; }
Arm left = new Arm(2.0);
Arm right = new Arm(3.0);
close();
goal(left.Wait one);
one.start == 3;
right.reach <= 4.0;
left.reach <= 4.0;
Mode2 first = quick;
"""


@pytest.mark.parametrize(
    ("declared", "misspelt", "used"),
    [
        ("int LIMIT", "int LIMTI", "LIMIT"),
        ("class Arm ", "class Amr ", "Arm"),
        ("predicate Wait", "predicate Wiat", "Wait"),
        ("float force", "float froce", "force"),
        ("float reach", "float raech", "reach"),
        ("Arm left ", "Arm lfet ", "left"),
        ("enum Mode2", "enum Moed2", "Mode2"),
        ("slow, quick", "slow, qucik", "quick"),
    ],
)
def test_one_message_at_the_declaration(declared: str, misspelt: str, used: str) -> None:
    assert not analyse_text("arm.nddl", MODEL).diagnostics
    text = MODEL.replace(declared, misspelt, 1)
    (only,) = analyse_text("arm.nddl", text).diagnostics
    assert only.code.id == "NDDL237"
    assert only.span.line == text[: text.index(misspelt)].count("\n") + 1
    (edit,) = only.fixes[0].edits
    assert (edit.text, only.fixes[0].safe) == (used, False)
    assert text[: edit.span.begin] + edit.text + text[edit.span.finish :] == MODEL


def test_a_use_that_stands_alone_is_told_itself() -> None:
    text = "int LIMIT = 3;\nint most = LIMTI;\n"
    (only,) = analyse_text("arm.nddl", text).diagnostics
    assert (only.code.id, only.span.line) == ("NDDL201", 2)


def test_uses_are_told_where_the_declared_name_is_used_too() -> None:
    text = "int LIMIT = 3;\nint a = LIMTI;\nint b = LIMTI;\nint c = LIMIT;\n"
    assert [each.span.line for each in analyse_text("arm.nddl", text).diagnostics] == [2, 3]


def test_a_name_in_a_comment_is_no_use() -> None:
    text = "int LIMTI = 3;  // LIMTI\n/* LIMTI */\nint a = LIMIT;\nint b = LIMIT;\n"
    (only,) = analyse_text("arm.nddl", text).diagnostics
    assert (only.code.id, only.span.line) == ("NDDL237", 1)


def test_what_another_file_declares_is_not_blamed(tmp_path: Path) -> None:
    (tmp_path / "types.nddl").write_text("int LIMIT = 3;\n")
    (tmp_path / "main.nddl").write_text('#include "types.nddl"\nint a = LIMTI;\nint b = LIMTI;\n')
    assert [each.span.line for each in analyse_file(tmp_path / "main.nddl").diagnostics] == [2, 3]


def test_a_built_in_name_that_stands_once_is_no_declaration() -> None:
    text = "class A extends Timelien { }\nclass B extends Timelien { }\nclass C extends Timeline { }\n"
    assert {each.code.id for each in analyse_text("arm.nddl", text).diagnostics} == {"NDDL213"}


def test_who_is_helped_otherwise_is_not_told_again() -> None:
    text = (
        "class Arm extends Timeline {\n    predicate Grab { int teets; }\n    predicate Push { int teats; }\n"
        "    predicate Lift { }\n    predicate Rest { }\n}\n"
        "Arm::Lift { meets(object.Grab g); met_by(object.Push p); g.teats == 3; p.teats == 4; }\n"
        "Arm::Rest { meets(object.Grab g); g.teats == 5; }\nArm::Grab { teats <= 7; }\n"
    )
    (one,) = analyse_text("model.nddl", text).diagnostics
    assert one.code.id == "NDDL237" and one.span.line == 2
