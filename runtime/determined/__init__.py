"""Carry out register code: a compiled loop for reactors without choice, and the reactor that lives on it."""
