"""Executed plans in, an independent judgement by z3 out."""
