# The C types of `evaluator.py`.

cimport cython
from libc cimport math
from runtime.rows.block cimport RowBlock

cdef long long BLOCK, STRIDE
cdef double _EXACT, _LARGEST, _NAN


cdef class RowEvaluator(RowBlock):
    @cython.locals(found="long long", begin="long long", many="long long", i="long long")
    cpdef long long run(self) except -1

    @cython.locals(op="long long")
    cpdef int evaluate(
        self, long long at, long long until, long long begin, long long first, long long last, long long depth
    ) except -1

    @cython.locals(i="long long", j="long long", base="long long")
    cpdef long long branch(
        self, long long at, long long begin, long long first, long long last, long long depth
    ) except -1

    @cython.locals(i="long long", place="long long", condition="long long", x="double")
    cpdef int part(self, long long at, long long begin, long long first, long long last, long long base) except -1

    @cython.locals(
        op="long long", out="long long", a="long long", b="long long", more="long long", i="long long",
        place="long long", token="long long", x="double", y="double"
    )
    cpdef int read(self, long long at, long long begin, long long first, long long last) except -1

    @cython.locals(i="long long", k="long long", x="double")
    cpdef int translate(self, long long out, long long first, long long last, long long kind) except -1

    @cython.locals(
        op="long long", a="long long", b="long long", more="long long", i="long long", k="long long",
        amiss="long long", x="double", y="double"
    )
    cpdef int check(self, long long at, long long first, long long last) except -1

    @cython.locals(
        op="long long", out="long long", a="long long", b="long long", c="long long", d="long long", more="long long",
        i="long long", amiss="long long", most="double", x="double", y="double"
    )
    cpdef int compute(self, long long at, long long first, long long last) except -1

    cpdef double value(self, long long op, double x, double y) except? -1

    @cython.locals(
        op="long long", out="long long", a="long long", b="long long", more="long long", i="long long", x="double",
        y="double", z="double"
    )
    cpdef int compare(self, long long at, long long first, long long last) except -1

    @cython.locals(
        one="long long", two="long long", three="long long", four="long long", five="long long", six="long long",
        i="long long", x="double", y="double", to_x="double", to_y="double", east="double", north="double",
        way="double", size="double", turned="double", margin="double"
    )
    cpdef int point(self, long long at, long long first, long long last) except -1
