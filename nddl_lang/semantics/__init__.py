"""Syntax tree in, checked meaning out."""
