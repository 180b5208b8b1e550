# The C types of `crowds.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.agenda cimport Queues
from runtime.solver.configuration.handler_table cimport Treatments

cdef long long DURATION, END, FILTER_HORIZON, HALF_INF, HEAD_THREAT, INITIAL, KIND_FLOAT, LISTS, LIST_ORDER
cdef long long LIST_THREAT, MINIMUM, MOST_STARTS, NONE, OBJECT, POLICY_PARTIAL, PRIME, SIDE_LOWER, START, THREAT, TOO_TIGHT


cdef class Crowds:
    cdef public Queues queues
    cdef public Rows rows
    cdef public Engine engine
    cdef public long long one, zero, room, count, stamp, found_start, found_end
    cdef public long long[::1] token, start, end, length, known, stamped

    @cython.locals(o="long long", q=Queues, t="long long")
    cpdef bint fit(self) except -1

    cpdef bint is_waiting_for(self, long long t, long long o) except -1

    @cython.locals(
        f="long long", first="long long", is_plain=bint, manager="long long", q=Queues, row="long long",
        treatments=Treatments
    )
    cpdef bint must_be_ordered(self, long long t) except -1

    @cython.locals(t="long long", total="long long")
    cpdef bint fit_on(self, long long o) except -1

    @cython.locals(at="long long", end="long long", engine=Engine, first="long long", start="long long")
    cpdef long long add(self, long long t) except? -1

    @cython.locals(k="long long", total="long long")
    cpdef long long sum(self) except? -1

    @cython.locals(
        end="long long", first="long long", i="long long", k="long long", most="long long", needed="long long",
        start="long long"
    )
    cpdef bint find_window(self) except -1

    @cython.locals(engine=Engine, inside=list, k="long long", spare="long long", t="long long", v="long long", variables=list)
    cpdef bint refuse(self, long long o) except -1
