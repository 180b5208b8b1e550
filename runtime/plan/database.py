"""The plan database: a program in; tokens, timelines and rules at work, and everything that changes them."""

from collections.abc import Callable

from compiler.program import Program
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.text.diagnostic import Diagnostic
from runtime.constraints.engine import Engine
from runtime.plan.codes import NONE
from runtime.plan.flatten import Code
from runtime.plan.loading import load_code, load_members, load_predicates, load_prototypes, load_relations
from runtime.plan.names import Names
from runtime.plan.objects import Objects
from runtime.plan.plan import Plan
from runtime.plan.prototypes import Prototypes
from runtime.plan.script import Script

Environment = Callable[[str], float | None]


class PlanDatabase:
    """A loaded program and its plan; tokens, objects, variables and spans are named by integers."""

    def __init__(self, program: Program, environment: Environment | None = None) -> None:
        self.program = program
        self.engine = Engine()
        self.plan = Plan(self.engine)
        self.names = Names()
        self.prototypes = Prototypes(self.engine, program)
        predicates = {predicate.name: number for number, predicate in enumerate(program.predicates)}
        self.relation_names = list(RELATIONS)
        relations = {name: number for number, name in enumerate(self.relation_names)}
        load_members(self.plan, program, self.prototypes, self.names)
        self.code = Code(self.prototypes, self.names, predicates, relations)
        load_prototypes(self.plan, program, self.prototypes)
        load_relations(self.plan)
        load_predicates(self.plan, program, self.prototypes, self.code)
        self.plan.set_globals(len(program.globals))
        self.objects = Objects(self.plan, program, self.prototypes, self.code)
        self.script = Script(self.plan, program, self.prototypes, self.code, predicates, self.objects)
        load_code(self.plan, self.code)
        self.plan.services = self
        self.environment = environment
        self.marks: list[tuple[int, int]] = []

    # ---- what rules ask for ----

    def make_object(self, scope: int, number: int) -> int:
        """Carry out `new` number `number` of a rule; the variable that holds the object."""
        return self.objects.make_in_rule(scope, number)

    def draw(self, parameter: int, v: int) -> int:
        """A constant with the value that the environment draws for a parameter, of the kind of `v`; or NONE."""
        value = None if self.environment is None else self.environment(self.names.text(parameter))
        return NONE if value is None else self.engine.new_constant(self.engine.kind[v], value, value)

    def note_open(self, v: int, prototype: int) -> None:
        """Remember an open variable, to which later objects are added."""
        self.prototypes.note(v, prototype)

    # ---- the script ----

    def run_script(self) -> Diagnostic | None:
        """Carry the script out, statement by statement; what stopped it, if anything did."""
        return self.script.run()

    @property
    def is_consistent(self) -> bool:
        """Whether nothing contradicts anything so far."""
        return bool(self.engine.consistent)

    def local_type(self, v: int) -> str | None:
        """The type name of a local variable, where its values do not tell it."""
        return None

    def token_label(self, t: int) -> str | None:
        """The name that the script gave a token."""
        return self.script.labels.get(t)
