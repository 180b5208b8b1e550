"""Dynamic controllability of plans by size: `python bench/bench_controllability.py`. Goal: 200 tokens in 0.1 s."""

import time

from checker.controllability.dynamic import offending_cycle
from checker.controllability.network import ContingentLink, UncertainNetwork

_SIZES = (50, 100, 200, 400)
_TIMELINES = 4


def plan(tokens: int) -> UncertainNetwork:
    """Tokens on four timelines, every second one of the vehicle, each soon after the one before it."""
    network = UncertainNetwork(2 * tokens + 1)
    for number in range(tokens):
        start, end = 1 + 2 * number, 2 + 2 * number
        network.between(0, start, 0, None, number)
        if number % 2:
            network.links.append(ContingentLink(start, end, 10, 20, number))
        else:
            network.between(start, end, 5, 100, number)
        if number >= _TIMELINES:
            network.between(end - 2 * _TIMELINES, start, 0, None, number)
        if number:
            network.between(end - 2, start, 0, 400, number)
    return network


def _main() -> None:
    for size in _SIZES:
        network = plan(size)
        best = 1e9
        for _ in range(3):
            before = time.process_time()
            answer = offending_cycle(network) is None
            best = min(best, time.process_time() - before)
        print(f"{size:4} tokens: {best * 1000:8.1f} ms, {'controllable' if answer else 'not controllable'}")


if __name__ == "__main__":
    _main()
