# The C types of `constants.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.domains.variables cimport add_restriction, clear_row, start_interval, start_values, take_block

cdef long long FLAG_VALUES


@cython.locals(size="long long", v="long long")
cpdef long long constant_interval(Store s, long long kind, double lo, double hi) except? -1

@cython.locals(r="long long", size="long long", v="long long")
cpdef long long constant_set(Store s, long long kind, list values) except? -1
