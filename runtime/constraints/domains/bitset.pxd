# The C types of `bitset.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long EVENT_HOLES, KIND_FLOAT, NEVER, TRAIL_HOLES, TRAIL_WORDS
cdef double FLOAT_TOLERANCE
cdef unsigned long long ALL_BITS, EVERY_SECOND_BIT, FOUR_OF_EIGHT_BITS, ONE_BIT, TWO_OF_FOUR_BITS


cpdef long long _lowest_bit(unsigned long long x) except? -1

cpdef long long _bits_in(unsigned long long x) except? -1

cpdef long long _highest_bit(unsigned long long x) except? -1

cpdef long long _allocate_words(Store s, long long count) except? -1

cpdef int _release_words(Store s, long long first, long long count) except -1

cpdef int attach_words(Store s, long long v, long long base, long long values) except -1

cpdef int detach_words(Store s, long long v) except -1

cpdef long long index_above(Store s, long long v, long long x) except? -1

cpdef long long index_below(Store s, long long v, long long x) except? -1

@cython.locals(first="long long", high="long long", low="long long", middle="long long")
cpdef long long table_index(Store s, long long v, double x) except? -1

cpdef long long next_index(Store s, long long v, long long index) except? -1

cpdef long long previous_index(Store s, long long v, long long index) except? -1

cpdef long long value_at(Store s, long long v, long long index) except? -1

cpdef long long next_value(Store s, long long v, long long x) except? -1

cpdef long long previous_value(Store s, long long v, long long x) except? -1

cpdef bint has_value(Store s, long long v, long long x) except -1

cpdef int clear_bits(Store s, long long v, long long k, unsigned long long mask, long long support) except -1

@cython.locals(entry="long long")
cpdef int restore_bits(Store s, long long v) except -1

@cython.locals(entry="long long")
cpdef int drop_log(Store s, long long v) except -1

@cython.locals(count="long long", k="long long")
cpdef int attach_table(Store s, long long v, list values) except -1

cpdef int _release_table(Store s, long long first, long long count) except -1

cpdef long long count_values(Store s, long long v) except? -1
