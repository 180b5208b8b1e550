# The C types of `view.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.engine cimport Engine
from runtime.executive.recorder cimport Recorder
from runtime.executive.timelines cimport TimelineState
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.plan.tokens.predicate_hierarchy cimport is_kind_of

cdef long long ACTIVE, DURATION, END, FIRST_PARAMETER, FLAG_FACT, FLAG_GOAL, FREED, HEAD_OPEN, HEAD_THREAT, INACTIVE
cdef long long KIND_BOOL, KIND_FLOAT, KIND_INT, KIND_STRING, LISTS, LIST_OPEN, LIST_ORDER, LIST_THREAT, MERGED, NONE
cdef long long OBJECT, REJECTED, START
cdef double inf


cdef class PlanView:
    cdef public object database
    cdef public Plan plan
    cdef public Engine engine
    cdef public Rows rows
    cdef public str name
    cdef public dict predicates, parameters, globals, requested, due, moved, asked
    cdef public bint is_reactive
    cdef public set external_objects, internal_objects, late_objects
    cdef public Recorder recorder
    cdef public long long[::1] kept_key
    cdef public SparseSet met

    @cython.locals(o="long long")
    cpdef TimelineState timeline(self, str name, bint is_internal)

    cpdef str default_name(self, long long o)

    @cython.locals(k="long long")
    cpdef object _member(self, long long o, str name)

    cpdef bint accepts_requests(self, long long o) except -1

    cpdef str mode(self, long long o)

    cpdef object name_of(self, long long t)

    cpdef str predicate_name(self, long long predicate)

    cpdef str short_name(self, long long t)

    cpdef long long start(self, long long t) except? -1

    cpdef long long end(self, long long t) except? -1

    cpdef long long duration(self, long long t) except? -1

    cpdef double lower(self, long long v) except? -1.0

    cpdef double upper(self, long long v) except? -1.0

    @cython.locals(first="long long", found=list, k="long long")
    cpdef tuple arguments(self, long long t)

    @cython.locals(engine=Engine, lower=double, shape="long long", single=bint, upper=double)
    cpdef object domain(self, long long v, str kind, str type_name)

    cpdef long long key(self, long long t) except? -1

    cpdef bint is_alive(self, long long t, long long key) except -1

    cpdef bint is_freed(self, long long t) except -1

    cpdef bint is_fact(self, long long t) except -1

    cpdef bint is_active(self, long long t) except -1

    cpdef bint is_goal(self, long long t) except -1

    cpdef bint is_merged(self, long long t) except -1

    cpdef bint is_rejected(self, long long t) except -1

    cpdef bint is_started(self, long long t, long long tick) except -1

    cpdef bint _is_undecided(self, long long t) except -1

    @cython.locals(start="long long")
    cpdef double started_at(self, long long t) except? -1.0

    cpdef bint is_over(self, long long t, long long tick) except -1

    cpdef bint is_waiting(self, long long t, long long tick) except -1

    @cython.locals(other="long long")
    cpdef bint is_requested(self, long long t) except -1

    cpdef int remember_request(self, long long t) except -1

    cpdef long long parent(self, long long t) except? -1

    cpdef long long stands_for(self, long long t) except? -1

    cpdef long long predicate_of(self, long long t) except? -1

    cpdef bint is_met_by(self, long long planned, long long observed) except -1

    cpdef long long next_of(self, long long o, long long current) except? -1

    cpdef long long following(self, long long t) except? -1

    @cython.locals(live=list, rows=Rows, t="long long")
    cpdef list all_tokens(self)

    @cython.locals(found=double, rows=Rows, t="long long")
    cpdef double last_start(self) except? -1.0

    @cython.locals(engine=Engine, found=list, rows=Rows, t="long long")
    cpdef list unplaced(self, long long tick)

    @cython.locals(found=list, t="long long")
    cpdef list _listed(self, long long head, long long kind)

    @cython.locals(v="long long")
    cpdef long long object_of(self, long long t) except? -1

    cpdef bint is_due_to_request(self, long long t) except -1

    cpdef bint is_internal(self, long long t) except -1

    @cython.locals(t="long long")
    cpdef list must_begin(self, long long o, long long tick)

    cpdef bint waits_for_own(self, long long t, long long tick) except -1

    cpdef list undecided(self)


cpdef long long whole_bound(double bound) except? -1
