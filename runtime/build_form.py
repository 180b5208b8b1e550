"""Tell in which form the engine runs, compiled or interpreted; load the second where NDDLC_INTERPRETED asks for it."""

import importlib.util
import os
import sys
from importlib.machinery import SOURCE_SUFFIXES, ExtensionFileLoader, FileFinder, SourceFileLoader
from pathlib import Path
from typing import Literal

_FOLDER = Path(__file__).resolve().parent


def build_form() -> Literal["compiled", "interpreted"]:
    """Tell in which form this process loads the engine."""
    loaders = [_loader(name) for name in _engine_modules()]
    compiled = bool(loaders) and all(isinstance(loader, ExtensionFileLoader) for loader in loaders)
    return "compiled" if compiled else "interpreted"


def uncompiled_notice() -> str | None:
    """Say what the user loses where the engine should have been compiled and is not; None where all is as asked."""
    if interpreting_is_asked() or build_form() == "compiled":
        return None
    return (
        "the engine runs uncompiled, many times slower, with the same results: no C compiler, or no "
        "header files of Python, could be used when nddlc was installed (NDDLC_INTERPRETED=1 silences this)"
    )


def _engine_modules() -> list[str]:
    """Name the modules that a complete build compiles: those with a `.pxd` beside them."""
    declared = sorted(_FOLDER.rglob("*.pxd"))
    return [".".join((__package__, *path.relative_to(_FOLDER).with_suffix("").parts)) for path in declared]


def interpreting_is_asked() -> bool:
    """Tell whether the environment asks for the interpreted form."""
    return os.environ.get("NDDLC_INTERPRETED", "") not in ("", "0")


def load_interpreted() -> None:
    """From here on, find only sources in the folders of the engine; what is loaded already must not be compiled."""
    late = [
        name for name in _engine_modules() if name in sys.modules and isinstance(_loader(name), ExtensionFileLoader)
    ]
    if late:
        raise RuntimeError(f"`runtime.build_form` must be imported before {', '.join(late)}")
    sys.path_hooks.insert(0, _find_sources)
    for path in [path for path in sys.path_importer_cache if _is_ours(path)]:
        del sys.path_importer_cache[path]


def _find_sources(path: str) -> FileFinder:
    """Serve as a path hook that takes the engine's folders and leaves all others to the usual ones."""
    if not _is_ours(path):
        raise ImportError(f"{path} is no folder of the engine", path=path)
    return FileFinder(path, (SourceFileLoader, SOURCE_SUFFIXES))


def _is_ours(path: str) -> bool:
    return Path(path).resolve().is_relative_to(_FOLDER)


def _loader(name: str) -> object:
    loaded = sys.modules.get(name)
    spec = loaded.__spec__ if loaded is not None else importlib.util.find_spec(name)
    return spec.loader if spec is not None else None


# At import, because a worker process may reach the engine by any path: who imports the engine imports this first.
if interpreting_is_asked():
    load_interpreted()
