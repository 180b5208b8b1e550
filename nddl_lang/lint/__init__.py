"""Advice about models that mean something, but perhaps not what was meant."""
