"""Compile the engine: `.py` files with a `.pxd` beside them in, extension modules out, or one warning and none."""

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

from setuptools import Extension
from setuptools.command.build_ext import build_ext

from freshness import SHARED, engine_modules

# No fused multiply-add: a plan must not depend on the processor.
COMPILE_FLAGS = ["/O2", "/fp:precise"] if sys.platform == "win32" else ["-O2", "-g0", "-ffp-contract=off"]

PROBE = "#include <stdlib.h>\n#include <math.h>\nint probe(void) { return abs(-1); }\n"


def is_set(variable: str) -> bool:
    """Tell whether an environment variable says yes."""
    return os.environ.get(variable, "") not in ("", "0")


def obstacle() -> str | None:
    """Say why nothing can be compiled here, if so."""
    if is_set("NDDLC_NO_COMPILE"):
        return "NDDLC_NO_COMPILE is set"
    if not Path(sysconfig.get_path("include"), "Python.h").exists():
        return "this Python comes without its header files (Python.h; Debian has them in `python3-dev`)"
    if machine_compiler() is None and zig_compiler() is None:
        return "there is no working C compiler, and the package `ziglang` is not installed"
    return None


def machine_compiler() -> list[str] | None:
    """Find a C compiler that works: the one that CC names, else the first of the usual names."""
    if sys.platform == "win32":
        return ["cl"]  # setuptools finds it by the registry, not by the path
    named = shlex.split(os.environ.get("CC", ""))
    candidates = [named] if named else [["cc"], ["gcc"], ["clang"]]
    return next((command for command in candidates if compiles(command)), None)


def compiles(command: list[str]) -> bool:
    """Tell whether `command` makes a library of a few lines of C; a compiler without C's own headers does not."""
    if shutil.which(command[0]) is None:
        return False
    with tempfile.TemporaryDirectory() as folder:
        probe = Path(folder, "probe.c")
        probe.write_text(PROBE, encoding="ascii")
        arguments = ["-shared", "-fPIC", "-o", str(probe.with_suffix(".so")), str(probe)]
        return subprocess.run([*command, *arguments], capture_output=True, check=False).returncode == 0


def zig_compiler() -> list[str] | None:
    """Find the C compiler that `ziglang` from PyPI brings; it shall compile for any processor, as others do."""
    if importlib.util.find_spec("ziglang") is None:
        return None
    return [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline"]


def engine_extensions(root: Path) -> list[Extension]:
    """Make an extension of each engine module and of what they share; none if asked: that wheel fits everywhere."""
    if is_set("NDDLC_NO_COMPILE"):
        return []
    sources = {name: [name.replace(".", "/") + ".py"] for name in engine_modules(root)}
    return [Extension(name, files, extra_compile_args=COMPILE_FLAGS) for name, files in {**sources, SHARED: []}.items()]


class BuildEngine(build_ext):
    """`build_ext` that translates by Cython and compiles all of the engine or, with one warning, none of it."""

    def run(self) -> None:
        """Build the extension modules, or drop them where this machine cannot and nobody insists."""
        try:
            reason = obstacle()
            if reason is not None:
                raise RuntimeError(reason)
            self.translate()
            super().run()
        except Exception as failure:  # the compilers' failures have no common class
            if is_set("NDDLC_REQUIRE_COMPILED"):
                raise
            # Compiled modules read each other's layout, so a part of them is worse than none.
            for extension in self.extensions:
                Path(self.get_ext_fullpath(extension.name)).unlink(missing_ok=True)
            self.extensions = []
            warn(str(failure))

    def translate(self) -> None:
        """Replace each extension's Python source by the C file that Cython makes of it."""
        folder = Path(self.build_temp, "c")
        script = Path(__file__).with_name("translate.py")
        sources = [path for extension in self.extensions for path in extension.sources]
        # In a process of its own: Cython is not there yet when the backend is asked what it needs.
        subprocess.run([sys.executable, str(script), str(folder), *sources], check=True)
        for extension in self.extensions:
            extension.sources = [str(folder / f"{extension.name.replace('.', '/')}.c")]

    def build_extensions(self) -> None:
        """Compile with the machine's compiler, else with zig's."""
        if machine_compiler() is None:
            zig = zig_compiler()
            assert zig is not None, "obstacle() has looked for it"
            # Nothing of what this Python was built with is passed on: zig refuses some compilers' and linkers' flags.
            self.compiler.set_executables(
                compiler=zig,
                compiler_so=[*zig, "-fPIC", "-fwrapv", "-DNDEBUG", "-fno-sanitize=undefined"],
                linker_so=[*zig, "-shared", *(["-undefined", "dynamic_lookup"] if sys.platform == "darwin" else [])],
            )
        super().build_extensions()


def warn(reason: str) -> None:
    """Say that the engine is not compiled, and why."""
    print(f"warning: the engine of nddlc is not compiled and will run many times slower: {reason}", file=sys.stderr)
