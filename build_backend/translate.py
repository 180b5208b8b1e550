"""Translate engine modules to C: `translate.py FOLDER SOURCE...` writes each source's C file under FOLDER.

The code of memory views, four fifths of each C file, goes into one module that the others share.
"""

import subprocess
import sys
from pathlib import Path

from Cython.Build import cythonize

from freshness import SHARED

# The `.pxd` gives the C types of fields, functions and arguments: annotations stay ordinary Python, and the same file
# runs uncompiled. Of a local it tells the type where Cython infers another one than 64 bits from what is assigned.
DIRECTIVES = {
    "language_level": 3,
    "annotation_typing": False,
    "infer_types": True,
    "boundscheck": True,
    "wraparound": False,
    "initializedcheck": False,
    "cdivision": True,
    # A quarter less to compile: what is pickled says how, and nobody asks a compiled function for its signature.
    "auto_pickle": False,
    "binding": False,
    "show_performance_hints": False,
}

if __name__ == "__main__":
    folder, *sources = sys.argv[1:]
    cythonize(
        sources,
        build_dir=folder,
        compiler_directives=DIRECTIVES,
        shared_utility_qualified_name=SHARED,
        force=True,
        nthreads=2,
        quiet=True,
    )
    shared = Path(folder, *SHARED.split(".")).with_suffix(".c")
    shared.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-m", "cython", f"--generate-shared={shared}"], check=True)
