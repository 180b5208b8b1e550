"""Compiled and interpreted, the executive does the same, also where missions fail, are repaired or cannot begin."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COUNT = 60


def printed(form: str) -> list[str]:
    """What the mutants do in one form of the engine."""
    command = [sys.executable, "-m", "tests.executive.mutants", "0", str(COUNT)]
    done = subprocess.run(
        command, cwd=ROOT, env=os.environ | {"NDDLC_INTERPRETED": form}, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()


@pytest.mark.slow
def test_mutants_fly_alike_in_both_forms() -> None:
    compiled, interpreted = printed(""), printed("1")
    assert len(compiled) == COUNT
    assert compiled == interpreted
    assert {line.split()[2] for line in compiled} >= {"ended", "F1"}
