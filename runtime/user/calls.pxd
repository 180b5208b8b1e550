# The C types of `calls.py`.


cdef class CallSlot:
    cdef public object call, box

    cpdef object begin(self, tuple call)

    cpdef object end(self, call, before)
