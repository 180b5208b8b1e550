# The C types of `plan.py`.

from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.resources cimport Resources
from runtime.plan.store.rows cimport Rows

cdef long long NONE


cdef class Plan:
    cdef public Engine engine
    cdef public Rows rows
    cdef public SparseSet doomed_scopes, gone_restrictions, gone_variables
    cdef public long long[::1] code, block_start, block_end, field_kind
    cdef public long long[::1] field_value, field_start, field_length, field_names
    cdef public long long[::1] predicate_class, predicate_flags, predicate_timeline, predicate_resource
    cdef public long long[::1] predicate_suffix, predicate_at, predicate_parent, predicate_root
    cdef public long long[::1] parameter_start, parameter_count, parameter_prototype, parameter_copy_kind
    cdef public long long[::1] parameter_copy_value, body_block, body_slots
    cdef public long long[::1] body_tokens, first_rule, rule_number, rule_block
    cdef public long long[::1] rule_slots, rule_tokens, rule_declared, rule_span
    cdef public long long[::1] relation_start, relation_distance, relation_duration, class_prototype
    cdef public long long[::1] object_class, object_var0, object_constant
    cdef public long long[::1] object_head, object_timeline, member_at, member_prototype, name_prototype
    cdef public long long[::1] form, globals, variable_role, variable_owner
    cdef public long long[::1] variable_name, variable_guards, proxy_index, proxy_member
    cdef public long long[::1] awaited, guard_of, stack_at, stack_end
    cdef public long long[::1] stack_scope, stack_slot, stack_value, queue
    cdef public long long[::1] operands, mark_engine, mark_rows, mark_uses
    cdef public long long[::1] mark_awaited, mark_objects
    cdef public long long suffixes, state_prototype, rejectable_prototype, native_prototype
    cdef public long long duration_prototype, instant_prototype, time_prototype, object_count
    cdef public long long first_object_head, member_names, clock, awaited_count, stack_length
    cdef public long long queue_length, operands_used, statement, self_object
    cdef public bint loops_read_choices
    cdef public double[::1] form_lower, form_upper
    cdef public list unions
    cdef public dict twins
    cdef public object services, envelope
    cdef public Resources resources

    cpdef long long new_object(self, long long number, bint is_timeline) except? -1

    cpdef int push(self, long long start, long long end, long long scope, long long slot, long long value) except -1

    cpdef int enqueue(self, long long guard) except -1

    cpdef int gather_woken(self) except -1

    cpdef int keep_queued(self, long long done) except -1

    cpdef int add_operand(self, long long v) except -1

    cpdef int note_watch(self, long long constraint, long long guard) except -1

    cpdef int note_form(self, long long prototype, double lower, double upper) except -1

    cpdef int await_variable(self, long long v) except -1

    cpdef int end_waiting(self, long long watch) except -1

    cpdef int forget_awaited(self, long long count) except -1

    cpdef int note_variable(self, long long v, long long role, long long owner, long long name) except -1
