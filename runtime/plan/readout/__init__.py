"""The state of a plan as plain data."""
