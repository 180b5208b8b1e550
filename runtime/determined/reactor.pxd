# The C types of `reactor.py`.

cimport cython
from runtime.determined.machine cimport Machine
from runtime.determined.publish cimport Publisher
from runtime.executive.reactor cimport TeleoReactor

cdef long long FAR, LINE, NONE, ROW, STOPS, _AHEAD


cdef class DeterminedReactor(TeleoReactor):
    cdef public long long final_tick, watched, execution_latency, tick, reached, base, witnessed
    cdef public object program, make_general, trace, inputs, general, witness
    cdef public list wishes, refused_goals, refusals_made
    cdef public Machine machine
    cdef public Publisher publisher
    cdef public dict numbers, news, windows
    cdef public bint is_beyond

    cpdef object start_tick(self, long long tick)

    cpdef object notify(self, observation)

    cpdef object failure(self)

    cpdef object synchronise(self, long long tick)

    cpdef bint _carry_out(self, long long tick) except -1

    cpdef object _return_to(self, long long tick)

    cpdef object _forget_ahead(self, long long tick)

    cpdef list observations(self, long long tick)

    cpdef long long untold(self) except? -1

    cpdef object pass_over(self, long long tick)

    cpdef double urgency(self, long long tick) except? -1.0

    @cython.locals(limit="long long", machine=Machine, publisher=Publisher, watched="long long")
    cpdef bint step(self, long long tick) except -1

    cpdef object _take_requests(self, long long tick)

    cpdef bint _is_open(self, long long tick) except -1

    cpdef bint _comes_last(self, wish, long long tick) except -1

    cpdef long long next_tick(self, long long tick) except? -1

    cpdef list refusals(self)

    cpdef list requests(self, long long tick)

    cpdef list recalls(self)
