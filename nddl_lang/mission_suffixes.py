"""How the name of a file ends that describes a mission: of nddlc's own, and an agent file of T-REX."""

MISSION_SUFFIXES = (".toml", ".xml")
