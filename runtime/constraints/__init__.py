"""Domains, trail, temporal network and propagators: what still can hold, and why."""
