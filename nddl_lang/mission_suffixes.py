"""How the name of a file ends that describes a mission: of nddlc's own, and an agent file of T-REX."""

AGENT_SUFFIXES = (".xml", ".cfg")
MISSION_SUFFIXES = (".toml", *AGENT_SUFFIXES)
