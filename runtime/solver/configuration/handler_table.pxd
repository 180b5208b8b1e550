# The C types of `handler_table.py`.


cdef long long FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_INFINITE, FILTER_NOT_SINGLETON, NONE, ORDER_KEY
cdef long long PREFER_EARLIEST, _FEW, ROLE_GLOBAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN, _ROLE_RESOURCE, _UNKNOWN


cdef class HandlerTable:
    cdef public object matching, database, program
    cdef public long long managers, handlers, heaps
    cdef public long long[::1] manager_kind, filter_first, filter_count, filter_code, filter_policy, first_handler
    cdef public long long[::1] handler_count, handler_of, heap_of, kind_of_predicate, handler_code, handler_most
    cdef public long long[::1] handler_choice, token_order, handler_constraint, handler_iterate, pairs_by_default
    cdef public long long[::1] resource_order, resource_orders, prefers_earliest, handler_guards, manager_heap
    cdef public long long[::1] manager_heaps, token_rows, variable_rows
    cdef public bint by_predicate
    cdef public dict rows, kinds, other_rows
    cdef public list kind_texts
    cdef public double[::1] handler_priority, heap_priority

    cpdef long long token_kind(
        self, long long predicate, long long parent, long long relation, long long label, bint rejectable
    ) except? -1

    @cython.locals(at="long long")
    cpdef long long token_row(self, long long manager, long long kind) except? -1

    @cython.locals(at="long long")
    cpdef long long variable_row(self, long long manager, long long kind, long long number) except? -1

    cpdef long long resource_row(self, long long manager, long long owner) except? -1

    @cython.locals(key="long long")
    cpdef long long other_row(self, long long role, long long manager, long long owner, long long name) except? -1

    cpdef long long _match(self, long long role, long long manager, long long owner, long long name) except? -1
