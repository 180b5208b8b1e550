# The C types of `trace.py`.


cdef class Trace:
    cdef public object events, phase, tell_on
    cdef public list draws
    cdef public long long tick
    cdef public dict _drawn
