# The C types of `resource_resolvers.py`.

cimport cython
from runtime.solver.flaws.agenda cimport Agenda
from runtime.solver.flaws.decisions cimport Decisions

cdef long long APPLIED, CONCURRENT_FIRST, CONCURRENT_ONLY, CONSTRAINT_FIRST, FAILED_CHOICE, NONE, NO_CHOICE
cdef long long PRECEDES_FIRST


@cython.locals(by_default=bint, rounds="long long", together=bint)
cpdef long long mend_resource(Agenda agenda, Decisions stack, long long d) except? -1


@cython.locals(is_here=bint)
cpdef long long _mend_in_order_of_ids(Agenda agenda, Decisions stack, long long d) except? -1


@cython.locals(is_left=bint, taker="long long")
cpdef bint _add_useful_pairs(Agenda agenda, Decisions stack, long long d) except -1
