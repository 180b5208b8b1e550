"""Convergence: carry propagation on to its end where it was slowed down or left off."""

from runtime.constraints.engine import Engine

_LONG = 50_000  # runs of one constraint, before it is left to creep


def converge(engine: Engine) -> bool:
    """Propagate without loss what creeps; false on a conflict.

    What creeps after many runs stays in `engine.creeping`: then nothing is known of the values between its bounds.
    """
    usual = (engine.coarse_after, engine.most_runs)
    engine.coarse_after = engine.most_runs = _LONG
    creeping = [c for c in sorted(engine.creeping) if engine.op[c] >= 0]
    engine.creeping.clear()
    for c in creeping:
        engine.schedule(c)
    holds = engine.propagate()
    engine.coarse_after, engine.most_runs = usual
    return bool(holds)
