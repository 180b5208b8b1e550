"""What the rule of a model leaves loose does not hang on how it is laid out."""

import pytest

from checker.counterfactual.links import Links
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text

DECLARED = """#include "TREX.nddl"
float RATE = [0.5 2.0];
class Modem extends AgentTimeline {
  predicate Off { } predicate Send { float size; } Modem(Mode m) { super(m, "Off"); }
}
"""
WHOLE = "float r; r == sampledParameter(RATE); duration == ceil(size / r);"
GUARDED = "float r; if (r > 1.0) { duration == ceil(size / r); }"
LACKING = "float r; r == sampledParameter(RATE); duration == ceil(size);"


def loose(rule: str) -> list[str]:
    text = f"{DECLARED}Modem::Send {{ {rule} }}\nModem modem = new Modem(Internal);\nclose();\n"
    program = compile_model(analyse_text("modem.nddl", text))
    return [name for _, name, _, _ in Links(0, program).loose(program.rules[0], ("rule", 0, 0))]


@pytest.mark.parametrize("end", [" ", "\n"])
@pytest.mark.parametrize(("rule", "found"), [(WHOLE, []), (GUARDED, []), (LACKING, ["r"])])
def test_statements_count_not_lines(rule: str, found: list[str], end: str) -> None:
    assert loose(rule.replace("; ", f";{end}")) == found
    assert loose(rule.replace(" == ", f" =={end}")) == found
