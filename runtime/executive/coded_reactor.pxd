# The C types of `coded_reactor.py`.

cimport cython
from runtime.executive.reactor cimport TeleoReactor
from runtime.user.reactor cimport Now

cdef long long _NEVER


cdef class CodedReactor(TeleoReactor):
    cdef public tuple files, wakes_on
    cdef public bint is_stirred
    cdef public long long count
    cdef public object caller, make, kinds, trace, code, wakes, wake
    cdef public dict seen, events, news, numbers
    cdef public list refused_numbers, published, asked, recalled, given_up

    cpdef long long next_tick(self, long long tick) except? -1

    cpdef object notify(self, observation)

    @cython.locals(arguments=dict, now=Now, told=list)
    cpdef object synchronise(self, long long tick)

    cpdef object _call(self, Now now)

    cpdef object _take(self, Now now)

    cpdef list observations(self, long long tick)

    cpdef list requests(self, long long tick)

    cpdef list recalls(self)

    cpdef list refusals(self)
