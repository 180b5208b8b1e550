"""What a project says of a constraint of its own, in; the rows that the language knows it by, or what is wrong, out."""

from collections.abc import Iterable
from dataclasses import dataclass

from nddl_lang.semantics.callables import Callables, owner_of
from nddl_lang.semantics.constraints import ConstraintRow, Origin
from nddl_lang.semantics.functions import FunctionRow, ResultKind
from nddl_lang.semantics.signature import Argument, ArgumentKind, Signature, signature

_KINDS = (
    ArgumentKind.NUMBER,
    ArgumentKind.BOOL,
    ArgumentKind.STRING,
    ArgumentKind.OBJECT,
    ArgumentKind.ANY,
    ArgumentKind.SAME,
)
_RESULTS = {"float": ResultKind.FLOAT, "int": ResultKind.INT, "bool": ResultKind.BOOL}


class DescriptionError(ValueError):
    """A constraint is not described as it must be; the message says of which one, and how."""


@dataclass(frozen=True, slots=True)
class Description:
    """The attributes of a user's constraint that are not code; `kind` is the name of its class."""

    kind: str
    name: object
    signature: str
    meaning: str
    result: int | None = None
    forward_only: bool = False
    gives: str | None = None


def described(native: Callables, found: Iterable[tuple[str, Description]]) -> Callables:
    """What models may call, with all that is described, each beside its place; raises DescriptionError."""
    owners: dict[str, str] = {}
    rows: list[ConstraintRow] = []
    functions: list[FunctionRow] = []
    for place, each in found:
        name = str(each.name)
        if (owner := owner_of(name)) is not None:
            raise DescriptionError(f"{place}: a constraint cannot be called `{name}`: that is {owner}")
        if name in owners:
            raise DescriptionError(f"{place}: there is a constraint `{name}` already, in {owners[name]}")
        owners[name] = place
        row = row_of(place, each)
        rows.append(row)
        if each.gives is not None:
            functions.append(_function(place, each, row))
    return native.extended(rows, functions) if rows else native


def row_of(place: str, each: Description) -> ConstraintRow:
    """What the language has to know of a constraint; raises DescriptionError where it is not well described."""
    name = each.name

    def complain(what: str) -> DescriptionError:
        return DescriptionError(f"{place}: the constraint `{name}` {what}")

    if not (isinstance(name, str) and name.isidentifier() and name.isascii()):
        raise DescriptionError(f"{place}: `{each.kind}` needs a `name` that can be written in a model, not {name!r}")
    if not each.meaning:
        raise complain("needs a sentence for its `meaning`")
    try:
        taken = signature(each.signature)
    except KeyError:
        kinds = ", ".join(kind.name.lower() for kind in _KINDS)
        raise complain(f'needs a `signature` such as "x:number y:number"; kinds are {kinds}') from None
    places = _places(taken)
    if strange := next((one for one in places if one.kind not in _KINDS), None):
        raise complain(f"cannot have an argument of the kind {strange.kind.name.lower()} (`{strange.name}`)")
    if not places:
        raise complain("has no arguments")
    if each.result is not None and not -1 <= each.result < len(places):
        raise complain(f"has no argument {each.result} for a `result`")
    return ConstraintRow(
        name, taken, each.result, each.meaning, Origin.USER, forward_only=each.forward_only, since=None
    )


def _places(taken: Signature) -> list[Argument]:
    rest = [] if taken.rest is None else [taken.rest]
    return [*taken.required, *taken.optional, *rest]


def _function(place: str, each: Description, row: ConstraintRow) -> FunctionRow:
    result = _RESULTS.get(str(each.gives))
    if result is None or not row.signature.required:
        what = f'gives {each.gives!r}; a function gives "float", "int" or "bool", as its first argument'
        raise DescriptionError(f"{place}: the constraint `{row.name}` {what}")
    inputs = Signature(row.signature.required[1:], row.signature.optional, row.signature.rest)
    return FunctionRow(row.name, inputs, result, row.name, each.meaning, Origin.USER, overlooks_rest=False)
