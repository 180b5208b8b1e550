"""`python -m nddlc`: the command, without the folder that one stands in on Python's search path."""

import sys
from pathlib import Path

# `python -m` puts that folder first, from where a workspace's files could be imported in place of packages.
if Path(sys.path[0]).resolve() != Path(__file__).resolve().parent.parent:
    del sys.path[0]

from nddlc.main import main

if __name__ == "__main__":
    main()
