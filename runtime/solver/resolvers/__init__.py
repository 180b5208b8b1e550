"""Resolvers: the choices that mend a flaw, and their order."""
