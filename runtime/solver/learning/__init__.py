"""Conflict analysis, nogoods, and the failure log of a search."""
