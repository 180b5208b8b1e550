# The C types of `resource_selection.py`.

cimport cython
from runtime.solver.flaws.agenda cimport Agenda

cdef long long NONE, PREFER_EARLIEST, PREFER_LATEST, PREFER_LEAST, PREFER_LOWER, PREFER_MOST, PREFER_UPPER
cdef long long RESOURCE_THREAT
cdef double BEST_PRIORITY


cpdef bint is_resource_managed(Agenda agenda, long long o) except -1


@cython.locals(is_rival=bint, takes_first=bint)
cpdef int select_resource(Agenda agenda, long long manager, bint is_last) except -1


cpdef bint _is_in_scope(Agenda agenda, long long row, long long o) except -1


cpdef bint _is_better(
    Agenda agenda, long long manager, long long other_at, long long other_low, double other_amount
) except -1
