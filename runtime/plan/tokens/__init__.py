"""Tokens: creation, relations, order on timelines, retraction and archive."""
