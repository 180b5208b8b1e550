"""Hand the engine's modules and the man page to setuptools; all else is in pyproject.toml."""

import sys
from pathlib import Path

from setuptools import setup

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "build_backend"))

from engine_build import BuildEngine, engine_extensions  # noqa: E402

MAN_PAGE = "docs/nddlc.1"
PAGES = [("share/man/man1", [MAN_PAGE])] if (ROOT / MAN_PAGE).is_file() else []

setup(ext_modules=engine_extensions(ROOT), cmdclass={"build_ext": BuildEngine}, data_files=PAGES)
