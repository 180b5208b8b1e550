# The C types of `reach.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long APART, MOST_NEAR, MODE_DISTANCE, REACHED, UNKNOWN


@cython.final
cdef class Reach:
    cdef public Store engine
    cdef public bint temporal_only, is_forward
    cdef public long long origin, most, stamp, length, room
    cdef public long long near_stamp
    cdef public long long[::1] stamped, distance, key, item, near, near_distance, near_stamped

    cpdef int begin(self, long long origin, bint is_forward) except -1

    @cython.locals(begin="long long", end="long long", engine=Store, limit="long long", near="long long")
    cpdef bint is_apart(self, long long other) except -1

    @cython.locals(begin="long long", end="long long", engine=Store)
    cpdef bint is_plain(self, long long other) except -1

    @cython.locals(
        at="long long", count="long long", down="long long", e="long long", engine=Store, high="long long",
        is_shorter=bint, length="long long", low="long long", u="long long", up="long long", v="long long"
    )
    cpdef int probe(self, long long other) except -1

    @cython.locals(room="long long")
    cpdef int restart(self, long long most) except -1

    @cython.locals(
        e="long long", engine=Store, high="long long", length="long long", longer="long long", u="long long", v="long long"
    )
    cpdef int follow_out(self) except -1

    @cython.locals(
        e="long long", engine=Store, high="long long", length="long long", longer="long long", u="long long", v="long long"
    )
    cpdef int follow_in(self) except -1

    @cython.locals(c="long long")
    cpdef bint is_known(self, long long e) except -1

    @cython.locals(above="long long", at="long long")
    cpdef int push(self, long long key, long long v) except -1

    @cython.locals(at="long long", below="long long", key="long long", last="long long", v="long long")
    cpdef int pop(self) except -1
