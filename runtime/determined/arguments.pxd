# The C types of `arguments.py`.

cimport cython
from runtime.determined.log cimport Log
from runtime.executive.messages cimport make_domain


cpdef list shapes_of(program, predicate)

@cython.locals(k="long long", shape=tuple, told=list)
cpdef tuple arguments_from(list shapes, names, list values)

@cython.locals(k="long long", shape=tuple, told=list)
cpdef tuple arguments_at(list shapes, names, Log log, long long first)

@cython.locals(found=list, k="long long", kind=str, shape=tuple, value=double)
cpdef list values_at(list shapes, names, Log log, long long first)

@cython.locals(kind=str, known=dict, name=str, type_name=str)
cpdef tuple _told(tuple shape, names, double value)

cpdef object _domain_of(names, str kind, str type_name, double value)
