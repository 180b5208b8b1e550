# The C types of `publish.py`.

cimport cython
from runtime.determined.arguments cimport arguments_at, shapes_of
from runtime.determined.log cimport Log
from runtime.determined.machine cimport Machine

cdef long long BLOCK, EVENT, FAR, KIND, LINE, ROW, VALUES, WISHED, _NOTHING


cpdef long long row_key(long long tick) except? -1


cdef class Samples:
    cdef public list parameters
    cdef public object drawn
    cdef public dict draws

    cpdef bint draw(self, Machine machine, long long parameter, long long tick) except -1


cdef class Publisher:
    cdef public str name
    cdef public object program, trace, columns
    cdef public Samples samples
    cdef public Log log
    cdef public dict asked, symbols
    cdef public list wishes, line_names, short_names, shapes, names
    cdef public long long busy

    @cython.locals(log=Log, first="long long", count="long long")
    cpdef list tell(self, long long until, long long watched)

    cpdef object look(self)

    @cython.locals(found=list, log=Log, index="long long")
    cpdef list _seen(self, long long tick, long long watched)

    @cython.locals(at="long long", log=Log, predicate="long long", shapes=list, tick="long long")
    cpdef object _observation(self, long long row)

    @cython.locals(log=Log, rows=dict)
    cpdef object _tell_tick(self, long long tick)

    @cython.locals(log=Log)
    cpdef object _tell_draws(self, long long tick)

    cpdef object _tell_achieved(self, dict rows, long long tick)

    cpdef object _answered(self, long long line, long long block, long long tick)
