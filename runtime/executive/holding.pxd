# The C types of `holding.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.engine cimport Engine
from runtime.executive.workbench cimport Workbench
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long END, FLAG_ACTION, FLAG_CONDITION, FLAG_EFFECT, INFINITY, NONE, ROLE_TOKEN
cdef long long SPAN_CLOCK, SPAN_EXECUTIVE, START, SUPPORT_EDGE, SUPPORT_RESTRICTION


@cython.locals(ends=list, start="long long")
cpdef bint is_blocked(Workbench bench, long long t, long long current, long long tick) except -1

@cython.locals(ends="long long", engine=Engine, free=double, i="long long", start="long long", v="long long")
cpdef double follows_late(Workbench bench, long long t, long long tick) except? -1.0

cpdef bint hangs_on_action(Workbench bench, long long t) except -1

@cython.locals(
    begins="long long", by="long long", found=double, is_free=bint, mark="long long", start="long long",
    wanted="long long"
)
cpdef double due_start(Workbench bench, long long t, long long tick) except? -1.0

@cython.locals(
    asking="long long", followed=SparseSet, i="long long", o="long long", one="long long", other="long long",
    parent="long long", rows=Rows
)
cpdef long long _wanted_by(Workbench bench, long long t) except? -2

@cython.locals(engine=Engine, free=double, start="long long", v="long long")
cpdef double free_at(Workbench bench, long long t, long long current, long long tick) except? -1.0

@cython.locals(is_asked=bint, other="long long", rows=Rows)
cpdef bint keeps_next(Workbench bench, long long t) except -1

@cython.locals(engine=Engine)
cpdef bint is_tied(Workbench bench, long long end, long long start) except -1

@cython.locals(engine=Engine, start="long long", then="long long")
cpdef bint begin_together(Workbench bench, long long t, long long other) except -1

@cython.locals(ends=list, i="long long", v="long long")
cpdef list _awaited_ends(Workbench bench, long long t, long long current, long long tick)

@cython.locals(e="long long", engine=Engine, i="long long", met=SparseSet, v="long long")
cpdef void _gather_followed(Workbench bench, long long t, long long tick, bint is_far) except *

@cython.locals(_="long long", engine=Engine, other="long long", plan=Plan, support="long long", v="long long")
cpdef bint _is_held_back(Workbench bench, long long t, long long current, long long tick) except -1

@cython.locals(other="long long")
cpdef bint _begins_late(Workbench bench, long long v, long long t) except -1

@cython.locals(engine=Engine, is_open=bint, length="long long", other="long long")
cpdef bint _ends_late(Workbench bench, long long v, long long t) except -1

@cython.locals(plan=Plan)
cpdef bint _is_own(Workbench bench, long long v, long long name) except -1

@cython.locals(other="long long", plan=Plan)
cpdef bint _is_awaited(Workbench bench, long long v, long long t, long long current, long long tick) except -1

@cython.locals(after="long long", ended="long long")
cpdef bint _ends_with(Workbench bench, long long v, long long t) except -1

cpdef bint _is_same(Workbench bench, long long v, long long w) except -1

@cython.locals(holds=bint, mark="long long")
cpdef bint _may_follow(Workbench bench, long long v, long long w, long long by) except -1
