"""The build backend: setuptools, plus what compiling the engine needs on this machine."""

from collections.abc import Mapping
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (
    build_editable,
    build_sdist,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

from engine_build import is_set, machine_compiler, warn

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

Settings = Mapping[str, Any] | None


def engine_requirements() -> list[str]:
    """Name what must be fetched to compile the engine here; `ziglang` brings a C compiler to a machine without one."""
    if is_set("NDDLC_NO_COMPILE"):
        return []
    return ["Cython>=3.2"] if machine_compiler() else ["Cython>=3.2", "ziglang>=0.13"]


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Answer the front end's question before it builds a wheel."""
    return [*build_meta.get_requires_for_build_wheel(config_settings), *engine_requirements()]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """Answer the front end's question before it builds an editable wheel."""
    return [*build_meta.get_requires_for_build_editable(config_settings), *engine_requirements()]


def build_wheel(folder: str, config_settings: Settings = None, metadata_folder: str | None = None) -> str:
    """Build a wheel into `folder`; one without the compiled engine fits every machine, and says so once."""
    if is_set("NDDLC_NO_COMPILE"):
        warn("NDDLC_NO_COMPILE is set")
    return build_meta.build_wheel(folder, config_settings, metadata_folder)


if __name__ == "__main__":
    print(*engine_requirements(), sep="\n")
