# The C types of `machine.py`.

cimport cython
from libc cimport math
from runtime.determined.log cimport Log
from runtime.determined.present cimport Present

cdef long long CHANGES, DUE, ENDING, FOLLOWER, LEAST, MOST, NONE, OWNER, PREDICATE, ROW, RUNS_ON, STOPS, WISHED
cdef long long WISH, WISH_END_FROM, WISH_END_UNTIL, WISH_FROM, WISH_LEAST, WISH_MOST
cdef double _LARGEST, _NAN, _TOLERANCE


cdef class Machine:
    cdef public long long lines, root_row, why
    cdef public bint is_planned, is_trial, shows
    cdef public object world
    cdef public Present present
    cdef public Log log
    cdef public double[::1] registers, kept, sample_value, kept_value
    cdef public long long[::1] current, following, incoming, wished, previous, remembers, starts, width, default_block, order, shown, shown_first
    cdef public long long[::1] block_start, block_predicate, block_mask, sample_until, kept_until
    cdef public int[::1] code

    cpdef int keep(self) except -1

    cpdef int go_back(self) except -1

    cpdef long long run(self, long long tick, long long limit, long long watched) except? -1

    cpdef bint tick(self, long long tick) except -1

    @cython.locals(i="long long", k="long long")
    cpdef bint start_all(self, long long tick) except -1

    @cython.locals(r="double[::1]")
    cpdef bint start_block(self, long long i, long long tick) except -1

    cpdef bint can_start(self, long long i, long long tick) except -1

    @cython.locals(r="double[::1]", into="long long")
    cpdef int start(self, long long i, long long predicate) except -1

    @cython.locals(out="long long", a="long long", b="long long", j="long long", z="double")
    cpdef bint carry_out(self, long long at) except -1

    @cython.locals(block="long long", bound="long long", holds="bint", value="double")
    cpdef bint arrange(self, long long op, long long line, long long a, long long b, long long at) except -1
