# The C types of `timelines.py`.


cdef class TimelineState:
    cdef public str name
    cdef public long long object_id, default, current, event
    cdef public bint accepts_requests, is_internal, is_early, is_late
    cdef public dict predicates
    cdef public list others
    cdef public object news, source
    cdef public set planned


cdef class Goal:
    cdef public object request
    cdef public long long token, token_key, failed_starts
    cdef public bint is_closed, is_rejected, is_loose
