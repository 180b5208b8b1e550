"""Backtracking by the trail, and retraction at level 0."""
