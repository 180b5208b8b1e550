# The C types of `profile.py`.

cimport cython

cdef long long _ROOM, TOO_FAST, TOO_HIGH, TOO_LOW, TOO_MUCH, TOO_TIGHT, HALF_INF, _MOST_WINDOWS
cdef double FLOAT_TOLERANCE, inf


cdef class Profile:
    cdef public long long count, wrong, at, until
    cdef public long long[::1] use, sign, lasting, start_low
    cdef public long long[::1] start_high, end_low, end_high, length
    cdef public double[::1] least, most
    cdef public double amount, initial_low, initial_high, minimum
    cdef public double maximum, rate, total, production_rate
    cdef public double production_total
    cdef public list limit_steps

    cpdef int set_limits(self, double initial_low, double initial_high, double minimum, double maximum) except -1

    cpdef int set_flows(self, double rate, double total, double production_rate, double production_total) except -1

    cpdef long long add(self, long long use, long long sign, long long lasting) except? -1

    @cython.locals(sign="long long")
    cpdef int add_step(self, long long start, double least, double most) except -1

    cpdef double best_for_consumers(self, long long t) except? -1.0

    cpdef double worst_for_consumers(self, long long t) except? -1.0

    cpdef double grounded(self, long long t) except? -1.0

    @cython.locals(signs="long long")
    cpdef bint flows_both_ways(self) except -1

    cpdef long long violation(self) except? -1

    cpdef long long _level_violation(self) except? -1

    @cython.locals(t="long long")
    cpdef long long _violation_of_steps(self) except? -1

    cpdef long long _flow_violation(self) except? -1

    @cython.locals(same=bint)
    cpdef double _together(self, long long i) except? -1.0

    cpdef long long overload(self) except? -1

    cpdef bint _is_overloaded(self, long long start, long long end, double room) except -1

    cpdef long long share(self, long long k, long long start, long long end) except? -1
