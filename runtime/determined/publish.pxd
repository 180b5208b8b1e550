# The C types of `publish.py`.

cimport cython
from runtime.determined.log cimport Log

cdef long long ROW, WISHED, _NOTHING


cdef class Publisher:
    cdef public str name
    cdef public object program, trace
    cdef public Log log
    cdef public dict draws, asked
    cdef public list wishes
    cdef public long long busy

    @cython.locals(log=Log, first="long long", count="long long")
    cpdef list tell(self, long long until, long long watched)

    cpdef object look(self)

    cpdef object event(self, long long place)

    @cython.locals(found=list, log=Log, place="long long")
    cpdef list _seen(self, long long tick, long long watched)

    cpdef object _observation(self, long long row)

    @cython.locals(log=Log, rows=dict)
    cpdef object _tell_tick(self, long long tick)

    @cython.locals(log=Log)
    cpdef object _tell_draws(self, long long tick)

    cpdef object _tell_achieved(self, dict rows, long long tick)

    cpdef object _answered(self, long long line, long long block, long long tick)
