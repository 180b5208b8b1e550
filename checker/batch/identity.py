"""Name a run by what determines its results: agent, models, batch seed, number of missions, the engine as it is."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict

from runtime.executive.configuration import AgentConfiguration

_ID_LENGTH = 8


def model_digest(sources: Mapping[str, str]) -> str:
    """The SHA-256 of the texts of a mission's models by name, included files among them."""
    parts = [[name, hashlib.sha256(sources[name].encode("utf-8", "surrogatepass")).hexdigest()] for name in sources]
    return hashlib.sha256(json.dumps(sorted(parts)).encode()).hexdigest()


def run_id(
    agent: AgentConfiguration, models: str, seed: int, missions: int, engine: str, sampler: str = "random"
) -> str:
    """Eight hexadecimal digits; where the checkout lies, how fast it is and how many fly make no difference."""
    content = asdict(agent)
    del content["root"], content["constraint_seconds"]
    for goal in content["goals"]:
        del goal["places"]
    text = json.dumps([content, models, seed, missions, engine, sampler], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:_ID_LENGTH]
