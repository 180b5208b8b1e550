# The C types of `reactor.py`.

cdef long long _NEVER


cdef class TeleoReactor:
    cdef public str name
    cdef public tuple internal, external
    cdef public list lacking
    cdef public long long latency, lookahead, due, missed, decisions_made, place
    cdef public bint is_metered, runs_ahead

    cpdef long long untold(self) except? -1

    cpdef object pass_over(self, long long tick)

    cpdef object start_tick(self, long long tick)

    cpdef long long next_tick(self, long long tick) except? -1

    cpdef object notify(self, observation)

    cpdef object synchronise(self, long long tick)

    cpdef list observations(self, long long tick)

    cpdef double urgency(self, long long tick) except? -1.0

    cpdef bint step(self, long long tick) except -1

    cpdef bint has_work(self, long long tick) except -1

    cpdef object halt(self)

    cpdef object failure(self)

    cpdef list requests(self, long long tick)

    cpdef bint has_turns(self) except -1

    cpdef list recalls(self)

    cpdef list refusals(self)
