# The C types of `agent.py`.

cimport cython


cdef class Agent:
    cdef public object configuration, poster, trace
    cdef public bint every_tick
    cdef public list reactors, ahead, awake, killed, stirred
    cdef public dict owners, users, senders, takers, made
    cdef public object seed
    cdef public long long tick

    @cython.locals(soonest="long long", tick="long long")
    cpdef object _advance(self, long long last)

    @cython.locals(tick="long long")
    cpdef object _pass_over(self)

    @cython.locals(is_last="bint")
    cpdef object _synchronise(self)

    cpdef object _synchronise_one(self, reactor)

    cpdef object _publish(self, list observations)

    @cython.locals(busy=list)
    cpdef object _deliberate(self)

    @cython.locals(most=double, urgency=double)
    cpdef object _most_urgent(self, list busy)

    cpdef object _post_goals(self, list busy)

    cpdef object _dispatch(self, reactor, list busy)

    cpdef object _ask(self, request, list busy)

    cpdef object _recall(self, number, list busy)

    cpdef object _tell_refusals(self, list refusals)

    cpdef object _wake(self, reactor, list busy)
