"""A process in, the processor time that it has used out: what hardly depends on how busy the machine is."""

import sys
import time

PATIENCE = 5.0  # how many times as long as of the processor work may take by the clock
_OF_PROCESS = 2  # Linux: the clock of a process has the complement of its number and this kind in its own


def processor_seconds(pid: int) -> float | None:
    """User and system time of a process that runs; None where the system does not tell, or it has ended."""
    if sys.platform != "linux":
        return None
    try:
        return time.clock_gettime(((~pid) << 3) | _OF_PROCESS)
    except OSError:
        return None
