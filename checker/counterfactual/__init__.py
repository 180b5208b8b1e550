"""Causes that were tried: a failed mission in; the lines, with a small change of which it passes, out."""
