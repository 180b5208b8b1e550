# The C types of `publish.py`.

cimport cython
from runtime.determined.arguments cimport arguments_at, shapes_of, values_at
from runtime.determined.log cimport Log
from runtime.determined.machine cimport Machine
from runtime.executive.messages cimport Observation, make_observation
from runtime.executive.trace cimport Trace

cdef long long BLOCK, EVENT, FAR, KIND, LINE, ROW, VALUES, WISHED, _NOTHING


cpdef long long row_key(long long tick) except? -1


cdef class Samples:
    cdef public list parameters
    cdef public object drawn
    cdef public dict draws

    cpdef bint draw(self, Machine machine, long long parameter, long long tick) except -1


cdef class Publisher:
    cdef public str name
    cdef public object program, columns
    cdef public Trace trace
    cdef public Samples samples
    cdef public Log log
    cdef public dict asked, symbols
    cdef public list wishes, line_names, short_names, shapes, names
    cdef public long long busy

    @cython.locals(log=Log, first="long long", count="long long", trace=Trace)
    cpdef list tell(self, long long until, long long watched)

    cpdef object look(self)

    @cython.locals(found=list, log=Log, index="long long")
    cpdef list _seen(self, long long tick, long long watched)

    @cython.locals(at="long long", log=Log, tick="long long")
    cpdef Observation _observation(self, long long row)

    @cython.locals(predicate="long long", shapes=list)
    cpdef list shapes_of(self, long long token)

    cpdef tuple arguments_of(self, long long token)

    cpdef list values_of(self, long long token)

    cpdef object _name_all(self)

    @cython.locals(log=Log, rows=dict)
    cpdef object _tell_tick(self, long long tick)

    @cython.locals(log=Log)
    cpdef object _tell_draws(self, long long tick)

    cpdef object _tell_achieved(self, dict rows, long long tick)

    cpdef object _answered(self, long long line, long long block, long long tick)
