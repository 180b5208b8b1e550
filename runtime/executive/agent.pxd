# The C types of `agent.py`.

cimport cython
from runtime.executive.clocks cimport FastClock
from runtime.executive.reactor cimport TeleoReactor
from runtime.executive.trace cimport Trace


cdef class Agent:
    cdef public FastClock clock
    cdef public object configuration, poster
    cdef public Trace trace
    cdef public bint every_tick
    cdef public list reactors, ahead, awake, killed, stirred
    cdef public dict owners, users, senders, takers, made
    cdef public object seed
    cdef public long long tick, posts_at, last_place
    cdef public double last_urgency

    @cython.locals(final_tick="long long", last="long long", visits="long long")
    cpdef object run(self, object until=*)

    @cython.locals(reactor=TeleoReactor, soonest="long long", tick="long long")
    cpdef object _advance(self, long long last)

    @cython.locals(reactor=TeleoReactor, tick="long long")
    cpdef object _pass_over(self)

    @cython.locals(is_last=bint, later=TeleoReactor, reactor=TeleoReactor)
    cpdef object _synchronise(self)

    cpdef object _synchronise_one(self, TeleoReactor reactor)

    @cython.locals(reactor=TeleoReactor)
    cpdef object _publish(self, list observations)

    @cython.locals(busy=list, reactor=TeleoReactor, urgency=double)
    cpdef object _deliberate(self)

    @cython.locals(has_more=bint, made="long long")
    cpdef bint _step(self, TeleoReactor reactor) except -1

    @cython.locals(first=TeleoReactor, k="long long", most=double, reactor=TeleoReactor, urgency=double)
    cpdef TeleoReactor _most_urgent(self, list busy)

    cpdef object _post_goals(self, list busy)

    cpdef object _dispatch(self, TeleoReactor reactor, list busy)

    cpdef object _ask(self, request, list busy)

    cpdef object _recall(self, number, list busy)

    cpdef bint _is_later(self, double urgency, long long place) except -1

    @cython.locals(sender=TeleoReactor)
    cpdef object _rouse(self, refusal, list busy)

    cpdef object _tell_refusals(self, list refusals)

    cpdef object _wake(self, TeleoReactor reactor, list busy)
