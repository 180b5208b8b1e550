"""Translate engine modules to C: `translate.py FOLDER SOURCE...` writes each source's C file under FOLDER."""

import sys

from Cython.Build import cythonize

# The `.pxd` alone gives the C types: annotations stay ordinary Python, and the same file runs uncompiled.
DIRECTIVES = {
    "language_level": 3,
    "annotation_typing": False,
    "infer_types": False,
    "boundscheck": True,
    "wraparound": False,
    "initializedcheck": False,
    "cdivision": True,
    "show_performance_hints": False,
}

if __name__ == "__main__":
    cythonize(sys.argv[2:], build_dir=sys.argv[1], compiler_directives=DIRECTIVES, force=True, nthreads=2, quiet=True)
