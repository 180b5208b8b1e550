"""Flaws: the agenda, its updates, filters and selection."""
