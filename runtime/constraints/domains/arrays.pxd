# The C types of `arrays.py`.

cimport cython


@cython.locals(is_lazy="bint")
cpdef object grown(object old, long long length, object fill=*)

cpdef int grow_rows(object owner, str names, long long length, object fill=*) except -1

cpdef int lengthen(object owner, str zeros, str nones=*, long long need=*) except -1

cpdef long long _next_room(long long room) except -1

cpdef long long next_log_room(long long room) except -1
