"""Checked meaning in, program out."""
