"""Draws in, outcomes of many missions out."""
