# The C types of `engine.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.base_domain cimport base_high, base_low, base_set, in_order, insert_value, is_base_single
from runtime.constraints.explanation.explain cimport explain_bound, explain_conflict
from runtime.constraints.propagators.dispatch cimport propagate_constraint
from runtime.constraints.domains.narrow cimport high, is_single, low, raise_to, reduce_to, round_bounds
from runtime.constraints.stn.network cimport insert_edge, propagate_edges
from runtime.constraints.stn.watch_lists cimport watchers_of
from runtime.constraints.propagators.posting cimport post_constraint
from runtime.constraints.domains.queries cimport has_finitely_many, listed, may_be, number_of_values
from runtime.constraints.relaxation.retract cimport edges_of, follow_again, retract
from runtime.constraints.domains.store cimport Store
from runtime.constraints.relaxation.trail cimport commit_trail, undo_to
from runtime.constraints.domains.variables cimport (
    add_restriction, clear_row, close_values, constant_interval, constant_set, copy_words, is_untouched_set, keep_values,
    start_interval, start_values, take_block, take_row,
)

cdef long long FLAG_DECISION, FLAG_FROZEN, FLAG_VALUES, KIND_FLOAT, OP_ELEMENT, OP_EXTERNAL
cdef long long SUPPORT_RESTRICTION
cdef double FLOAT_TOLERANCE, inf


cdef class Engine(Store):
    cdef public dict constants
    cdef public long long newest_edge, newest_restriction, coarse_after, most_runs
    cdef public set creeping

    cpdef long long reserve(self, long long count) except? -1

    cpdef long long new_interval(
        self, long long kind, double lo, double hi, long long span, long long owner
    ) except? -1

    cpdef long long new_values(self, long long kind, list values, long long span, long long owner) except? -1

    cpdef long long new_like(self, long long other, long long span, long long owner) except? -1

    cpdef long long new_open(self, long long kind, list values, long long span, long long owner) except? -1

    @cython.locals(r="long long")
    cpdef int add_value(self, long long v, double value) except -1

    cpdef bint close(self, long long v) except -1

    cpdef long long new_constant(self, long long kind, double lo, double hi) except? -1

    cpdef long long new_constant_values(self, long long kind, list values) except? -1

    cpdef bint restrict_base(self, long long v, double lo, double hi, long long span, long long owner) except -1

    cpdef int freeze_base(self, long long v, double lo, double hi, long long span, long long owner) except -1

    cpdef bint restrict_base_values(self, long long v, list values, long long span, long long owner) except -1

    cpdef bint restrict_base_to(self, long long v, long long other, long long span, long long owner) except -1

    cpdef bint decide(self, long long v, double value, long long span, long long owner) except -1

    cpdef double lower(self, long long v) except? -1.0

    cpdef double upper(self, long long v) except? -1.0

    cpdef bint is_singleton(self, long long v) except -1

    cpdef bint is_decided(self, long long v) except -1

    cpdef bint contains(self, long long v, double value) except -1

    cpdef bint is_finite(self, long long v) except -1

    cpdef long long size(self, long long v) except? -1

    cpdef list values_of(self, long long v)

    cpdef double base_lower(self, long long v) except? -1.0

    cpdef double base_upper(self, long long v) except? -1.0

    cpdef list base_values(self, long long v)

    cpdef bint is_base_singleton(self, long long v) except -1

    cpdef bint add_edge(
        self, long long source, long long target, long long weight, long long span, long long owner
    ) except -1

    cpdef long long post(self, long long op, list arguments, long long span, long long owner) except? -1

    cpdef long long post_element(
        self, long long result, long long index, list keys, list variables, long long span, long long owner
    ) except? -1

    cpdef long long post_external(self, external, list arguments, long long span, long long owner) except? -1

    cpdef int set_parent(self, long long value, long long parent) except -1

    cpdef list arguments(self, long long c)

    cpdef list keys(self, long long c)

    cpdef list constraints_of(self, long long v)

    cpdef list edges_of(self, long long v)

    @cython.locals(r="long long")
    cpdef list restrictions_of(self, long long v)

    @cython.locals(c="long long", v="long long")
    cpdef bint propagate(self) except -1

    cpdef bint run(self, long long c) except -1

    cpdef long long mark(self) except? -1

    cpdef int rewind(self, long long mark) except -1

    cpdef int commit(self) except -1

    cpdef bint retract(self, constraints=*, edges=*, restrictions=*, variables=*) except -1

    cpdef list explain(self)

    cpdef list support_chain(self, long long v, long long side)
