# The C types of `messages.py`.

cimport cython


cdef class Observation:
    cdef public long long tick, event, token, token_key
    cdef public str timeline, predicate, owner
    cdef public tuple given
    cdef public object source


cpdef object make_domain(str kind, str type_name, tuple interval, tuple values)


@cython.locals(told=Observation)
cpdef Observation make_observation(
    long long tick, str timeline, str predicate, source, long long event, str owner, long long token,
    long long token_key
)
