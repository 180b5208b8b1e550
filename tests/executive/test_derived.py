"""Missions whose traces were derived by hand from the reference of T-REX before they were flown."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import pytest

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import Flyer, flown, history, lines, planner, simulator


def device(name: str, predicates: str) -> str:
    """A class of timelines that rest by default."""
    return (
        f"class {name} extends AgentTimeline {{ predicate Rest {{ }} {predicates} "
        f'{name}(Mode m) {{ super(m, "Rest"); }} }}'
    )


ARM, BOOM = device("Arm", "predicate Act { }"), device("Boom", "predicate Act { }")
TASK, JOB = device("Task", "predicate Do { } predicate Sing { }"), device("Job", "predicate Make { }")


def world(name: str, rules: str) -> Flyer:
    """A simulator of one device."""
    text = f"{device(name, 'predicate Act { }')} {rules} {name} {name.lower()} = new {name}(Internal); close();"
    return simulator(f"sim_{name.lower()}", text, name.lower())


def user(rules: str, own: str, others: str, latency: int = 1) -> Flyer:
    """A planner of some timelines over others, by the names of their classes."""
    made = [f"{name} {name.lower()} = new {name}(Internal);" for name in own.split()]
    made += [f"{name} {name.lower()} = new {name}(External);" for name in others.split()]
    text = f"{ARM}{BOOM}{TASK}{JOB} {rules} {' '.join(made)} close();"
    return planner(f"plan_{own.split()[0].lower()}", text, own.lower(), others.lower(), latency)


def do(start: int, last: int | None = None, *, what: str = "Do", recall: int | None = None) -> GoalConfiguration:
    """A goal on `task`."""
    line = "job" if what == "Make" else "task"
    return GoalConfiguration(line, what, start=(start, start if last is None else last), recall=recall)


class Derived(NamedTuple):
    """A mission, and what must come out."""

    name: str
    flyers: tuple[Flyer, ...]
    goals: tuple[GoalConfiguration, ...]
    seen: dict[str, str]  # by timeline: ticks and predicates
    counts: Mapping[str, int] = MappingProxyType({})
    until: int = 60
    code: str = ""


AFTER = "Task::Do { duration == 5; met_by(Arm.Act a); a.duration == 3; }"
CHAIN = (
    user("Job::Make { duration == 6; met_by(Task.Do d); d.duration == 8; }", "Job", "Task", 2),
    user("Task::Do { duration == 8; contains(Arm.Act a); a.start == start + 4; }", "Task", "Arm"),
    world("Arm", "Arm::Act { duration == 3; }"),
)
AT_ONCE = (
    CHAIN[0],
    user("Task::Do { duration == 8; starts(Arm.Act a); }", "Task", "Arm"),
    CHAIN[2],
)
BOTH = "any(Arm.Act a); a.start == start; any(Boom.Act b); b.start == start;"
MISSED = "Task::Sing { duration == 2; met_by(Boom.Act b); b.duration == 4; }"

MISSIONS = (
    # Section 4, row 4: a slack of 100 ticks is used up by who answers early or late, one tick more is one repair.
    Derived(
        "slack_answered_early",
        (user(AFTER, "Task", "Arm"), world("Arm", "Arm::Act { duration == 3; }")),
        (do(10, 110),),
        {"arm": "0 Rest, 7 Act, 10 Rest", "task": "0 Rest, 10 Do, 15 Rest"},
        {"relax": 0, "reject": 0},
        130,
    ),
    Derived(
        "slack_answered_late",
        (user(AFTER, "Task", "Arm"), world("Arm", "Arm::Act { duration == 3; } Arm::Rest { duration >= 107; }")),
        (do(10, 110),),
        {"arm": "0 Rest, 107 Act, 110 Rest", "task": "0 Rest, 110 Do, 115 Rest"},
        {"relax": 0, "reject": 0},
        130,
    ),
    Derived(
        "slack_answered_a_tick_too_late",
        (user(AFTER, "Task", "Arm"), world("Arm", "Arm::Act { duration == 3; } Arm::Rest { duration >= 108; }")),
        (do(10, 110),),
        {"arm": "0 Rest", "task": "0 Rest"},
        {"relax": 1, "abort": 0},
        130,
    ),
    # A recall at the tick at which the middle begins: that goes on to its end, the top is dropped.
    Derived(
        "recall_as_the_middle_begins",
        CHAIN,
        (do(13, what="Make", recall=5),),
        {"job": "0 Rest", "task": "0 Rest, 5 Do, 13 Rest", "arm": "0 Rest, 9 Act, 12 Rest"},
        {"recall": 2, "relax": 0},
    ),
    Derived(
        "recall_a_tick_before_the_middle_begins",
        CHAIN,
        (do(13, what="Make", recall=4),),
        {"job": "0 Rest", "task": "0 Rest", "arm": "0 Rest"},
        {"recall": 2, "relax": 0},
    ),
    Derived(
        "recall_a_tick_before_all_begin",
        AT_ONCE,
        (do(13, what="Make", recall=4),),
        {"job": "0 Rest", "task": "0 Rest", "arm": "0 Rest"},
        {"relax": 0},
    ),
    Derived(
        "recall_as_all_begin",
        AT_ONCE,
        (do(13, what="Make", recall=5),),
        {"job": "0 Rest", "task": "0 Rest, 5 Do, 13 Rest", "arm": "0 Rest, 5 Act, 8 Rest"},
        {"relax": 0},
    ),
    # What a task that is over said of one that goes on survives a repair that keeps the past.
    Derived(
        "bound_of_an_archived_task_in_a_repair",
        (
            user(
                "Task::Do { duration == 5; any(Arm.Act a); a.start == start; a.end <= end + 20; }"
                f"Arm::Act {{ duration <= 50; }} {MISSED}",
                "Task Arm",
                "Boom",
            ),
            world("Boom", "Boom::Act { duration == 4; } Boom::Rest { duration >= 30; }"),
        ),
        (do(3), do(12, 20, what="Sing")),
        {"task": "0 Rest, 3 Do, 8 Rest", "arm": "0 Rest, 3 Act, 28 Rest", "boom": "0 Rest"},
        {"relax": 1, "abort": 0},
    ),
    # Two tasks in turn find the same two at work; the tighter of what they say counts.
    Derived(
        "two_tasks_tie_the_same_two",
        (
            user(
                f"Task::Do {{ duration == 4; {BOTH} a.end <= b.end + 9; }}"
                "Task::Sing { duration == 3; contained_by(Arm.Act a); contained_by(Boom.Act b); a.end <= b.end + 2; }"
                "Arm::Act { duration <= 50; } Job::Make { duration == 2; }",
                "Task Arm Job",
                "Boom",
            ),
            world("Boom", "Boom::Act { duration == 25; }"),
        ),
        (do(3), do(9, what="Sing"), do(20, what="Make")),
        {
            "boom": "0 Rest, 3 Act, 28 Rest",
            "arm": "0 Rest, 3 Act, 30 Rest",
            "task": "0 Rest, 3 Do, 7 Rest, 9 Sing, 12 Rest",
        },
        {"relax": 0},
    ),
    # One of the two ends too early for the other, which has to go on: the task that said so is past, which the first
    # repair keeps and the second forgets.
    Derived(
        "tied_to_what_ends_too_early",
        (
            user(
                f"Task::Do {{ duration == 4; {BOTH} a.end <= b.end; }} Arm::Act {{ duration >= 30; }}"
                "Task::Sing { duration == 2; }",
                "Task Arm",
                "Boom",
            ),
            world("Boom", "Boom::Act { duration == 20; }"),
        ),
        (do(3), do(10, what="Sing")),
        {"boom": "0 Rest, 3 Act, 23 Rest", "arm": "0 Rest, 3 Act"},
        {"relax": 2, "abort": 0},
        30,
    ),
    # The same of two that the world runs: the one that goes on is missed to end.
    Derived(
        "two_of_the_world_tied_by_what_is_over",
        (
            user(
                f"Task::Do {{ duration == 4; {BOTH} a.end <= b.end; }} Task::Sing {{ duration == 2; }}",
                "Task",
                "Arm Boom",
            ),
            world("Boom", "Boom::Act { duration == 20; }"),
            world("Arm", "Arm::Act { duration == 30; }"),
        ),
        (do(3), do(10, what="Sing")),
        {"boom": "0 Rest, 3 Act, 23 Rest", "arm": "0 Rest, 3 Act, 33 Rest"},
        {"relax": 2, "abort": 0},
    ),
    # While the task that says so runs, it is a fact, and nothing helps.
    Derived(
        "two_of_the_world_tied_by_what_runs",
        (
            user(f"Task::Do {{ duration == 40; {BOTH} a.end <= b.end; }}", "Task", "Arm Boom"),
            world("Boom", "Boom::Act { duration == 20; }"),
            world("Arm", "Arm::Act { duration == 30; }"),
        ),
        (do(3),),
        {"boom": "0 Rest, 3 Act, 23 Rest", "arm": "0 Rest, 3 Act"},
        {"relax": 2, "abort": 1},
        60,
        "F2",
    ),
    # What is tied from below may end sooner than what it is tied to; a later goal on the same timeline waits for it.
    Derived(
        "a_goal_waits_for_what_is_tied",
        (
            user(
                f"Task::Do {{ duration == 4; {BOTH} b.end + 2 <= a.end; a.end <= b.end + 6; }}"
                "Task::Sing { duration == 2; }",
                "Task Arm",
                "Boom",
            ),
            world("Boom", "Boom::Act { duration == 10; }"),
        ),
        (do(3), do(9, what="Sing"), GoalConfiguration("arm", "Act", start=(14, 40), duration=(7, 7))),
        {"boom": "0 Rest, 3 Act, 13 Rest", "arm": "0 Rest, 3 Act, 15 Act, 22 Rest"},
        {"relax": 0, "reject": 0},
    ),
    # What a running task asks for behind a guard of the clock is asked of the world when it is due.
    Derived(
        "asked_for_once_it_has_begun",
        (
            user(
                "Task::Do { duration == 10; if (start <= AGENT_CLOCK)"
                "{ any(Arm.Act a); a.start >= start + 3; a.start <= start + 6; } }",
                "Task",
                "Arm",
            ),
            world("Arm", "Arm::Act { duration == 3; }"),
        ),
        (do(5),),
        {"task": "0 Rest, 5 Do, 15 Rest", "arm": "0 Rest, 8 Act, 11 Rest"},
        {"relax": 0, "request": 2},
    ),
    # What happened at somebody else's wish before the goal came is found, and not asked for again.
    Derived(
        "what_happened_before_the_goal_came_is_found",
        (
            user("Task::Do { duration == 5; any(Arm.Act a); a.end + 2 <= start; start <= a.end + 20; }", "Task", "Arm"),
            world("Arm", "Arm::Act { duration == 3; }"),
        ),
        (
            GoalConfiguration("arm", "Act", start=(3, 3)),
            GoalConfiguration("task", "Do", at=8, start=(12, 12)),
        ),
        {"arm": "0 Rest, 3 Act, 6 Rest", "task": "0 Rest, 12 Do, 17 Rest"},
        {"relax": 0, "request": 2},
    ),
    # A goal of the tick before its only start is passed on at once.
    Derived(
        "goal_of_the_tick_before_with_a_child_at_once",
        (
            user("Task::Do { duration == 5; starts(Arm.Act a); }", "Task", "Arm"),
            world("Arm", "Arm::Act { duration == 3; }"),
        ),
        (GoalConfiguration("task", "Do", at=9, start=(10, 10)),),
        {"task": "0 Rest, 10 Do, 15 Rest", "arm": "0 Rest, 10 Act, 13 Rest"},
        {"relax": 0, "reject": 0},
    ),
    # A task that is over long since still says when the second of two begins: three ticks after the end of the first.
    Derived(
        "second_child_begins_long_after_its_parent",
        (
            user(
                "Task::Do { duration == 4; any(Arm.Act a); a.start == start; any(Boom.Act b); b.start == a.end + 3; }"
                "Task::Sing { duration == 2; } Arm::Act { duration <= 12; }",
                "Task Arm",
                "Boom",
            ),
            world("Boom", "Boom::Act { duration == 5; }"),
        ),
        (do(3), do(10, what="Sing")),
        {"arm": "0 Rest, 3 Act, 15 Rest", "boom": "0 Rest, 18 Act, 23 Rest"},
        {"relax": 0},
    ),
)


@pytest.mark.parametrize("mission", MISSIONS, ids=lambda mission: mission.name)
def test_what_was_derived_comes_out(mission: Derived) -> None:
    flight = flown(*mission.flyers, until=mission.until, goals=mission.goals)
    told = "\n".join(lines(flight.outcome))
    assert flight.report.holds, told
    assert {line: ", ".join(history(flight.outcome, line)) for line in mission.seen} == mission.seen, told
    assert {kind: len(lines(flight.outcome, kind)) for kind in mission.counts} == mission.counts, told
    assert (flight.outcome.abort.code if flight.outcome.abort is not None else "") == mission.code, told
