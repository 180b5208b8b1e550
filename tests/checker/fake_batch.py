"""A batch as a process of its own, with the stand-in for the agent: `python -m tests.checker.fake_batch LOAD ...`."""

import sys
from pkgutil import resolve_name

from nddlc.deferral import defer_large
from nddlc.main import run
from tests.checker import fake_agent

if __name__ == "__main__":
    load = getattr(fake_agent, sys.argv[1])
    defer_large()
    setattr(resolve_name("nddlc.check"), "pinned", lambda models: load)  # noqa: B010 mypy knows what a module exports
    sys.exit(run(["check", *sys.argv[2:]]))
