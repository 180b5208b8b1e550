"""Solver configurations: XML or TOML in, handlers and filters out."""
