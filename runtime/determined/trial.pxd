# The C types of `trial.py`.

cimport cython
from runtime.determined.present cimport Present
from runtime.determined.tables cimport CodeTables

cdef long long ENDING, FOLLOWER, LEAST, MOST, PREDICATE, SLOT


@cython.locals(follower="long long", n="long long")
cpdef bint holds(Present present, CodeTables tables, long long i, long long predicate, bint is_trial) except -1

@cython.locals(at="long long", k="long long", least="long long", most="long long", n="long long")
cpdef bint fits_within(Present present) except -1
