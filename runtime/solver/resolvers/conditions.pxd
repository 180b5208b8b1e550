# The C types of `conditions.py`.

cimport cython
from runtime.constraints.domains.bitset cimport has_value
from runtime.constraints.propagators.logic cimport may_be_equal
from runtime.plan.tokens.predicate_hierarchy cimport first_active, next_active
from runtime.plan.lifecycle cimport activate, merge, reject
from runtime.plan.tokens.tokens cimport make_token
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.resolvers.insertions cimport list_insertions, is_open_insertion, is_out_of_range, may_coincide
from runtime.solver.flaws.agenda cimport Agenda

cdef long long ACTIVATE_FIRST, ACTIVATE_ONLY, APPLIED, FAILED_CHOICE, FLAG_ACTION, FLAG_EFFECT, FLAG_FACT
cdef long long HANDLER_HSTS, HANDLER_SUPPORT, MERGE_ONLY, NONE, NO_CHOICE, OBJECT, ORDER_KEY, PHASE_ACTIVATE
cdef long long PHASE_DONE, PHASE_MERGE, PHASE_REJECT, START, STATE, SYMBOL_ACTIVE, SYMBOL_MERGED, SYMBOL_REJECTED


@cython.locals(is_hsts=bint)
cpdef long long mend_open_condition(Agenda agenda, Decisions stack, long long d) except? -1


cpdef bint _may_become(Agenda agenda, long long t, long long symbol) except -1


cpdef long long _mend_by_merging(Agenda agenda, Decisions stack, long long d, long long t) except? -1


cpdef long long _mend_by_sorted_merging(Agenda agenda, Decisions stack, long long d, long long t) except? -1


cpdef bint _is_compatible(Agenda agenda, long long t, long long candidate) except -1


cpdef long long _mend_by_activating(Agenda agenda, Decisions stack, long long d, long long t) except? -1


cpdef bint _has_insertion(Agenda agenda, Decisions stack, long long d, long long t) except -1


cpdef long long _support(Agenda agenda, long long t, long long action, long long effect) except? -1


cpdef bint _is_effect_for(Agenda agenda, long long child, long long t) except -1
