# The C types of `reactor.py`: one `Now` a visit; what users write stays Python.


cdef class Now:
    cdef public object tick, seen, news, refused, first_number, published, asked, recalled, wakes
    cdef public object commands, taken_back, declined, turns
