"""Fly mutants of small missions and print one line for each: run it as a module, in either form of the engine."""

import random
import re
import shutil
import sys
import tempfile
from hashlib import sha256
from pathlib import Path

from checker.mission import read_mission
from checker.models import load_models
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.rendering import trace_json
from runtime.solver.configuration.configuration import default_configuration

HERE = Path(__file__).parent
SPOTS = re.compile(r"(?<![\w.])\d+(?![\w.])|<=|>=|==|contains|meets|equals|any")
OTHERS = {"<=": ">=", ">=": "<=", "==": "<=", "contains": "starts", "meets": "before", "equals": "contains"}
MISSIONS = ("repair", "request_lost", "order_of_requests")


def mutated(text: str, chance: random.Random) -> str:
    """The text with one number or relation changed."""
    spots = list(SPOTS.finditer(text))
    if not spots:
        return text
    spot = spots[chance.randrange(len(spots))]
    word = spot.group()
    other = str(max(0, int(word) + chance.choice((-3, -1, 1, 2, 5)))) if word.isdigit() else OTHERS.get(word, "starts")
    return text[: spot.start()] + other + text[spot.end() :]


def told(number: int) -> str:
    """Mutant `number`: how it ended, and a digest of its trace."""
    folders = [*sorted((HERE / "cases").iterdir()), *(HERE / "missions" / name for name in MISSIONS)]
    chance = random.Random(number)
    folder = folders[chance.randrange(len(folders))]
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch) / "mission"
        shutil.copytree(folder, place)
        models = sorted(place.glob("*.nddl"))
        model = models[chance.randrange(len(models))]
        model.write_text(mutated(model.read_text(), chance))
        mission, _ = read_mission(place / "mission.toml")
        assert mission is not None
        read = load_models(mission)
        if read.has_errors:
            return f"{number} {folder.name} invalid"
        programs = tuple(compile_model(analyse_file(place / reactor.model)) for reactor in read.agent.reactors)
        solvers = tuple(default_configuration() for _ in programs)
        outcome = run_mission(read.agent, MissionPrograms(programs, solvers), number)
        trace = "\n".join(map(trace_json, outcome.events)).replace(str(place), "")
    code = outcome.abort.code if outcome.abort is not None else "ended"
    return f"{number} {folder.name} {code} {outcome.last_tick} {sha256(trace.encode()).hexdigest()}"


if __name__ == "__main__":
    for index in range(int(sys.argv[1]), int(sys.argv[2])):
        print(told(index))
