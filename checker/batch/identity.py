"""Name a run by what determines its results: agent, models, batch seed, number of missions, the engine as it is."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from functools import cache
from pathlib import Path

from runtime.executive.configuration import AgentConfiguration

_ID_LENGTH = 8
ROOT = Path(__file__).resolve().parents[2]
ENGINE = ("nddl_lang", "compiler", "runtime", "checker")


def model_digest(sources: Mapping[str, str]) -> str:
    """The SHA-256 of the texts of a mission's models by name, included files among them."""
    parts = [[name, hashlib.sha256(sources[name].encode("utf-8", "surrogatepass")).hexdigest()] for name in sources]
    return hashlib.sha256(json.dumps(sorted(parts)).encode()).hexdigest()


@cache
def engine_digest() -> str:
    """The SHA-256 of the sources that read, compile, run and judge models; the same in whichever form they run."""
    content = hashlib.sha256()
    for folder in ENGINE:
        for path in sorted((ROOT / folder).rglob("*.py")):
            content.update(path.relative_to(ROOT).as_posix().encode() + b"\0")
            content.update(hashlib.sha256(path.read_bytes()).digest())
    return content.hexdigest()


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
