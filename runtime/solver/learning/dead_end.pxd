# The C types of `shortage.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.tokens.predicate_hierarchy cimport first_active, next_active
from runtime.plan.resources.resources cimport Resources
from runtime.plan.store.rows cimport Rows
from runtime.solver.learning.conflict_analysis cimport Blame
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.filters cimport Filters
from runtime.solver.flaws.agenda cimport Queues
from runtime.solver.configuration.handler_table cimport Treatments

cdef long long DURATION, END, EVERYTHING, FILTER_GUARD, FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_MASTER_LOOSE
cdef long long FILTER_NOT_GUARD, FILTER_TOKEN_LOOSE, HANDLER_HSTS, INITIAL, LIMITS, LISTS, LIST_ORDER, MAXIMUM, MINIMUM, MOST_SEEDS
cdef long long NONE, NOW, OBJECT, OPEN_CONDITION, POLICY_PARTIAL, PRECEDES_ONLY, RESOURCE_THREAT, SIDE_HOLES
cdef long long SIDE_LOWER, SIDE_UPPER, START, STATE, THREAT, UNBOUND_VARIABLE
cdef double FLOAT_TOLERANCE


@cython.locals(is_known=bint, item="long long", kind="long long", q=Queues, stack=Decisions)
cpdef long long complete(Blame b, long long d) except? -1

@cython.locals(q=Queues, t="long long")
cpdef bint blame_variable(Blame b, long long d, long long v) except -1

@cython.locals(code="long long", f="long long", first="long long", q=Queues, treatments=Treatments)
cpdef bint blame_scope(Blame b, long long row, long long t) except -1

@cython.locals(end="long long", filters=Filters, lb="long long[::1]", start="long long", ub="long long[::1]")
cpdef bint may_leave(Blame b, long long t) except -1

cpdef long long blame_all_times(Blame b, long long t) except? -1

cpdef long long blame_assigned(Blame b, long long t) except? -1

@cython.locals(candidate="long long", predicate="long long", q=Queues, rows=Rows)
cpdef long long blame_partners(Blame b, long long d, long long t) except? -1

@cython.locals(k="long long")
cpdef long long blame_difference(Blame b, long long mine, long long theirs, long long width) except? -1

@cython.locals(after="long long", o="long long", other="long long", q=Queues, v="long long")
cpdef long long blame_neighbours(Blame b, long long t) except? -1

@cython.locals(lb="long long[::1]", ub="long long[::1]", var0="long long[::1]")
cpdef long long blame_times(Blame b, long long t, long long other, long long after) except? -1

@cython.locals(
    at="long long", charged=list, engine=Engine, givers=list, handler="long long", k="long long",
    lasts=bint, latest="long long[::1]", level=double, limit=double, owners=list, place="long long", q=Queues,
    side="long long", sign="long long", stack=Decisions, takers=list, u="long long", uses=Resources, v="long long"
)
cpdef bint blame_instant(Blame b, long long d, long long o) except -1

@cython.locals(engine=Engine, k="long long", v="long long")
cpdef bint is_behind(Blame b, long long point, long long u, list givers, list owners) except -1

@cython.locals(ends=list, found=list, is_free=bint, u="long long", uses=Resources, w="long long")
cpdef list unordered(Blame b, list takers, long long first)
