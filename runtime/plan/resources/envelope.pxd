# The C types of `envelope.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.profile cimport Profile
from runtime.plan.resources.resources cimport Resources

cdef long long NONE, _ROOM, SIDE_LOWER, SIDE_UPPER
cdef double FLOAT_TOLERANCE


cdef class Envelope:
    cdef public Engine engine
    cdef public Resources resources
    cdef public Profile profile
    cdef public long long resource, at, is_low, mark
    cdef public long long use_room
    cdef public bint grounded
    cdef public double amount
    cdef public long long[::1] marks, stack, via, takes, gives
    cdef public long long[::1] instants, from_taker, from_giver, queue
    cdef public long long[::1] shut_givers, shut_takers
    cdef public long long[::1] ordered
    cdef public double[::1] supply, demand, flow

    cpdef bint find(self, long long o) except -1

    cpdef bint find_certain(self, long long o) except -1

    cpdef bint _envelope_is_outside(self, long long sign) except -1

    cpdef double change(self, long long sign) except? -1.0

    cpdef bint _find_side(self, long long o, long long is_low) except -1

    @cython.locals(count="long long", j="long long", k="long long", sign="long long")
    cpdef long long _collect_instants(self) except? -1

    @cython.locals(known=bint, taker="long long")
    cpdef int prepare(self) except -1

    cpdef int make_room(self, long long n) except -1

    @cython.locals(e="long long", top="long long", u="long long")
    cpdef int walk_back(self, long long v) except -1

    cpdef double _given_back(self, double enough) except? -1.0

    @cython.locals(first="long long", last="long long")
    cpdef double _augment(self, long long source) except? -1.0

    cpdef double push(self, long long source, long long giver) except? -1.0

    cpdef int note_orders(self, list edges, list read) except -1
