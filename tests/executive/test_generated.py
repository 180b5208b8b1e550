"""Random agents fly as the specification has it, in every way there is; the oracle reads nothing but the trace."""

from pathlib import Path

import pytest

from checker.judge.judge import judge_mission
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.mission import record_mission, run_mission
from runtime.executive.outcome import RepairStage
from tests.executive.flying import fly, open_goals, planner
from tests.executive.generated.campaign import faults_of_seed
from tests.executive.generated.flights import brief, lines_of, loaded
from tests.executive.generated.oracle import Oracle
from tests.executive.generated.writer import random_agent

# Agents that once flew wrongly: an end that could not be outwaited, two goals alike, a recall before its time; a
# rejected goal that expires while its owner sleeps, a request while its owner plans, a command whose task is archived.
MENDED = (56, 75, 201, 456, 15, 578, 139, 202)
TASK = (
    'class Task extends AgentTimeline { predicate Idle { } predicate Do { int n; } Task(Mode m) { super(m, "Idle"); } }'
    " Task::Do { duration == 5; n <= 3; } Task task = new Task(Internal); close();"
)


@pytest.mark.parametrize("seed", [*range(12), *MENDED])
def test_a_random_agent_flies_as_it_must(seed: int) -> None:
    assert faults_of_seed(seed)[1] == []


# A repair that forgets the past ends in a contradiction, where rules look back at what has happened; one token answers
# two requests.
@pytest.mark.parametrize("seed", [*range(6), 8100003, 7100277])
def test_a_random_agent_with_guards_and_ties_flies_as_it_must(seed: int) -> None:
    assert faults_of_seed(seed, wide=True)[1] == []


# The mission is aborted before a reactor's turn has come, to which nothing of that tick has happened; a redrawn value
# is outdated at once where its token is put off.
@pytest.mark.parametrize("seed", [*range(4), 7300017, 7400307])
def test_a_random_agent_with_draws_and_stores_flies_as_it_must(seed: int) -> None:
    assert faults_of_seed(seed, wide=True, rich=True)[1] == []


# A log of steps, of which one found no plan; requests taken back while the owner plans, and once no steps are left; few
# steps, of which a sleeping planner wants one.
@pytest.mark.parametrize("seed", [0, 1, 5, 44, 49, 128])
def test_a_random_agent_of_many_reactors_flies_as_it_must(seed: int) -> None:
    assert faults_of_seed(seed, wide=True, rich=True, deep=True)[1] == []


@pytest.mark.parametrize("seed", [0, 3])
def test_a_random_agent_with_priorities_and_a_shared_store_flies_as_it_must(seed: int) -> None:
    assert faults_of_seed(seed, wide=True, ranks=True)[1] == []


def test_a_sleeper_asks_anew_in_the_tick_in_which_its_owner_gives_up_what_its_plan_has_come_to_leave_more_room(
    tmp_path: Path,
) -> None:
    agent, programs = loaded(random_agent(41015, wide=True, rich=True, deep=True, ranks=True).write(tmp_path))
    outcome, visited = (run_mission(agent, programs, 1, every_tick=every) for every in (False, True))
    assert brief(outcome) == brief(visited)


def test_an_agent_file_gives_planners_the_steps_of_the_mission_file(tmp_path: Path) -> None:
    agent = random_agent(45028, True, wide=True, ranks=True)  # one tick takes more than 50 steps
    text = agent.agent_file()
    assert text is not None
    files = (agent.write(tmp_path), tmp_path / "agent.xml")
    files[1].write_text(text)
    flown = [brief(run_mission(*loaded(file), 1)) for file in files]
    assert flown[0] == flown[1]


def test_what_a_sleeper_takes_in_before_it_forgets_the_past_is_on_record(tmp_path: Path) -> None:
    agent, programs = loaded(random_agent(9400102, wide=True, rich=True, deep=True).write(tmp_path))
    outcome, record = record_mission(agent, programs, 1, until=75)
    assert any(event.stage is RepairStage.FORGET_PAST for event in outcome.events)
    assert judge_mission(agent, programs.programs, outcome, record, programs.constraints).holds


def test_the_oracle_sees_what_is_told_twice(tmp_path: Path) -> None:
    agent = random_agent(0, plain=True)
    lines = lines_of(run_mission(*loaded(agent.write(tmp_path)), 1))
    for place in range(len(lines)):
        if lines[place]["kind"] == "observation":
            oracle = Oracle(agent, [*lines[: place + 1], lines[place], *lines[place + 1 :]])
            oracle.read()
            assert any("two observations" in one for one in oracle.wrong)


def test_a_mandatory_goal_is_open_that_was_recalled_before_it_was_due() -> None:
    goal = GoalConfiguration("task", "Do", 0, True, start=(30, 30), parameters=(("n", 1),), recall=5)
    outcome = fly(planner("plan", TASK, "task", lookahead=2), until=40, goals=(goal,))
    assert len(open_goals(outcome)) == 1
