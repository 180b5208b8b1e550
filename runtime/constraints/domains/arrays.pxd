# The C types of `arrays.py`.

cimport cython


@cython.locals(is_lazy="bint")
cpdef object grown(object old, long long length, object fill=*)

cpdef int grow_rows(object owner, str names, long long length, object fill=*) except -1

cpdef long long next_room(long long room) except -1

cpdef long long next_log_room(long long room) except -1
