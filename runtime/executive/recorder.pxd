# The C types of `recorder.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long ACTIVE, BRANCH_THEN, BRANCH_WAITING, FIRST_PARAMETER, FLAG_FACT, FLAG_GOAL, FREED, HALF_INF
cdef long long HOLDS_VARIABLES, MERGED, NOBODY, OBJECT, ROLE_LOCAL, SCOPE_BRANCH, SCOPE_GUARD, SCOPE_RULE, START
cdef long long SHAPE_BOOL, SHAPE_FLOAT, SHAPE_INT, SHAPE_OBJECT, SHAPE_STRING, SHAPE_SYMBOL
cdef double _LEAST_ENDLESS


cdef class Recorder:
    cdef public object database, forms, witness
    cdef public str name
    cdef public Plan plan
    cdef public Rows rows
    cdef public Engine engine
    cdef public list object_names, predicate_names
    cdef public dict tokens, requests, agreed, gone, gone_of, kept
    cdef public long long synchronised
    cdef public bint is_lost
    cdef public tuple script_tokens

    @cython.locals(parent="long long")
    cpdef int detach(self, long long t) except -1

    @cython.locals(rows=Rows)
    cpdef int _part(self, long long t, long long parent) except -1

    @cython.locals(engine=Engine, found=dict, rows=Rows, t="long long")
    cpdef int cut(self) except -1

    @cython.locals(
        first="long long", k="long long", number="long long", o="long long", plan=Plan, rows=Rows, t="long long",
        tick="long long",
    )
    cpdef object close(self)

    @cython.locals(first="long long", program=object, rows=Rows, slot="long long", t="long long")
    cpdef tuple _script_tokens(self)

    @cython.locals(
        first="long long", k="long long", number="long long", rows=Rows, runs=tuple, shape="long long", shapes=tuple,
        status="long long", arguments=tuple,
    )
    cpdef object _token(self, long long t, str fate, long long tick)

    @cython.locals(flags="long long", is_written=bint, rows=Rows)
    cpdef str _origin(self, long long t)

    @cython.locals(inner=dict, kind="long long", rows=Rows, s="long long", scopes=list, tops=list)
    cpdef tuple _runs(self, long long t, long long key)

    @cython.locals(
        cells="long long[::1]", children=tuple, first="long long", frame="long long", g="long long", guards=tuple,
        k="long long", named=tuple, rows=Rows, shape="long long", slot="long long",
    )
    cpdef object _run(self, long long s, long long key, form, dict inner)

    @cython.locals(b="long long", branch="long long", ran=list, sides=tuple)
    cpdef object _guard(self, long long g, long long key, form, long long k, dict inner)

    @cython.locals(engine=Engine, i="long long", inputs="long long", rows=Rows)
    cpdef bint _is_decided(self, long long g) except -1

    cpdef long long _child(self, long long t, long long s, long long key) except? -1

    cpdef long long _shape(self, long long v) except? -1

    @cython.locals(found=list, h="long long", plan=Plan, rows=Rows, v="long long")
    cpdef tuple _made_locals(self, long long s)

    @cython.locals(child="long long", found=set, rows=Rows)
    cpdef tuple _made_children(self, long long s, long long key)

    @cython.locals(engine=Engine, lower=double, upper=double)
    cpdef object value(self, long long v, long long shape)

    @cython.locals(whole="long long")
    cpdef object _scalar(self, double number, long long shape)


cpdef double _bound(double number)
