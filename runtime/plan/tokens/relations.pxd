# The C types of `relations.py`.

cimport cython
from runtime.plan.store.scopes cimport between
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long DURATION, DURATION_EQUAL, DURATION_ORIGIN_SHORTER, DURATION_TARGET_SHORTER, INFINITY, RELATION_CELLS


@cython.locals(
    a="long long", b="long long", cell="long long", earlier="long long", given="long long", holds=bint,
    k="long long", later="long long", lower="long long", position="long long", rows=Rows, rule="long long",
    upper="long long"
)
cpdef bint relate(
    Plan plan, long long scope, long long relation, long long origin, long long target, long long at, long long span
) except -1
