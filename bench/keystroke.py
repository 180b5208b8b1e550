"""How long after a keystroke an editor hears what is wrong: processor time of the server, on a 1000-line model."""

import statistics
import time

from lsprotocol.types import Position, Range

from lsp.documents import Documents
from lsp.hover import hover_at

LINES = 1000
ROUNDS = 200
UNIT = """
/// Timeline {0}.
class Unit{0} extends Timeline {{
  predicate Idle {{ }}
  predicate Busy {{ int load; float share; }}
}}
Unit{0} unit{0} = new Unit{0}();
Unit{0}::Busy {{
  float rate = [0.0 4.0];
  meets(Idle idle);
  rate * 2.0 == share;
  duration >= 3;
  if (load > 3) {{
    leq(load, duration);
    met_by(object.Idle before_it);
  }}
}}
"""


def model() -> str:
    """A model of so many lines, in which a rule near the top is about to be edited."""
    return "".join(UNIT.format(number) for number in range(LINES // UNIT.count("\n")))


def main() -> None:
    """Type into a rule, into a declaration that others use, and into a comment; print what each keystroke costs."""
    text = model()
    uri = "untitled:model"
    documents = Documents()
    begun = time.process_time()
    documents.open(uri, 1, text)
    print(f"open {text.count(chr(10))} lines: {(time.process_time() - begun) * 1000:.0f} ms")
    view = documents.view(uri)
    assert view is not None
    lines = view.document.lines
    for what, mark in (
        ("a rule", "duration >= 3"),
        ("the name of a class", "Unit0 extends"),
        ("a comment", "Timeline 0"),
        ("an opening brace", "Busy {\n  float"),
    ):
        at = text.index(mark) + (6 if what.endswith("brace") else 1)
        place = lines.position(at)
        typed, gone = Range(place, place), Range(place, Position(place.line, place.character + 1))
        letter = "{" if what.endswith("brace") else "x"
        times = []
        for version in range(2, ROUNDS + 2):
            edit = (typed, letter) if version % 2 == 0 else (gone, "")
            begun = time.process_time()
            documents.change(uri, version, [edit])
            times.append((time.process_time() - begun) * 1000)
        print(f"keystroke in {what}: median {statistics.median(times):.1f} ms, worst {max(times):.1f} ms")
    begun = time.process_time()
    for number in range(0, len(text), len(text) // ROUNDS):
        view = documents.view(uri)
        assert view is not None
        hover_at(view, lines.position(number), documents.conversion())
    print(f"hover: {(time.process_time() - begun) * 1000 / ROUNDS:.2f} ms")


if __name__ == "__main__":
    main()
