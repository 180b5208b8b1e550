"""Find a sampler by its name, or in a file of the user: `random`, or `mine.py:Sampler`."""

import hashlib
from collections.abc import Callable
from pathlib import Path

from checker.sampling.sampler import Sampler, Setting
from nddl_lang.text.nearest import nearest
from nddlc.inputs import Unusable
from nddlc.main import named
from runtime.user.library import load_module

SAMPLERS = {
    "random": "checker.sampling.sampler:RandomSampler",
    "lhs": "checker.sampling.quasi_random:LatinHypercube",
    "sobol": "checker.sampling.quasi_random:Sobol",
    "corners": "checker.sampling.spread:Corners",
    "art": "checker.sampling.spread:AdaptiveRandom",
    "art-partition": "checker.sampling.spread:AdaptivePartition",
    "adaptive": "checker.sampling.adaptive:Adaptive",
    "guided": "checker.sampling.guided:Guided",
}
_DIGITS = 8
_HELP = "docs/mission.md tells of them; a file of your own is named `file.py:Class`"


def find_sampler(name: str) -> tuple[str, Callable[[Setting], Sampler]]:
    """The name under which a run is kept, and what makes the sampler."""
    if name in SAMPLERS:
        found: Callable[[Setting], Sampler] = named(SAMPLERS[name])
        return name, found
    file, sign, class_name = name.rpartition(":")
    if not sign or not file.endswith(".py"):
        close = nearest(name, SAMPLERS)
        advice = f"did you mean `{close}`?" if close else f"there are {', '.join(SAMPLERS)}; {_HELP}"
        raise Unusable(f"there is no sampler `{name}`", advice)
    path = Path(file)
    if not path.is_file():
        raise Unusable(f"there is no file `{file}` with a sampler")
    made: Callable[[Setting], Sampler] | None = getattr(load_module(path.resolve()), class_name, None)
    if made is None or not callable(getattr(made, "choose", None)):
        raise Unusable(f"`{class_name}` in `{file}` is no sampler: it has no method `choose`", _HELP)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:_DIGITS]
    return f"{path.name}:{class_name}@{digest}", made
