# The C types of `families.py`.

cimport cython
from runtime.constraints.propagators.arithmetic cimport run_arithmetic
from runtime.constraints.propagators.comparison cimport run_comparison
from runtime.constraints.propagators.functions cimport run_function
from runtime.constraints.propagators.geodesy cimport run_geometry
from runtime.constraints.propagators.logic cimport run_logic
from runtime.constraints.propagators.sets cimport run_sets
from runtime.constraints.domains.store cimport Store

cdef long long FAMILY_ARITHMETIC, FAMILY_COMPARISON, FAMILY_FUNCTION, FAMILY_GEOMETRY, FAMILY_LOGIC, FAMILY_SETS
cdef long long OP_EXTERNAL


@cython.locals(family="long long")
cpdef bint carry_out(Store s, long long c) except -1
