# The C types of `marks.py`.

from runtime.plan.store.links cimport undo
from runtime.plan.store.plan cimport Plan



cpdef long long mark(Plan plan) except? -1


cpdef int rewind(Plan plan, long long number) except -1


cpdef int release(Plan plan, long long number) except -1


cpdef int commit(Plan plan) except -1
