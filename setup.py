"""Hand the engine's modules to setuptools; all else is in pyproject.toml."""

import sys
from pathlib import Path

from setuptools import setup

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "build_backend"))

from engine_build import BuildEngine, engine_extensions  # noqa: E402

setup(ext_modules=engine_extensions(ROOT), cmdclass={"build_ext": BuildEngine})
