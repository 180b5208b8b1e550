cimport cython


cdef long long NONE
cdef long long ORDER_KEY
cdef long long FILTER_HORIZON
cdef long long FILTER_HORIZON_VARIABLE
cdef long long FILTER_INFINITE
cdef long long FILTER_NOT_SINGLETON


cdef class Treatments:
    cdef public object matching
    cdef public object vocabulary
    cdef public long long managers
    cdef public long long handlers
    cdef public long long treatments
    cdef public long long heaps
    cdef public bint by_predicate
    cdef public long long[::1] manager_kind
    cdef public long long[::1] manager_heap
    cdef public long long[::1] manager_heaps
    cdef public double[::1] heap_priority
    cdef public long long[::1] handler_code
    cdef public double[::1] handler_priority
    cdef public long long[::1] handler_most
    cdef public long long[::1] handler_choice
    cdef public long long[::1] token_order
    cdef public long long[::1] handler_guards
    cdef public long long[::1] filter_first
    cdef public long long[::1] filter_count
    cdef public long long[::1] filter_code
    cdef public long long[::1] filter_policy
    cdef public long long[::1] first_handler
    cdef public long long[::1] handler_count
    cdef public long long[::1] handler_of
    cdef public long long[::1] heap_of
    cdef public dict rows
    cdef public dict kinds
    cdef public list kind_texts
    cdef public long long[::1] kind_of_predicate
    cdef public dict token_rows
    cdef public dict variable_rows

    cpdef long long token_kind(self, long long predicate, long long master, long long relation, long long label) except? -2
    cpdef long long token_row(self, long long manager, long long kind) except? -2
    cpdef long long variable_row(self, long long manager, long long kind, long long place) except? -2
    cpdef long long local_row(self, long long manager, long long kind, long long name) except? -2
    cpdef long long member_row(self, long long manager, long long owner, long long name) except? -2
    cpdef long long global_row(self, long long manager, long long name) except? -2
