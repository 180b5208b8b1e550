# The C types of `lasting.py`.

cimport cython
from runtime.executive.dispatch cimport Dispatch
from runtime.executive.timelines cimport TimelineState
from runtime.executive.workbench cimport Workbench

cdef long long NOTHING, SPAN_EXECUTIVE, SPAN_OBSERVATION


@cython.locals(mark="long long")
cpdef object last_until(Workbench bench, list timelines, long long tick)


@cython.locals(line=TimelineState, span="long long")
cpdef object go_on(Workbench bench, list timelines, long long tick)


@cython.locals(following="long long", line=TimelineState)
cpdef object persist(Workbench bench, list timelines, long long tick, Dispatch asked)
