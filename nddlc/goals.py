"""The goals of a mission file, for `nddlc plan`: whose they are, and the model that asks for them."""

from pathlib import Path

import click

from checker.goal_model import goal_model, planners_of
from checker.mission import read_mission
from nddl_lang.text.nearest import nearest
from nddl_lang.text.render import render
from nddlc.fitting import colours
from nddlc.inputs import Unusable


def goals_of(file: Path, name: str | None) -> tuple[Path, str, str | None, int]:
    """Of a mission file: where the model with the goals stands, its text, the file of its solver, the final tick."""
    mission, found = read_mission(file)
    for each in found:
        click.echo(render(each, colour=colours()), err=True)
    if mission is None:
        raise Unusable("the mission file is in error: nothing was planned")
    agent = mission.agent
    planners = planners_of(agent)
    named = [each.name for each in planners]
    if not planners:
        raise Unusable(f"`{file}` has no goal to plan for")
    if name is None and len(planners) > 1:
        raise Unusable("several reactors have goals", f"--reactor names one of them: {', '.join(named)}")
    if name is not None and name not in named:
        meant = nearest(name, named)
        advice = f"did you mean `{meant}`?" if meant is not None else f"there are: {', '.join(named)}"
        raise Unusable(f"no reactor `{name}` has goals", advice)
    planner = planners[named.index(name) if name is not None else 0]
    solver = None if planner.solver is None else str(Path(agent.root) / planner.solver)
    where = Path(agent.root) / f"goals of {planner.name}"
    return where, goal_model(agent, planner), solver, agent.final_tick
