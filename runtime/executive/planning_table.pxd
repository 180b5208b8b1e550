# The C types of `planning_table.py`.

cimport cython
from runtime.plan.store.rows cimport Rows
from runtime.solver.configuration.handler_table cimport HandlerTable

cdef long long FLAG_REJECTABLE, INACTIVE, LISTS, LIST_THREAT, NONE


cdef class LeftOut:
    cdef public Rows rows
    cdef public bint is_empty
    cdef public HandlerTable table

    @cython.locals(
        asker="long long", is_open=bint, kind="long long", parent="long long", rejectable=bint, rows=Rows
    )
    cpdef bint has(self, long long t) except -1
