"""Marks: states of plan and engine to go back to; they nest, and are named by their depth."""

from runtime.constraints.domains.arrays import lengthen
from runtime.plan.store.links import undo
from runtime.plan.store.plan import Plan


def mark(plan: Plan) -> int:
    """Remember the present state, which must be a fixpoint; the number of the mark."""
    level = plan.rows.level
    if level == len(plan.mark_engine):
        lengthen(plan, "mark_engine mark_rows mark_uses mark_awaited mark_objects")
    if level == 0:
        plan.rows.trail_length = 0
        plan.awaited_count = 0
    plan.mark_engine[level] = plan.engine.mark()
    plan.mark_rows[level] = plan.rows.trail_length
    plan.mark_uses[level] = plan.resources.count
    plan.mark_awaited[level] = plan.awaited_count
    plan.mark_objects[level] = plan.object_count
    plan.rows.level = level + 1
    return level


def rewind(plan: Plan, number: int) -> None:
    """Go back to a mark; it stays, later ones are gone."""
    plan.stack_length = 0
    plan.queue_length = 0
    plan.operands_used = 0
    plan.engine.rewind(plan.mark_engine[number])
    undo(plan.rows, plan.mark_rows[number])
    plan.resources.truncate(plan.mark_uses[number])
    plan.forget_awaited(plan.mark_awaited[number])
    if plan.object_count > plan.mark_objects[number]:
        plan.services.forget_objects(plan.mark_objects[number])
    plan.rows.level = number + 1


def release(plan: Plan, number: int) -> None:
    """Go back to a mark and drop it."""
    rewind(plan, number)
    plan.rows.level = number
    if number == 0:
        plan.engine.commit()


def commit(plan: Plan) -> None:
    """Forget all marks: what holds now is level 0."""
    plan.engine.commit()
    plan.rows.trail_length = 0
    plan.rows.level = 0
    plan.awaited_count = 0
