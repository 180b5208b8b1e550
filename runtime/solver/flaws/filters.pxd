# The C types of `filters.py`.

from runtime.constraints.domains.narrow cimport is_single
from runtime.constraints.domains.queries cimport has_finitely_many
from runtime.constraints.domains.bitset cimport count_values
from runtime.constraints.engine cimport Engine
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.solver.configuration.handler_table cimport HandlerTable

cdef long long ACTIVE, END, FILTER_GUARD, FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_PARENT_NOT_ASSIGNED
cdef long long FILTER_NOT_GUARD, FILTER_NOT_SINGLETON, FILTER_NOT_ASSIGNED, INF, KIND_FLOAT
cdef long long LISTS, LIST_ORDER, NONE, OBJECT, POLICY_PARTIAL, POLICY_POSSIBLE, ROLE_LOCAL, ROLE_TOKEN, START


cdef class PlanningScope:

    cpdef bint admits_token(self, long long t) except -1

    cpdef bint may_begin(self, long long t) except -1

    cpdef bint begins_in_time(self, long long t) except -1

    cpdef bint may_overtake(self, long long t, long long other) except -1

    cpdef bint admits_variable(self, long long v) except -1


cdef class Filters:
    cdef public Plan plan
    cdef public Rows rows
    cdef public Engine engine
    cdef public HandlerTable table
    cdef public long long lower, upper
    cdef public bint has_scope
    cdef public PlanningScope scope

    cpdef bint keeps_token(self, long long row, long long t) except -1

    cpdef bint keeps_variable(self, long long row, long long v) except -1

    cpdef bint waits_for_times(self, long long row) except -1

    cpdef bint _is_outside(self, long long t, long long policy) except -1

    cpdef bint _is_assigned(self, long long t) except -1

    cpdef long long token_of(self, long long v) except? -1

    cpdef long long size(self, long long v) except? -1
