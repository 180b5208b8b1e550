"""How a file is known that describes a mission: by the end of its name, nddlc's own or an agent file of T-REX's."""

import re

AGENT_SUFFIXES = (".xml", ".cfg")
MISSION_SUFFIXES = (".toml", *AGENT_SUFFIXES)
MISSION_HEAD = re.compile(r"^[ \t]*\[[ \t]*mission[ \t]*\]", re.MULTILINE)  # the table that one of ours has
