"""Bring the engine's binaries beside its sources up to date with what the sources say, whatever the clocks say."""

import fcntl
import json
import os
import sys
import time
from pathlib import Path

from setuptools import Distribution

from engine_build import BuildEngine, engine_extensions, is_set, obstacle, warn
from freshness import (
    SUFFIX,
    binary,
    binary_digest,
    compiled_modules,
    orphaned_binaries,
    source_digests,
    stale_modules,
    stamp,
)
from ticking import ticking

ROOT = Path(__file__).resolve().parent.parent


def bring_up_to_date(root: Path) -> list[str]:
    """Rebuild the stale binaries, all or none of them, and remove the orphans; name the modules rebuilt."""
    for path in orphaned_binaries(root):
        path.unlink()
    stale = stale_modules(root)
    if stale:
        digests = source_digests(root)  # before the build: who edits meanwhile is built again next time
        compile_modules(root, stale)
        record = {module: [digest, binary_digest(root, module)] for module, digest in digests.items()}
        write_whole(stamp(root), json.dumps(record, indent=1))
    return stale


def compile_modules(root: Path, modules: list[str]) -> None:
    """Compile `modules` aside, and move the binaries beside their sources once all are there."""
    aside = root / "build" / f"lib{SUFFIX}"
    extensions = [extension for extension in engine_extensions(root) if extension.name in modules]
    command = BuildEngine(Distribution({"name": "nddlc", "ext_modules": extensions}))
    command.build_lib, command.build_temp = str(aside), str(root / "build" / "temp")
    command.force, command.parallel = True, 2
    command.ensure_finalized()
    begun = time.time()

    def how_far() -> str:
        done = sum(is_made(binary(aside, module), begun) for module in modules)
        return f"{done} of {len(modules)} modules, "

    with ticking("compiling the engine", how_far):
        command.run()
    for module in modules:
        binary(aside, module).replace(binary(root, module))


def is_made(path: Path, begun: float) -> bool:
    """Whether a file was written after a time."""
    return path.exists() and path.stat().st_mtime >= begun - 1.0


def write_whole(path: Path, text: str) -> None:
    """Write a file so that nobody ever reads the half of it."""
    beside = path.with_suffix(".new")
    beside.write_text(text, encoding="ascii")
    beside.replace(path)


def leave_uncompiled(root: Path) -> None:
    """Remove all binaries: some of them beside sources that have changed are worse than none."""
    for path in (*orphaned_binaries(root), *(binary(root, module) for module in compiled_modules(root))):
        path.unlink(missing_ok=True)
    stamp(root).unlink(missing_ok=True)


def main() -> None:
    """Build in the checkout; where nothing can be compiled, warn and go on, unless a compiled engine is required."""
    Path("build").mkdir(exist_ok=True)
    with Path("build", "lock").open("w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        reason = obstacle()
        if reason is not None and not is_set("NDDLC_REQUIRE_COMPILED"):
            leave_uncompiled(ROOT)
            warn(reason)
            return
        # With a compiler at hand a failure is a mistake in the engine, and must not pass for an uncompiled one.
        os.environ["NDDLC_REQUIRE_COMPILED"] = "1"
        for module in bring_up_to_date(ROOT):
            print(f"compiled {module}")


if __name__ == "__main__":
    os.chdir(ROOT)
    main()
    sys.stdout.flush()
