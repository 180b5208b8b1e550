# The C types of `uses.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.envelope cimport Envelope
from runtime.plan.lifecycle cimport fire
from runtime.plan.store.plan cimport Plan
from runtime.plan.resources.resources cimport Resources
from runtime.constraints.stn.distances cimport Distances
from runtime.constraints.stn.heap cimport Heap

cdef long long INITIAL, LIMITS, MAXIMUM, MINIMUM, NONE
cdef double FLOAT_TOLERANCE, inf


cdef class Uses:
    cdef public Plan plan
    cdef public Engine engine
    cdef public Resources resources
    cdef public Distances distances
    cdef public long long[::1] point, takes
    cdef public Envelope envelope
    cdef public Heap events
    cdef public long long found_at, found_low, count
    cdef public double found_amount
    cdef public double[::1] amount_least, amount_most

    cpdef long long gather(self, long long o) except? -1

    cpdef int add(self, long long point, long long takes, double least, double most) except -1

    cpdef bint find_flaw(self, long long o, bint is_worst) except -1

    @cython.locals(
        capacity_high="double", capacity_low="double", amount="double", high="double", k="long long", low="double",
        lower="double", upper="double"
    )
    cpdef bint _sweep(self, long long o, bint is_worst) except -1

    cpdef bint may_order(self, long long o, long long first, long long second) except -1

    cpdef bint _is_seen(self, long long first, long long second) except -1

    cpdef bint order(self, long long first, long long second, long long together) except -1
