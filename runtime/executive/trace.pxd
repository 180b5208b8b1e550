# The C types of `trace.py`.

from runtime.executive.event_parts cimport EventParts

cdef class Trace:
    cdef public EventParts events
    cdef public object phase, tell_on
    cdef public list draws
    cdef public long long tick
    cdef public dict _drawn
