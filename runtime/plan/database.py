"""Plan database: the face of the room; a program in, tokens, timelines and rules changed by its methods."""

from collections.abc import Callable, Sequence

from compiler.program import Program
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.text.diagnostic import Diagnostic
from runtime.constraints.engine import Engine
from runtime.plan import lifecycle
from runtime.plan.loading import load_code, load_members, load_predicates, load_prototypes, load_relations
from runtime.plan.resources.envelope import Envelope
from runtime.plan.rules.rule_bytecode import RuleBytecode
from runtime.plan.script.codes import LOOSE_ITEM, NO_OBJECT
from runtime.plan.script.objects import Objects
from runtime.plan.script.script import Script
from runtime.plan.script.user_constraints import UserConstraints
from runtime.plan.store import marks
from runtime.plan.store.names import Names
from runtime.plan.store.plan import Plan
from runtime.plan.store.prototypes import Prototypes
from runtime.plan.tags import NONE, ROLE_INTERNAL, ROLE_LOCAL, ROLE_TOKEN
from runtime.plan.tokens import retraction, timelines
from runtime.plan.tokens.tokens import make_token
from runtime.user.constraint import Constraint

_GROUNDED = "GroundedProfile"
_OF_TOKENS = (ROLE_TOKEN, ROLE_LOCAL, ROLE_INTERNAL)
Environment = Callable[[str, int], float | None]  # a parameter's name, and the token (NONE: the script) that asks


class PlanDatabase:
    """A loaded program and its plan; tokens, objects, variables and spans are named by integers.

    With `narrows_functions` those that EUROPA computes from known arguments (`abs`, `floor`, `ceil`, `max`, `min`)
    narrow intervals: an argument without bounds is never decided, and its result must not be decided as if free.
    """

    def __init__(
        self,
        program: Program,
        environment: Environment | None = None,
        constraints: Sequence[Constraint] = (),
        narrows_functions: bool = False,
    ) -> None:
        self.program = program
        self.engine = Engine()
        self.plan = Plan(self.engine)
        self.names = Names()
        self.prototypes = Prototypes(self.engine, program)
        predicates = {predicate.name: number for number, predicate in enumerate(program.predicates)}
        self.relation_names = list(RELATIONS)
        relations = {name: number for number, name in enumerate(self.relation_names)}
        load_members(self.plan, program, self.prototypes, self.names)
        self.written = UserConstraints(self.engine, self.prototypes, constraints)
        written = {constraint.name: number for number, constraint in enumerate(constraints)}
        self.narrows_functions = narrows_functions
        self.code = RuleBytecode(self.prototypes, self.names, predicates, relations, written, narrows_functions)
        self.written.spans = self.code.spans
        load_prototypes(self.plan, program, self.prototypes)
        load_relations(self.plan)
        load_predicates(self.plan, program, self.prototypes, self.code)
        self.objects = Objects(self.plan, program, self.prototypes, self.code)
        self.written.objects = self.objects.names
        self.script = Script(predicates, self.objects)
        load_code(self.plan, self.code)
        # What rules ask for is done by those who keep it; the rest by methods below.
        self.make_object = self.objects.make_in_rule
        self.forget_objects = self.objects.truncate
        self.note_open = self.prototypes.note
        self.post_written = self.written.post
        self.plan.services = self
        self.plan.envelope = Envelope(self.plan.engine, self.plan.resources)
        self.plan.resources.grounded_text = self.prototypes.texts.number(_GROUNDED)
        self.environment = environment
        self.ranges = {
            self.names.number(site.name): self.prototypes.of_domain(site.default)
            for site in program.sampled
            if site.default is not None
        }
        self.marks: list[tuple[int, int]] = []

    # ---- what rules ask for ----

    def draw(self, parameter: int, v: int) -> int:
        """A constant with the value that the environment draws for a parameter, of the kind of `v`; or NONE."""
        token = int(self.plan.variable_owner[v]) if self.plan.variable_role[v] in _OF_TOKENS else NONE
        value = None if self.environment is None else self.environment(self.names.text(parameter), token)
        return NONE if value is None else self.engine.new_constant(self.engine.kind[v], value, value)

    def note_homeless(self, t: int) -> None:
        """Let a token that no object can hold stop the script; in a search it is a conflict like others."""
        rows = self.plan.rows
        if rows.level == 0 and rows.span[t] >= 0 and self.objects.fault is None:
            name = self.program.predicates[rows.predicate[t]].class_name
            self.objects.fault = NO_OBJECT.at(self.code.spans[rows.span[t]], name=name)

    def note_loose_item(self, span: int) -> None:
        """Let a set with an item whose value is not known stop the script."""
        if span >= 0 and self.objects.fault is None:
            self.objects.fault = LOOSE_ITEM.at(self.code.spans[span])

    def sample_range(self, parameter: int) -> int:
        """The prototype of the values that a parameter may have; or NONE."""
        return self.ranges.get(parameter, NONE)

    # ---- the script ----

    def run_script(self) -> Diagnostic | None:
        """Carry the script out, statement by statement; what stopped it, if anything did."""
        return self.script.run()

    @property
    def is_consistent(self) -> bool:
        """Whether nothing contradicts anything so far."""
        return bool(self.engine.consistent)

    def fire(self) -> bool:
        """Fire rules and propagate to the fixpoint of both; False on a conflict."""
        return lifecycle.fire(self.plan)

    # ---- time ----

    def mark(self) -> int:
        """Remember the present state, which must be a fixpoint; what `rewind` and `release` take."""
        return marks.mark(self.plan)

    def rewind(self, mark: int) -> None:
        """Go back to a mark; it stays, later ones are gone."""
        marks.rewind(self.plan, mark)

    def release(self, mark: int) -> None:
        """Go back to a mark and drop it."""
        marks.release(self.plan, mark)

    def commit(self) -> None:
        """Forget all marks: what holds now is level 0."""
        marks.commit(self.plan)

    # ---- tokens: False on a conflict; undone by `rewind`, or at level 0 by `cancel`, `free` and `remove_tokens` ----

    def new_token(self, predicate: int, o: int, flags: int, span: int) -> int:
        """Make a token of predicate number `predicate` on object `o` (NONE: on any); call `fire` behind it."""
        given = NONE if o < 0 else self.plan.object_constant[o]
        return make_token(self.plan, predicate, flags, NONE, NONE, given, span)

    def activate(self, t: int, span: int = NONE) -> bool:
        """Make an inactive token active; its rules fire."""
        return lifecycle.activate(self.plan, t, span)

    def merge(self, t: int, other: int, span: int = NONE) -> bool:
        """Let an inactive token stand for an active one of the same predicate."""
        return lifecycle.merge(self.plan, t, other, span)

    def reject(self, t: int, span: int = NONE) -> bool:
        """Drop a rejectable token."""
        return lifecycle.reject(self.plan, t, span)

    def cancel(self, t: int) -> bool:
        """Make a token inactive again (level 0)."""
        return retraction.cancel(self.plan, t) and self.fire()

    def remove_tokens(self, tokens: list[int]) -> bool:
        """Take tokens away with all that followed from them (level 0)."""
        return retraction.remove_tokens(self.plan, tokens) and self.fire()

    def order(self, o: int, before: int, after: int, span: int = NONE) -> bool:
        """Put `before` in front of `after` on object `o`; the same token twice: it alone, behind what is there."""
        return timelines.order(self.plan, o, before, after, span) and self.fire()

    def free(self, before: int, after: int) -> bool:
        """Undo `order` (level 0)."""
        return retraction.free(self.plan, before, after, NONE) and self.fire()

    # ---- variables ----

    def specify(self, v: int, value: float, span: int = NONE) -> bool:
        """Decide a variable."""
        return self.engine.decide(v, value, span, NONE) and self.fire()

    def reset(self, v: int) -> bool:
        """Undo the decision of a variable (level 0)."""
        return retraction.reset(self.plan, v) and self.fire()

    # ---- names ----

    def token_label(self, t: int) -> str | None:
        """The name that the script gave a token."""
        return self.script.labels.get(t)
