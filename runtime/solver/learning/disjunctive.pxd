# The C types of `disjunctive.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.agenda cimport Agenda

cdef long long DURATION, END, FILTER_HORIZON, HALF_INF, HEAD_THREAT, INITIAL, KIND_FLOAT, LISTS, LIST_ORDER
cdef long long LIST_THREAT, MINIMUM, _MOST_STARTS, NONE, OBJECT, POLICY_PARTIAL, _PRIME, SIDE_LOWER, START, THREAT, TOO_TIGHT


cdef class Disjunctive:
    cdef public Agenda agenda
    cdef public Rows rows
    cdef public Engine engine
    cdef public long long one, zero, count, stamp, found_start, found_end
    cdef public long long[::1] token, start, end, length, known, stamped

    cpdef bint fit(self) except -1

    cpdef bint _must_be_ordered_on(self, long long t, long long o) except -1

    cpdef bint _must_be_ordered(self, long long t) except -1

    cpdef bint _fit_on(self, long long o) except -1

    cpdef int _add(self, long long t) except -1

    cpdef long long _hash(self) except? -1

    cpdef bint _find_window(self) except -1

    @cython.locals(k="long long", spare="long long", t="long long", v="long long")
    cpdef bint _refuse(self, long long o) except -1
