"""Say which version of nddlc this is, and in which form its engine runs."""

import platform
from importlib.metadata import PackageNotFoundError, version

from runtime.build_form import build_form


def version_text() -> str:
    """One line for `nddlc --version`."""
    try:
        number = version("nddlc")
    except PackageNotFoundError:
        number = "(not installed)"
    return f"nddlc {number}, engine {build_form()}, Python {platform.python_version()}"
