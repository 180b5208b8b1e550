# The C types of `decisions.py`.

cimport cython
from runtime.solver.flaws.agenda cimport Agenda

cdef long long EVERYTHING, NONE


cdef class Decisions:
    cdef public object room
    cdef public long long depth, pool_used, reason_used, reason_free
    cdef public long long[::1] kind, manager, item, handler, instant, is_low, tries, phase, cursor, mark, rows_seen
    cdef public long long[::1] engine_seen, dropped, dynamic, pool_first, pool_count, pool_object, pool_before
    cdef public long long[::1] pool_after, reasons, is_local, reason_level, reason_next
    cdef public dict lists

    @cython.locals(d="long long")
    cpdef long long open(self, Agenda agenda, long long mark) except? -1

    cpdef long long close(self, long long d) except? -1

    cpdef int clear(self) except -1

    @cython.locals(room="long long")
    cpdef long long _grow(self) except? -1

    cpdef long long choose(self, long long d, long long cursor) except? -1

    cpdef long long next_phase(self, long long d) except? -1

    cpdef long long begin_pool(self, long long d) except? -1

    cpdef long long drop_pool(self, long long d) except? -1

    @cython.locals(last="long long")
    cpdef long long reverse_pool(self, long long first, long long end) except? -1

    @cython.locals(at="long long")
    cpdef long long add_to_pool(self, long long d, long long o, long long before, long long after) except? -1

    @cython.locals(reason="long long")
    cpdef long long add_reason(self, long long d, long long level) except? -1

    @cython.locals(after="long long", reason="long long")
    cpdef long long drop_reasons(self, long long d) except? -1

    cpdef long long rest_on_everything(self, long long d) except? -1
