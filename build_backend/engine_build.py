"""Compile the engine: `.py` files with a `.pxd` beside them in, extension modules out, or one warning and none."""

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension
from setuptools.command.build_ext import build_ext

# The `.pxd` alone gives the C types: annotations stay ordinary Python, and the same file runs uncompiled.
DIRECTIVES = {
    "language_level": 3,
    "annotation_typing": False,
    "infer_types": False,
    "boundscheck": True,
    "wraparound": False,
    "initializedcheck": False,
    "cdivision": True,
}
# No fused multiply-add: a plan must not depend on the processor.
COMPILE_FLAGS = ["-O3", "-ffp-contract=off"]

PROBE = "#include <stdlib.h>\n#include <math.h>\nint probe(void) { return abs(-1); }\n"


def compiling_is_refused() -> bool:
    """Tell whether the user asked for an uncompiled engine."""
    return os.environ.get("NDDLC_NO_COMPILE", "") not in ("", "0")


def compiling_is_required() -> bool:
    """Tell whether an uncompiled engine counts as a failed build, as it does in continuous integration."""
    return os.environ.get("NDDLC_REQUIRE_COMPILED", "") not in ("", "0")


def engine_modules(root: Path) -> list[str]:
    """Name the modules that are compiled: those in `runtime` that have a `.pxd`."""
    declared = sorted((root / "runtime").rglob("*.pxd"))
    return [".".join(path.relative_to(root).with_suffix("").parts) for path in declared if path.name != "__init__.pxd"]


def engine_extensions(root: Path) -> list[Extension]:
    """Make one optional extension of each engine module."""
    if compiling_is_refused():
        return []
    return [
        Extension(name, [name.replace(".", "/") + ".py"], extra_compile_args=compile_flags())
        for name in engine_modules(root)
    ]


def compile_flags() -> list[str]:
    """Choose the flags that the compiler of this platform understands."""
    return ["/O2", "/fp:precise"] if sys.platform == "win32" else COMPILE_FLAGS


def machine_compiler() -> list[str] | None:
    """Find a C compiler that works: the one `CC` names, else the first of the usual names; None where there is none."""
    if sys.platform == "win32":
        return ["cl"]  # setuptools finds it by the registry, not by the path
    named = shlex.split(os.environ.get("CC", ""))
    candidates = [named] if named else [["cc"], ["gcc"], ["clang"]]
    return next((command for command in candidates if compiles(command)), None)


def compiles(command: list[str]) -> bool:
    """Tell whether `command` makes a shared library of a few lines of C; a compiler without C's headers does not."""
    if shutil.which(command[0]) is None:
        return False
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "probe.c")
        source.write_text(PROBE, encoding="ascii")
        arguments = ["-shared", "-fPIC", "-o", str(source.with_suffix(".so")), str(source)]
        return subprocess.run([*command, *arguments], capture_output=True, check=False).returncode == 0


def zig_compiler() -> list[str] | None:
    """Find the C compiler that `ziglang` from PyPI brings; it is asked for a processor like any other's."""
    if importlib.util.find_spec("ziglang") is None:
        return None
    return [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline"]


class BuildEngine(build_ext):
    """`build_ext` that translates by Cython and compiles all of the engine or, with one warning, none of it."""

    def run(self) -> None:
        """Build the extension modules, or drop them where this machine cannot."""
        if not self.extensions:
            if compiling_is_refused():
                warn("NDDLC_NO_COMPILE is set")
            return
        translate(self.extensions, Path(self.build_temp), force=bool(self.force))
        try:
            super().run()
        except Exception as reason:  # the compilers' failures have no common class
            if compiling_is_required():
                raise
            # Compiled modules read each other's layout, so a part of them is worse than none.
            for extension in self.extensions:
                Path(self.get_ext_fullpath(extension.name)).unlink(missing_ok=True)
                Path(self.build_lib, self.get_ext_filename(extension.name)).unlink(missing_ok=True)
            self.extensions = self.distribution.ext_modules = []
            warn(str(reason))

    def build_extensions(self) -> None:
        """Compile with the machine's compiler, else with zig's."""
        if machine_compiler() is None:
            zig = zig_compiler()
            if zig is None:
                raise RuntimeError("no C compiler was found, and the package `ziglang` is not installed")
            # Nothing of what Python was built with is passed on: zig refuses some linkers' flags.
            self.compiler.set_executables(
                compiler=zig,
                compiler_so=[*zig, "-fPIC", "-fwrapv", "-DNDEBUG", "-fno-sanitize=undefined"],
                linker_so=[*zig, "-shared", *(["-undefined", "dynamic_lookup"] if sys.platform == "darwin" else [])],
            )
        super().build_extensions()


def translate(extensions: list[Extension], folder: Path, force: bool) -> None:
    """Replace each extension's Python source by the C file that Cython makes of it."""
    from Cython.Build import cythonize  # noqa: PLC0415 (it is there only while something is compiled)

    made = cythonize(
        [Extension(extension.name, list(extension.sources)) for extension in extensions],
        build_dir=str(folder / "c"),
        compiler_directives=DIRECTIVES,
        force=force,
        nthreads=2,
        quiet=True,
        show_all_warnings=False,
    )
    sources = {extension.name: extension.sources for extension in made}
    for extension in extensions:
        extension.sources = sources[extension.name]


def warn(reason: str) -> None:
    """Say once, where the installer's log shows it, that the engine is not compiled and why."""
    print(f"warning: nddlc's engine is not compiled, it will run many times slower: {reason}", file=sys.stderr)
