"""Outcomes in, text, JSON and HTML out."""
