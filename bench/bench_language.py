"""How fast the language answers: a full check from cold in process, its growth, and a keystroke."""

import gc
import statistics
import time

from lsprotocol.types import Position, Range

from lsp.documents import Documents
from nddl_lang.analysis import analyse_text
from nddl_lang.lint.linter import lint

SIZES = (1000, 5000, 20000)
CHECK, KEYSTROKE = 300, 20  # milliseconds that must not be exceeded
ROUNDS = 100
UNIT = """
/// Timeline {0}.
enum Mode{0} {{ slow{0}, fast{0} }}
class Unit{0} extends Timeline {{
  int most;
  predicate Idle {{ }}
  predicate Busy {{ int load = [0 9]; float share; Mode{0} mode; }}
  Unit{0}(int m) {{ most = m; }}
}}
float RATE{0} = [0.1 4.0];
Unit{0}::Busy {{
  float rate;
  rate == sampledParameter(RATE{0});
  meets(Idle later);
  met_by(Idle ahead);
  ahead before later;
  rate * 2.0 == share;
  load <= object.most;
  duration >= 3;
  if (mode == fast{0}) {{
    contains(Idle part);
    part.duration <= 2;
  }} else {{
    if (load > 3) {{ leq(load, duration); }}
  }}
}}
Unit{0}::Idle {{ duration >= 1; }}
Unit{0} unit{0} = new Unit{0}(5);
goal(unit{0}.Busy goal{0});
goal{0}.start = [0 90];
"""


def model(lines: int) -> str:
    """A model of about so many lines."""
    return "".join(UNIT.format(number) for number in range(lines // UNIT.count("\n"))) + "close();\n"


def check(text: str) -> float:
    """Milliseconds of processor time for parse, semantics and all lints, without a search for garbage: so does lint."""
    gc.collect()
    gc.disable()
    begun = time.process_time()
    lint(analyse_text("model.nddl", text))
    taken = (time.process_time() - begun) * 1000
    gc.enable()
    return taken


def keystrokes(text: str) -> list[float]:
    """Milliseconds of processor time from a keystroke in a rule to new complaints."""
    documents, uri = Documents(), "untitled:model"
    documents.open(uri, 1, text)
    view = documents.view(uri)
    assert view is not None
    place = view.document.lines.position(text.index("duration >= 3") + len("duration >= 3"))
    typed, gone = Range(place, place), Range(place, Position(place.line, place.character + 1))
    times = []
    for version in range(2, ROUNDS + 2):
        edit = (typed, "7") if version % 2 == 0 else (gone, "")
        begun = time.process_time()
        documents.change(uri, version, [edit])
        times.append((time.process_time() - begun) * 1000)
    return times


def main() -> None:
    """Print what each takes, beside what it may take."""
    assert not analyse_text("model.nddl", model(100)).has_errors, "a model with errors is not linted"
    check(model(100))  # the tables of the parser are read once in a process
    costs = {}
    for lines in SIZES:
        text = model(lines)
        costs[lines] = min(check(text) for _ in range(3))
        count = text.count("\n")
        print(f"check of {count} lines: {costs[lines]:.0f} ms, {costs[lines] / count * 1000:.0f} µs per line")
    print(f"1000 lines: {costs[SIZES[0]] / CHECK:.2f} of the {CHECK} ms that it may take")
    growth = costs[SIZES[-1]] / costs[SIZES[0]] / (SIZES[-1] / SIZES[0])
    print(f"growth from {SIZES[0]} to {SIZES[-1]} lines: {growth:.2f} times what is linear")
    times = keystrokes(model(1000))
    median = statistics.median(times)
    print(f"keystroke in 1000 lines: median {median:.1f} ms, {median / KEYSTROKE:.2f} of {KEYSTROKE} ms")


if __name__ == "__main__":
    main()
