"""Constraints that a modeler writes in Python: their interface, how they are found, run in the engine and tested."""
