# The C types of `constants.py`.

from runtime.constraints.domains.store cimport Store
from runtime.constraints.domains.variables cimport add_restriction, clear_row, start_interval, start_values, take_block

cdef long long FLAG_VALUES


cpdef long long constant_interval(Store s, long long kind, double lo, double hi) except? -1

cpdef long long constant_set(Store s, long long kind, list values) except? -1
