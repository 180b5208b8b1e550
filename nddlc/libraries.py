"""Load the constraints that a project wrote in Python, once per command, for whoever reads its models."""

from functools import cache
from pathlib import Path

from nddlc.inputs import configured
from runtime.user.library import Library, load_library
from runtime.user.limit import USUAL


def library_of(path: Path) -> Library:
    """What the model at `path` may call; raises UserCodeError where a module cannot be used."""
    settings = configured(path)
    return _library(settings.modules, settings.seconds or USUAL)


@cache
def _library(modules: tuple[Path, ...], seconds: float) -> Library:
    here = Path.cwd()
    names = [module.relative_to(here) if module.is_relative_to(here) else module for module in modules]
    return load_library(Path(), [name.as_posix() for name in names], seconds=seconds)
