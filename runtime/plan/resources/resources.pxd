# The C types of `resources.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.profile cimport Profile

cdef long long INITIAL, LIMITS, MAXIMUM, MINIMUM, NONE, PRODUCTION_RATE, PRODUCTION_TOTAL, RATE, _ROOM, SIDE_LOWER
cdef long long SIDE_UPPER, TOO_HIGH, TOO_LOW, TOO_TIGHT, TOTAL
cdef double inf


cdef class Resources:
    cdef public Engine engine
    cdef public Profile profile
    cdef public long long count, grounded_text, pending
    cdef public list free, refusals, postponed
    cdef public object relief
    cdef public long long[::1] token, sign, holder, quantity
    cdef public long long[::1] start, end, duration, on, start_low
    cdef public long long[::1] start_high, end_low, end_high, is_resource, is_energetic
    cdef public long long[::1] profile_choice, changed, limits
    cdef public double[::1] least, most
    cdef public dict steps, limit_steps

    cpdef int add_resource(self, long long o, list limits, long long profile_choice) except -1

    cpdef bint is_grounded(self, long long o) except -1

    cpdef long long add_use(
        self, long long token, long long sign, long long holder, long long quantity, long long start, long long end,
        long long duration, long long level
    ) except? -1

    cpdef int remove_use(self, long long u) except -1

    cpdef int remove_token(self, long long t) except -1

    cpdef int truncate(self, long long count) except -1

    cpdef int set_capacity(self, long long o, long long start, double lower, double upper) except -1

    cpdef int set_limit(self, long long o, long long start, double lower, double upper) except -1

    cpdef bint is_quiet(self) except -1

    @cython.locals(by_order=bint, is_tight=bint)
    cpdef bint check(self, envelope, long long level) except -1

    cpdef bint _may_wait(self, long long o, long long is_low) except -1

    @cython.locals(o="long long")
    cpdef int resume(self) except -1

    cpdef list take_refusals(self)

    cpdef int fill(self, Profile profile, long long o) except -1

    cpdef double lower(self, long long row, double otherwise) except? -1.0

    cpdef double upper(self, long long row, double otherwise) except? -1.0

    @cython.locals(o="long long")
    cpdef int set_energetic(self, long long o, bint is_energetic) except -1

    cpdef bint refuse(self, long long o, long long level, envelope) except -1

    @cython.locals(harms="long long", is_certain=bint, t="long long")
    cpdef bint _note_read(self, violation, long long i, long long u, bint by_order) except -1
