"""Read the parse tables that generate.py made from the grammar."""

import json
from pathlib import Path

_TABLES = json.loads(Path(__file__).with_name("tables.json").read_bytes())

END = "$END"

# Per state: what to do at a kind of lexeme (above 0: go to that state, below 0: reduce by that rule, 0: accept).
ACTIONS: list[dict[str, int]] = _TABLES["actions"]

# Per state: where to go once a part of that name is complete.
GOTOS: list[dict[str, int]] = _TABLES["gotos"]

# Head, number of parts, name of the function that builds the node (None: the only part is passed on).
RULES: list[tuple[str, int, str | None]] = [(head, size, name) for head, size, name in _TABLES["rules"]]
