"""Choose, before any test imports the engine, in which form it is tested, and make chance reproducible."""

import gc
import os
import signal
from pathlib import Path

import pytest
from hypothesis import settings

from runtime.build_form import build_form, interpreting_is_asked, load_interpreted
from freshness import unfit_binaries

# Who is started in the background ignores Ctrl-C and hands that on: tests that send it would wait for ever.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Outcomes and schemas are many objects and no cycles, so garbage is looked for seldom.
gc.set_threshold(50_000, 20, 100)

# What is printed is as wide as the terminal; pytest-xdist hands on how wide that of the tests is.
os.environ.pop("COLUMNS", None)

COMPILED_IS_PROMISED = os.environ.get("NDDLC_REQUIRE_COMPILED", "") not in ("", "0") and not interpreting_is_asked()
# A binary that is older than its source is never tested; the source is, uncompiled.
STALE = [] if interpreting_is_asked() else unfit_binaries(Path(__file__).resolve().parent.parent)
if STALE:
    os.environ["NDDLC_INTERPRETED"] = "1"
    load_interpreted()

settings.register_profile("nddlc", derandomize=True, deadline=None)
settings.register_profile("fuzz", deadline=None, max_examples=2000)
settings.load_profile("nddlc")


def pytest_report_header() -> str:
    """Say which form of the engine is tested."""
    reason = f", as {STALE[0].name} is older than its source (`make build`)" if STALE else ""
    return f"engine: {build_form()}{reason}"


def pytest_sessionstart() -> None:
    """Refuse to test another form than the one that is promised."""
    if COMPILED_IS_PROMISED and build_form() != "compiled":
        pytest.exit("NDDLC_REQUIRE_COMPILED is set, and the engine is not compiled", returncode=3)
