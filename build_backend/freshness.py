"""Tell which of the engine's binaries were made from something else than the sources that stand there now."""

import hashlib
import importlib.metadata
import json
import re
import sysconfig
from pathlib import Path

SUFFIX: str = sysconfig.get_config_var("EXT_SUFFIX")
SHARED = "runtime.shared_views"  # what Cython would otherwise put into each binary; it has no source
CIMPORT = re.compile(r"^[ \t]*(?:from[ \t].*[ \t])?cimport[ \t](?:[^(\n]*\([^)]*\)|.*)", re.MULTILINE)


def engine_modules(root: Path) -> list[str]:
    """Name the modules that are compiled: those in `runtime` that have a `.pxd`."""
    declared = sorted((root / "runtime").rglob("*.pxd"))
    return [".".join(path.relative_to(root).with_suffix("").parts) for path in declared]


def compiled_modules(root: Path) -> list[str]:
    """Name all that a build makes: the engine modules, and the one that they share."""
    return [*engine_modules(root), SHARED]


def source(root: Path, module: str) -> Path:
    """Say where the source of an engine module lies."""
    return root / (module.replace(".", "/") + ".py")


def binary(root: Path, module: str) -> Path:
    """Say where the binary of `module` lies once it is built in place."""
    return root / (module.replace(".", "/") + SUFFIX)


def stamp(root: Path) -> Path:
    """Say where it is written what each binary was made from."""
    return root / "build" / f"engine{SUFFIX}.json"


def read_stamp(root: Path) -> dict[str, list[str]]:
    """Read, for each module, the digests of source and binary as they were after its build."""
    return dict(json.loads(stamp(root).read_text(encoding="ascii"))) if stamp(root).exists() else {}


def stale_modules(root: Path) -> list[str]:
    """Name the engine modules whose binary is missing, comes from elsewhere or was made from another source."""
    known = read_stamp(root)
    digests = source_digests(root)
    return [module for module in digests if known.get(module) != [digests[module], binary_digest(root, module)]]


def orphaned_binaries(root: Path) -> list[Path]:
    """List the binaries that no engine module stands for any more, and that Python would load all the same."""
    wanted = {binary(root, module) for module in compiled_modules(root)}
    return sorted(set((root / "runtime").rglob(f"*{SUFFIX}")) - wanted)


def unfit_binaries(root: Path) -> list[Path]:
    """List the binaries that must not be loaded: the orphans and the stale."""
    stale = [binary(root, module) for module in stale_modules(root)]
    return [*orphaned_binaries(root), *(path for path in stale if path.exists())]


def source_digests(root: Path) -> dict[str, str]:
    """Sum up what each binary depends on: the module's files, the layouts it reads, how and by what it is built."""
    layouts = {module: source(root, module).with_suffix(".pxd").read_bytes() for module in engine_modules(root)}
    recipe = b"".join((root / "build_backend" / name).read_bytes() for name in ("engine_build.py", "translate.py"))
    how = digest(recipe, cython_version().encode())
    digests = {SHARED: how}
    for module in layouts:
        read = (layouts[name] for name in needed(module, layouts))
        digests[module] = digest(how.encode(), source(root, module).read_bytes(), *read)
    return digests


def cython_version() -> str:
    """Say which Cython would translate; the binaries of two of them do not share."""
    try:
        return importlib.metadata.version("Cython")
    except importlib.metadata.PackageNotFoundError:
        return "none"


def needed(module: str, layouts: dict[str, bytes]) -> list[str]:
    """Name the modules whose `.pxd` the binary of `module` depends on, its own among them."""
    found: set[str] = set()
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            for statement in CIMPORT.findall(layouts[name].decode("utf-8")):
                named = [word for word in re.findall(r"[\w.]+", statement) if word in layouts]
                words = set(re.findall(r"\w+", statement))
                # Else by the last word of the name: at worst a module is rebuilt that need not be.
                waiting.extend(named or [other for other in layouts if other.rpartition(".")[2] in words])
    return sorted(found)


def binary_digest(root: Path, module: str) -> str:
    """Sum up the binary itself, so that one from elsewhere is not taken for ours."""
    path = binary(root, module)
    return digest(path.read_bytes()) if path.exists() else "missing"


def digest(*parts: bytes) -> str:
    """Sum up some contents, in order."""
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()
