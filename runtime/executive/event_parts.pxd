# The C types of `event_parts.py`.

cimport cython


cdef class EventRun:
    cdef public object columns
    cdef public long long first, count


cdef class EventParts:
    cdef public list all_parts, starts
    cdef public long long length

    cpdef long long append(self, event) except? -1

    @cython.locals(run=EventRun)
    cpdef object extend(self, columns, long long index, long long count)
