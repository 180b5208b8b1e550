# The C types of `rule_interpreter.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.rules.guards cimport wait
from runtime.plan.store.scopes cimport between, constraint, copy_variable, equate, post_two, restrict
from runtime.plan.tokens.predicate_hierarchy cimport own_predicate
from runtime.plan.store.operands cimport operand
from runtime.plan.store.plan cimport Plan
from runtime.plan.tokens.relations cimport relate
from runtime.plan.store.rows cimport Rows
from runtime.plan.tokens.tokens cimport make_token

cdef long long DO_ASSIGN, DO_BETWEEN, DO_CHILD, DO_FOREACH, DO_GUARD, DO_POST, DO_RELATE, DO_SAMPLE, DO_USE
cdef long long DO_VARIABLE, FLAG_CONDITION, FLAG_EFFECT, HOLDS_USE, IN_NONE, KIND_INT, NONE, OBJECT, OBJECT_GIVEN
cdef long long OBJECT_OWN, OP_FREEZE, OP_SAMPLE, ROLE_INTERNAL, ROLE_LOCAL, START, DURATION, END


@cython.locals(at="long long", rows=Rows, scope="long long", top="long long")
cpdef bint run(Plan plan) except -1


@cython.locals(code="long long", slot="long long", span="long long")
cpdef long long step(Plan plan, long long scope, long long at) except? -1


@cython.locals(name="long long", source="long long", v="long long")
cpdef long long variable(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(count="long long", first="long long")
cpdef long long post(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(first="long long", i="long long")
cpdef long long collect(Plan plan, long long scope, long long at, long long count, long long span) except? -1


@cython.locals(a="long long", b="long long", engine=Engine)
cpdef long long distance(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(origin="long long", rows=Rows, target="long long", tokens="long long")
cpdef long long relation(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(
    flags="long long", given="long long", parent="long long", mode="long long", origin="long long",
    predicate="long long", role="long long", rows=Rows, t="long long", tokens="long long"
)
cpdef long long child(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(source="long long", v="long long")
cpdef long long assign(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(v="long long")
cpdef long long sample(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(block="long long", frozen="long long", held="long long", objects=list, v="long long")
cpdef long long loop(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(
    duration="long long", end="long long", first="long long", holder="long long", owner="long long", quantity="long long",
    start="long long", u="long long"
)
cpdef long long use(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(condition="long long", count="long long", first="long long")
cpdef long long guard(Plan plan, long long scope, long long at, long long span) except? -1
