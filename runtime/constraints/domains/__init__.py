"""Domains of variables, kept in arrays: bounds, bit sets, base domains."""
