"""What a modeler writes to add a constraint to NDDL: a subclass of `Constraint`, or a call of `function`.

    from runtime.user.constraint import Constraint, View, function

    class Between(Constraint):
        name = "between"
        signature = "x:number low:number high:number"
        meaning = "low <= x <= high"

        def propagate(self, view: View) -> bool:
            return view.raise_to(0, view.lower(1)) and view.reduce_to(0, view.upper(2))

    CONSTRAINTS = [Between()]

docs/constraints.md says how the module is found, and what a constraint must keep to.
"""

from collections.abc import Callable, Sequence

from runtime.constraints.domains.tags import FLOAT_TOLERANCE
from runtime.user.view import Value, View

Term = tuple[str, tuple[str | float | int, ...]]


class Constraint:
    """A constraint by name; subclass it, say what the attributes say, and write `propagate`, `holds`, or both.

    An object of it has no state that depends on what it was asked: it is called for many places of a model, in any
    order, any number of times, also while a search tries and takes back, and in several processes.
    """

    name: str = ""
    # The arguments in order, each `name:kind`; `?` behind a name marks an optional one, `*` any number of them at the
    # end. Kinds: number, bool, string, object, any, and same (comparable with the other arguments of this kind).
    signature: str = ""
    # One sentence, shown by editors and beside complaints.
    meaning: str = ""
    # The position of the argument that the others determine, -1 for the last; None where there is no such argument.
    result: int | None = None
    # Whether nothing follows for the other arguments from the result.
    forward_only: bool = False
    # "float", "int" or "bool": in expressions the constraint is also a function that gives its first argument.
    gives: str | None = None
    # Files that it reads, relative to its own module; a run of missions with other contents is another run.
    files: tuple[str, ...] = ()

    def propagate(self, view: View) -> bool:
        """Narrow the arguments; False if it cannot hold any more. Without an own one, `holds` is asked at the end.

        Never take away a value that belongs to a solution. When all arguments have single values, the answer must be
        right. A constraint that has neither is refused where it is loaded.
        """
        return True

    def holds(self, values: Sequence[Value]) -> bool:
        """Tell whether it holds for single values; asked after `propagate`, once all arguments have one.

        A float is known only to within the tolerance of 0.00001: compare by `near`.
        """
        return True

    def terms(self, arguments: Sequence[str | float | int]) -> Sequence[Term] | None:
        """Say the same in built-in constraints, for z3: `[("addEq", (a, b, c))]`; None if that is impossible."""
        return None


class Function(Constraint):
    """A function: its first argument is computed as soon as all the others have single values."""

    result = 0
    forward_only = True

    def __init__(self, compute: Callable[..., Value | None]) -> None:
        self.compute = compute

    def propagate(self, view: View) -> bool:
        """Compute the result; the arguments are refused where the function gives None."""
        inputs = range(1, view.count)
        if not all(view.is_single(i) for i in inputs):
            return True
        value = self.compute(*[view.value(i) for i in inputs])
        return view.fail() if value is None else view.fix(0, value)


def function(
    name: str,
    inputs: str,
    result: str,
    compute: Callable[..., Value | None],
    meaning: str,
    files: tuple[str, ...] = (),
) -> Constraint:
    """Make a function of expressions, `y == name(x)`, which is also a constraint, `name(y, x)`.

    `inputs` are written as in `Constraint.signature`; `result` is "float", "int" or "bool". `compute` gets the inputs'
    values and returns the result's; None says that there is no result, and the inputs cannot be these.
    """
    made = Function(compute)
    made.name = name
    made.signature = f"result:{'bool' if result == 'bool' else 'number'} {inputs}".rstrip()
    made.meaning = meaning
    made.gives = result
    made.files = files
    return made


def near(a: float, b: float) -> bool:
    """Tell whether two numbers are equal within the engine's tolerance."""
    return abs(a - b) <= FLOAT_TOLERANCE
