# The C types of `goals.py`.

cimport cython
from runtime.executive.dispatch cimport Dispatch
from runtime.executive.timelines cimport Goal, TimelineState
from runtime.executive.workbench cimport Workbench

cdef long long NOTHING, SPAN_REQUEST


cdef class Goals:
    cdef public str name
    cdef public Workbench bench
    cdef public object trace, repair, wishes, cuts
    cdef public list timelines, waiting, posted, to_recall, refusals, lacking, loosened
    cdef public dict lines, rejections, given_up
    cdef public bint is_changed

    cpdef bint has_news(self, long long reach) except -1

    cpdef bint take_in(self, long long tick, long long reach) except -1

    @cython.locals(found=double, goal=Goal)
    cpdef double next_expiry(self) except? -1.0

    cpdef bint _may_come_back(self, Goal goal) except -1

    @cython.locals(goal=Goal, is_rejected=bint)
    cpdef object report_rejected(self, long long tick)

    @cython.locals(bench=Workbench, found=bint, goal=Goal, late=list, token="long long")
    cpdef bint close(self, long long tick, Dispatch asked) except -1

    @cython.locals(found=list, goal=Goal)
    cpdef list live(self)

    @cython.locals(goal=Goal)
    cpdef list answered(self, long long token)
