"""Fly real missions: load the models of an agent once, then run the executive from a seed."""

from checker.batch.worker import Fly
from runtime.executive.configuration import AgentConfiguration


def load(agent: AgentConfiguration) -> Fly:
    """Compile the models of `agent`; the result flies one mission per call."""
    raise NotImplementedError("the executive is not there yet")
