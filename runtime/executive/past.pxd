# The C types of `past.py`.

cimport cython
from runtime.executive.workbench cimport Workbench
from runtime.plan.lifecycle cimport fire
from runtime.plan.store.plan cimport Plan
from runtime.plan.tokens.predicate_hierarchy cimport active_head, first_active, next_active
from runtime.plan.tokens.tokens cimport activation

cdef long long SPAN_OBSERVATION, _MOST
cdef double inf


cdef class Past:
    cdef public Workbench bench
    cdef public tuple predicates
    cdef public list _gone
    cdef public long long _tick
    cdef public dict _kept

    cpdef long long archive(self, list timelines, long long tick) except? -1

    @cython.locals(t="long long")
    cpdef list outlines(self, long long tick)

    @cython.locals(bench=Workbench, t="long long")
    cpdef list uses(self, long long tick)

    @cython.locals(bench=Workbench, found=dict, o="long long", predicate="long long", t="long long")
    cpdef list _found(self, long long tick, set heads=*)

    @cython.locals(bench=Workbench, end=double, start=double)
    cpdef object _outline(self, long long t)

    @cython.locals(bench=Workbench)
    cpdef int keep(self, outlines) except -1

    @cython.locals(bench=Workbench, holds=bint, mark="long long", t="long long")
    cpdef int put_back(self, one) except -1

    @cython.locals(holds=bint, plan=Plan, t="long long")
    cpdef bint put_back_uses(self, uses) except -1

    @cython.locals(bench=Workbench, holds=bint, is_active=bint, plan=Plan, t="long long", waiting="long long")
    cpdef long long _made(self, one) except? -1

    @cython.locals(bench=Workbench, key="long long", line=list, oldest="long long")
    cpdef int _forget_oldest(self, long long t, one) except -1
