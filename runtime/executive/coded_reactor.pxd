# The C types of `coded_reactor.py`.

cimport cython

cdef long long _NEVER


cdef class CodedReactor:
    cdef public str name
    cdef public tuple internal, external, files, wakes_on
    cdef public bint is_stirred
    cdef public long long latency, lookahead, due, count
    cdef public object caller, make, kinds, trace, code, wakes, wake
    cdef public dict seen, events, news, numbers
    cdef public list refused_numbers, published, asked, recalled, given_up

    cpdef long long untold(self) except? -1

    cpdef object pass_over(self, long long tick)

    cpdef object start_tick(self, long long tick)

    cpdef object next_tick(self, long long tick)

    cpdef object notify(self, observation)

    @cython.locals(arguments=dict, told=list)
    cpdef object synchronise(self, long long tick)

    cpdef object _call(self, now)

    cpdef object _take(self, now)

    cpdef list observations(self, long long tick)

    cpdef double urgency(self, long long tick) except? -1.0

    cpdef bint step(self, long long tick) except -1

    cpdef object failure(self)

    cpdef list requests(self, long long tick)

    cpdef list recalls(self)

    cpdef list refusals(self)
