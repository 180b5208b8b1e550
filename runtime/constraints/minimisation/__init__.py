"""Minimal explanations: subsets of causes, propagated again in a scratch engine."""
