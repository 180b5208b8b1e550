# The C types of `arguments.py`.

cimport cython


cpdef tuple arguments_of(program, predicate, list values)

cpdef list shapes_of(program, predicate)

@cython.locals(k="long long", kind=str, known=dict, name=str, told=list, type_name=str, value="double")
cpdef tuple arguments_from(list shapes, names, list values)

cpdef object _domain_of(names, str kind, str type_name, double value)
