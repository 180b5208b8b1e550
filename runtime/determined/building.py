"""Find out whether a reactor of a mission is determined, once per process, and make its compiled form."""

from compiler.determined.reasons import ChoiceReason, FreeChoice
from compiler.program import Program
from runtime.determined.loading import RegisterProgram, load_determined
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.workbench import Workbench

Found = tuple[RegisterProgram | None, tuple[ChoiceReason, ...]]

# By the identity of the program, which is kept: models are loaded once and flown often.
_KNOWN: dict[tuple[int, ReactorConfiguration, float, int], tuple[Program, Found]] = {}
MOST = 64


def known(program: Program, configuration: ReactorConfiguration, tick: float, final_tick: int) -> Found | None:
    """What was found out before."""
    found = _KNOWN.get((id(program), configuration, tick, final_tick))
    return None if found is None else found[1]


def find_out(
    bench: Workbench, program: Program, configuration: ReactorConfiguration, tick: float, final_tick: int
) -> Found:
    """The register code of a reactor, or why it has none; `bench` holds its model as the mission starts it."""
    found = _obstacles(configuration) or load_determined(
        bench, program, configuration.internal, configuration.external, configuration.lookahead
    )
    while len(_KNOWN) >= MOST:
        _KNOWN.pop(next(iter(_KNOWN)))
    _KNOWN[id(program), configuration, tick, final_tick] = (program, found)
    return found


def _obstacles(configuration: ReactorConfiguration) -> Found | None:
    """Settings under which the general engine does what no register code says."""
    reasons = []
    if configuration.early:
        reasons.append(ChoiceReason(FreeChoice.EARLY, ", ".join(configuration.early), None))
    if configuration.max_steps is not None or configuration.max_depth is not None:
        reasons.append(ChoiceReason(FreeChoice.LIMITED, configuration.name, None))
    return (None, tuple(reasons)) if reasons else None
