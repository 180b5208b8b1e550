"""Missions in, verdicts with reasons out."""
