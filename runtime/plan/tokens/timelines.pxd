# The C types of `timelines.py`.

from runtime.plan.store.scopes cimport equate
from runtime.plan.store.links cimport link, link_by_key, unlink
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long END, HEAD_THREAT, LISTS, LIST_ORDER, LIST_THREAT, NONE, OBJECT, START


cpdef bint order(Plan plan, long long o, long long before, long long after, long long span) except -1


cpdef int _insert(Plan plan, long long o, long long t, long long previous, long long span) except -1


cpdef int _fix_object(Plan plan, long long o, long long t, long long span) except -1


cpdef bint _is_sequenced(Rows rows, long long t) except -1


cpdef int _pair(Plan plan, long long first, long long second, long long span) except -1


cpdef bint has_pair(Rows rows, long long first, long long second) except -1



cpdef int leave_sequence(Plan plan, long long t, list edges, long long span) except -1


cpdef bint has_any_pair(Rows rows, long long t) except -1


cpdef int await_order(Plan plan, long long t) except -1


cpdef bint assign_object(Plan plan, long long o, long long t, long long span) except -1
