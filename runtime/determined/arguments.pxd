# The C types of `arguments.py`.

cimport cython


@cython.locals(k="long long", kind=str, known=dict, name=str, shapes=list, told=list, type_name=str, value="double")
cpdef tuple arguments_of(program, predicate, list values)

cpdef object _domain_of(program, str kind, str type_name, double value)
