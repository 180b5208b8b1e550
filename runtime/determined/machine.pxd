# The C types of `machine.py`.

cimport cython
from libc cimport math
from runtime.determined.log cimport Log
from runtime.determined.present cimport Present
from runtime.determined.tables cimport CodeTables
from runtime.determined.trial cimport can_follow, comes_between, fits_within, holds, leaves_next

cdef long long BEFORE, CHANGES, DUE, ENDING, FOLLOWER, KIND, LINE, NONE, OWNER, PREDICATE, ROW
cdef long long RUNS_ON, SHOWN, STOPS, VALUES, WISHED, WISH, WISH_FROM
cdef double COARSE, _LARGEST, _NAN, _TOLERANCE


cdef class Machine:
    cdef public long long lines, root_row, why
    cdef public bint is_planned, is_trial, shows
    cdef public object world
    cdef public CodeTables tables
    cdef public Present present
    cdef public Log log
    cdef public double[::1] registers, kept, sample_value, kept_value
    cdef public long long[::1] sample_until, kept_until

    cpdef int keep(self) except -1

    cpdef int go_back(self) except -1

    cpdef long long run(self, long long tick, long long limit, long long watched) except? -1

    @cython.locals(tables=CodeTables, present=Present)
    cpdef bint tick(self, long long tick) except -1

    @cython.locals(i="long long", k="long long")
    cpdef bint start_all(self, long long tick) except -1

    @cython.locals(tables=CodeTables, present=Present, j="long long", mask="long long")
    cpdef bint start_block(self, long long i, long long tick) except -1

    @cython.locals(
        tables=CodeTables, log=Log, j="long long", row="long long", first="long long", width="long long", value="double"
    )
    cpdef bint write_down(self, long long block) except -1

    cpdef bint can_start(self, long long i, long long tick) except -1

    @cython.locals(j="long long", first="long long", into="long long")
    cpdef int start(self, long long i, long long predicate) except -1

    @cython.locals(
        tables=CodeTables, present=Present, out="long long", a="long long", b="long long", j="long long", x="double",
        y="double", z="double"
    )
    cpdef bint carry_out(self, long long at) except -1
