# The C types of `lifecycle.py`.

from runtime.constraints.stn.entailment cimport entail_distance
from runtime.plan.rules.rule_interpreter cimport run
from runtime.plan.rules.guards cimport choice, follow
from runtime.plan.store.scopes cimport between, decide, equate
from runtime.plan.store.links cimport unlink
from runtime.plan.store.plan cimport Plan
from runtime.plan.tokens.retraction cimport retract_branch
from runtime.plan.tokens.tokens cimport activation

cdef long long BRANCH_THEN, BRANCH_WAITING, DURATION, END, LIST_OPEN, MERGED, NONE, OBJECT, REJECTED, SCOPE_BRANCH
cdef long long SCOPE_MERGE, START, STATE, SYMBOL_MERGED, SYMBOL_REJECTED


cpdef bint fire(Plan plan) except -1


cpdef void _decide_guard(Plan plan, long long s) except *


cpdef bint activate(Plan plan, long long t, long long span) except -1


cpdef bint merge(Plan plan, long long t, long long other, long long span) except -1


cdef long long _word(Plan plan, long long v, long long span) except? -99


cpdef bint reject(Plan plan, long long t, long long span) except -1
