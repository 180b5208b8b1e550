"""Tokens, timelines and rule firing: the plan so far."""
