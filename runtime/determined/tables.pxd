# The C types of `tables.py`.

cdef long long NONE


cdef class CodeTables:
    cdef public long long[::1] current, following, incoming, wished, previous, remembers, starts, width, size
    cdef public long long[::1] default_block, order, shown, shown_first
    cdef public long long[::1] block_start, block_predicate, block_mask, block_sure, block_free
    cdef public int[::1] code
