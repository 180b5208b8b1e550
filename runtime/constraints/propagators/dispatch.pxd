# The C types of `dispatch.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.propagators.arithmetic cimport propagate_arithmetic
from runtime.constraints.propagators.comparison cimport propagate_comparison
from runtime.constraints.propagators.functions cimport propagate_function
from runtime.constraints.propagators.geodesy cimport propagate_geodesy
from runtime.constraints.propagators.logic cimport propagate_logic
from runtime.constraints.propagators.sets cimport propagate_sets

cdef long long CALLED_ALWAYS, CALLED_BESIDE, FAMILY_ARITHMETIC, FAMILY_COMPARISON, FAMILY_FUNCTION, FAMILY_GEODESY
cdef long long FAMILY_LOGIC, FAMILY_SETS
cdef const short[:] CALLED
cdef list CALLS


@cython.locals(called="long long", family="long long", op="long long")
cpdef bint propagate_constraint(Store s, long long c) except -1
