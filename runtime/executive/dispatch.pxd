# The C types of `dispatch.py`.

cimport cython
from runtime.executive.holding cimport begin_together, due_start, follows_late, free_at, hangs_on_action, is_tied, keeps_next
from runtime.executive.timelines cimport TimelineState
from runtime.executive.view cimport whole_bound
from runtime.executive.workbench cimport Workbench

cdef long long FLAG_SENT, INFINITY, NOTHING


cdef class Dispatch:
    cdef public str name
    cdef public Workbench bench
    cdef public list timelines
    cdef public object trace
    cdef public dict owner_windows, sent, sent_tokens, refused, begun, over
    cdef public bint is_repaired

    cpdef bint is_asked(self, long long token) except -1

    cpdef bint is_refused(self, long long token) except -1

    cpdef int note_begun(self) except -1

    cpdef tuple refusals(self)

    @cython.locals(t="long long")
    cpdef bint is_cut_off(self, long long token) except -1

    cpdef long long notice(self, TimelineState line) except? -1

    cpdef bint takes_requests(self, TimelineState line) except -1

    @cython.locals(asked=list, line=TimelineState, token="long long")
    cpdef list requests(self, long long tick, long long final_tick)

    cpdef bint _is_due(self, TimelineState line, long long token, long long tick, long long final_tick) except -1

    @cython.locals(free=double, mate="long long", other=TimelineState)
    cpdef double _free_at(self, TimelineState line, long long token, long long tick) except? -1.0

    @cython.locals(bench=Workbench, free=double)
    cpdef double _freed_at(self, TimelineState line, long long token, long long tick) except? -1.0

    @cython.locals(time=double)
    cpdef double due_time(self, TimelineState line, long long token, long long tick) except? -1.0

    @cython.locals(token="long long")
    cpdef double next_due(self, TimelineState line, long long tick) except? -1.0

    @cython.locals(before="long long", bench=Workbench, token="long long")
    cpdef double _waits_until(self, TimelineState line, long long tick) except? -1.0

    cpdef long long open_now(self, TimelineState line) except? -1

    @cython.locals(before="long long", bench=Workbench, token="long long")
    cpdef long long next_request(self, TimelineState line) except? -1

    @cython.locals(bench=Workbench, other=TimelineState)
    cpdef object _ask(self, TimelineState line, long long token, long long tick)

    @cython.locals(bench=Workbench, earliest="long long", is_command=bint)
    cpdef object _bounds(self, str timeline, long long token, long long tick)

    cpdef list open_requests(self)

    @cython.locals(apart=list, numbers=list, token="long long")
    cpdef list recalls(self, long long tick)

    @cython.locals(apart=list, bench=Workbench, line=TimelineState, mate="long long", token="long long")
    cpdef list _come_apart(self, long long tick)

    @cython.locals(line=TimelineState, token="long long")
    cpdef bint _hand_on(self, request, long long key, long long tick) except -1

    @cython.locals(earliest="long long", first_end="long long")
    cpdef bint _is_as_asked(self, request, long long token, long long tick) except -1

    @cython.locals(bench=Workbench)
    cpdef bint _is_void(self, request, long long token, long long key, long long tick) except -1

    @cython.locals(line=TimelineState, other="long long")
    cpdef bint _is_overtaken(self, str timeline, long long token) except -1
