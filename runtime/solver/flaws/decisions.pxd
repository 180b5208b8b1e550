# The C types of `decisions.py`.

from runtime.solver.flaws.agenda cimport Agenda

cdef long long EVERYTHING, NONE


cdef class Decisions:
    cdef public long long depth, pool_used, reason_used, reason_free
    cdef public long long[::1] kind, manager, item, handler, instant, is_low, tries, phase, cursor, mark, rows_seen
    cdef public long long[::1] engine_seen, dropped, dynamic, pool_first, pool_count, pool_object, pool_before
    cdef public long long[::1] pool_after, reasons, is_local, reason_level, reason_next
    cdef public dict lists

    cpdef long long open(self, Agenda agenda, long long mark) except? -1

    cpdef int close(self, long long d) except -1

    cpdef int clear(self) except -1

    cpdef int choose(self, long long d, long long cursor) except -1

    cpdef int next_phase(self, long long d) except -1

    cpdef int begin_pool(self, long long d) except -1

    cpdef int drop_pool(self, long long d) except -1

    cpdef int add_to_pool(self, long long d, long long o, long long before, long long after) except -1

    cpdef int reverse_pool(self, long long first, long long end) except -1

    cpdef int add_reason(self, long long d, long long level) except -1

    cpdef int drop_reasons(self, long long d) except -1

    cpdef int rest_on_everything(self, long long d) except -1
