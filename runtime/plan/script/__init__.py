"""The script of a model: statements, calls, objects and their constructors."""
