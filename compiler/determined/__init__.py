"""Determined reactors: register code for models that leave nothing to choose, or the choices that are in the way."""
