"""NDDL text in; the same text in the one documented style out."""
