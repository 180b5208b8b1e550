"""The page of the code about choices."""

from compiler.determined.codes import CHOICE_LEFT
from nddl_lang.text.page import RulePage

_HEAD = '#include "TREX.nddl"\nclass Arm extends AgentTimeline {\n  predicate Rest { }\n  predicate Act { int n; }\n'
_HEAD += '  Arm(Mode m) { super(m, "Rest"); }\n}\n'
_TAIL = "Arm arm = new Arm(Internal);\nclose();\n"

DETERMINED_PAGES = (
    RulePage(
        CHOICE_LEFT,
        "The model leaves a choice here, or says something for which there is no register code.",
        "A simulator each of whose tokens follows from the last one, from what it is asked for and from what it draws "
        "is compiled, and flies a thousand times faster. Any choice makes the general engine plan it, with the same "
        "result. `nddlc compile --explain` lists all that is in the way.",
        _HEAD + "Arm::Act { int k; n < k; duration == k; }\n" + _TAIL,
        _HEAD + "Arm::Act { int k; k == n + 1; duration == k; }\n" + _TAIL,
    ),
)
