# The C types of `deferral.py`.

cimport cython
from runtime.executive.messages cimport Observation
from runtime.executive.past cimport Past
from runtime.executive.timelines cimport TimelineState
from runtime.executive.workbench cimport Workbench
from runtime.plan.store.rows cimport Rows

cdef long long NOTHING, SPAN_EXECUTIVE, SPAN_OBSERVATION
cdef double inf


cdef class Deferral:
    cdef public Workbench bench
    cdef public dict lines, waiting, _is_loose, _is_plain, _kinds, _shapes
    cdef public list passed
    cdef public Past past

    @cython.locals(line=TimelineState, predicate="long long")
    cpdef bint takes(self, Observation observation) except -1

    @cython.locals(bench=Workbench, fact="long long", holds=bint, tick="long long")
    cpdef int _observe(self, TimelineState line, Observation observation, long long end) except -1

    @cython.locals(begun=object, predicate="long long", rows=Rows, values=list)
    cpdef object _pass(self, TimelineState line, Observation observation, long long end)

    @cython.locals(k="long long", kinds=list, shapes=list)
    cpdef bint _fits(self, long long predicate, Observation observation) except -1
