"""The agent: how a plan meets the world, tick by tick."""
