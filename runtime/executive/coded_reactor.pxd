# The C types of `coded_reactor.py`.

cimport cython
from runtime.executive.messages cimport Observation, make_domain
from runtime.executive.reactor cimport TeleoReactor
from runtime.user.calls cimport CallSlot
from runtime.user.reactor cimport Now

cdef long long _NEVER
cdef dict _SYS


cdef class CodedReactor(TeleoReactor):
    cdef public tuple files, wakes_on
    cdef public bint is_stirred
    cdef public long long count
    cdef public CallSlot watch
    cdef public tuple call
    cdef public dict told_sets
    cdef public object folder, make, kinds, trace, code, wakes, wake, commands
    cdef public dict seen, events, news, numbers, told
    cdef public list refused_numbers, published, turns, given_up

    cpdef long long next_tick(self, long long tick) except? -1

    @cython.locals(news=Observation)
    cpdef object notify(self, observation)

    @cython.locals(arguments=dict, names=tuple, now=Now, observation=Observation, told=list)
    cpdef object synchronise(self, long long tick)

    cpdef object _call(self, Now now)

    cpdef object _take(self, Now now)

    cpdef list observations(self, long long tick)

    cpdef list requests(self, long long tick)

    cpdef double urgency(self, long long tick) except? -1.0

    cpdef bint has_turns(self) except -1

    cpdef list recalls(self)

    cpdef list refusals(self)


@cython.locals(found=dict, k="long long", shape=tuple, values=list)
cpdef dict _shown_arguments(Observation observation)

cpdef object _shown(domain)
