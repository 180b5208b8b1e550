# The C types of `evaluator.py`.

cimport cython
from libc cimport math
from runtime.rows.block cimport RowBlock

cdef long long BLOCK, STRIDE
cdef double _EXACT, _NAN


cdef class RowEvaluator(RowBlock):
    @cython.locals(found="long long", begin="long long", many="long long", i="long long")
    cpdef long long run(self) except -1

    @cython.locals(j="long long", i="long long", place="long long", yes="long long", no="long long", x="double")
    cpdef int part(self, long long at, long long begin, long long many, long long level) except -1

    @cython.locals(
        at="long long", op="long long", out="long long", a="long long", b="long long", more="long long", i="long long",
        j="long long", level="long long", base="long long", x="double", y="double", z="double"
    )
    cpdef int evaluate(self, long long begin, long long many) except -1

    @cython.locals(
        op="long long", out="long long", a="long long", b="long long", more="long long", i="long long", j="long long",
        place="long long", row="long long", x="double", y="double"
    )
    cpdef int read(self, long long at, long long begin, long long many, long long base) except -1

    @cython.locals(
        op="long long", a="long long", b="long long", more="long long", i="long long", j="long long", k="long long",
        x="double", y="double"
    )
    cpdef int check(self, long long at, long long many, long long base) except -1

    @cython.locals(
        op="long long", out="long long", a="long long", b="long long", c="long long", d="long long", more="long long",
        i="long long", j="long long", x="double", y="double"
    )
    cpdef int compute(self, long long at, long long many, long long base) except -1

    @cython.locals(
        one="long long", two="long long", three="long long", four="long long", five="long long", six="long long",
        i="long long", j="long long", x="double", y="double", to_x="double", to_y="double", east="double",
        north="double", way="double", size="double", turned="double", margin="double"
    )
    cpdef int point(self, long long at, long long many, long long base) except -1
