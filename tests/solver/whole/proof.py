"""Judge nddlc on random whole models: `make plan-proof`, the tests with many more examples.

python -m tests.solver.whole.proof [COUNT [FIRST]]    COUNT models (20,000) from seed FIRST on (0)

z3 says of each model whether it has a plan; both strategies must say the same within their steps. Each plan is judged
by the model alone. Exits with 1 if anything differs.
"""

import sys
import tempfile
from pathlib import Path

from runtime.build_form import build_form
from tests.constraints.proof import judged
from tests.solver.whole.judging import Tally, judge_model


def main() -> None:
    """Judge all and exit with 1 if anything differs."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    print(f"engine: {build_form()}")
    tally = Tally()
    with tempfile.TemporaryDirectory() as folder:
        wrong = judged("whole models", count, lambda seed: judge_model(Path(folder), first + seed, tally))
    print(
        f"  {tally.plans} plans of {tally.tokens} active tokens, {tally.exhausted} times none, both strategies counted"
    )
    print(f"  {tally.timeouts} searches stopped after many steps, {tally.too_large} models too large to lay out")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
