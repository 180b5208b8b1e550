"""How long the commands take that people wait for at every step: the median wall time from start to end of a process.

What Python remembers of the sources (`__pycache__`, which `make build` fills) is there; all else starts from nothing.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MOST = 350  # milliseconds that `nddlc lint` on a small file must not exceed
ROUNDS = 11
MODEL = """
class Lamp extends Timeline {
    predicate On { int level = [0 10]; }
    predicate Off { }
}
Lamp::On { met_by(object.Off dark); dark.duration <= level; }
Lamp lamp = new Lamp();
close();
goal(lamp.On light);
light.start = 7;
"""
COMMANDS = (["lint"], ["fmt", "--check"], ["rule", "NDDL501"], ["--help"])


def wall(command: list[str]) -> float:
    """Milliseconds that a process takes from start to end."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    begun = time.perf_counter()
    subprocess.run([sys.executable, *command], capture_output=True, check=False, env=environment)
    return (time.perf_counter() - begun) * 1000


def median(command: list[str]) -> float:
    """The median of some rounds after one that does not count."""
    wall(command)
    return statistics.median(wall(command) for _ in range(ROUNDS))


def main() -> None:
    """Print what each command takes, and what of it is Python itself."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "small.nddl"
        path.write_text(MODEL.lstrip(), encoding="utf-8")
        print(f"python alone: {median(['-c', 'pass']):.0f} ms")
        for words in COMMANDS:
            files = [str(path)] if words[0] in ("lint", "fmt") else []
            taken = median(["-m", "nddlc.main", *words, *files])
            limit = f", {taken / MOST:.2f} of {MOST} ms" if words == ["lint"] else ""
            print(f"nddlc {' '.join(words)}: {taken:.0f} ms{limit}")


if __name__ == "__main__":
    main()
