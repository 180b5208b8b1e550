"""NDDL text in; its meaning and its diagnostics out."""
