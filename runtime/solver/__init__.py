"""Flaws and their resolvers: how a plan is completed."""
