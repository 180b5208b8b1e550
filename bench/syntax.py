"""What it costs to parse and to format 1000 and 20,000 lines, and to parse again after each keystroke."""

import statistics
import time

from nddl_lang.formatter.format import format_text
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import parse
from nddl_lang.text.source import Source

ROUNDS = 100
UNIT = """
/// Timeline {0}.
class Unit{0} extends Timeline {{
    predicate Idle {{ int since; }}
    predicate Busy {{ int load; float share; }}  // what it carries
    Unit{0}(int limit) {{ load = limit; }}
}}
Unit{0} unit{0} = new Unit{0}(3);
Unit{0}::Busy {{
    float rate = [0.0 4.0]; float used;
    meets(object.Idle idle);
    rate * 2.0 + used == share - 0.5;
    eq(idle.since, load);
    if (load > 3 && used <= 2.5) {{
        leq(load, duration);
        met_by(object.Idle before_it, Unit{0}.Busy other);
    }} else {{
        starts_after(object.Busy next);
    }}
}}
"""


def model(lines: int) -> str:
    """A model of so many lines."""
    return "".join(UNIT.format(number) for number in range(lines // UNIT.count("\n")))


def cost(action: object, *arguments: object) -> float:
    """Milliseconds of processor time that calling `action` takes."""
    assert callable(action)
    start = time.process_time()
    action(*arguments)
    return (time.process_time() - start) * 1000


def main() -> None:
    """Print the figures."""
    for lines in (1000, 20_000):
        text = model(lines)
        rounds = 5 if lines > 1000 else 15
        parsing = statistics.median(cost(parse, Source("bench", text)) for _ in range(rounds))
        formatting = statistics.median(cost(format_text, text) for _ in range(rounds))
        incremental = Incremental("bench")
        incremental.update(text)
        at = text.index("load,", len(text) // 2)
        edits = [cost(incremental.update, text[:at] + "x" * number + text[at:]) for number in range(ROUNDS)]
        edit = statistics.median(edits)
        print(f"{lines:6} lines: parse {parsing:7.1f} ms   format {formatting:7.1f} ms   keystroke {edit:5.2f} ms")


if __name__ == "__main__":
    main()
