"""Say every few seconds that something is still under way: `python ticking.py TITLE COMMAND...`."""

import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

EVERY = 4.0  # seconds from one line to the next


def nothing_more() -> str:
    """There is no more to say than how long it takes."""
    return ""


@contextmanager
def ticking(title: str, how_far: Callable[[], str] = nothing_more) -> Iterator[None]:
    """Print a line now and then while what is inside lasts; `how_far` says how far it has come."""
    begun = time.monotonic()
    over = threading.Event()

    def tick() -> None:
        while not over.wait(EVERY):
            print(f"  {title}: {how_far()}{time.monotonic() - begun:.0f} s", file=sys.stderr, flush=True)

    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


def main() -> int:
    """Run a command; its exit code."""
    title, *command = sys.argv[1:]
    with ticking(title), subprocess.Popen(command) as process:
        return process.wait()


if __name__ == "__main__":
    sys.exit(main())
