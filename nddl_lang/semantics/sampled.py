"""What `sampledParameter` names: an expression in, the type of what is drawn out, and complaints."""

from collections.abc import Iterator

from nddl_lang.semantics.arguments import complain_argument
from nddl_lang.semantics.functions import FunctionRow
from nddl_lang.semantics.names import find, resolve
from nddl_lang.semantics.schema import ClassReference, EnumValue, GlobalReference, Type
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.semantics.types import FLOAT, NUMBERS, phrase, plain, reference_type
from nddl_lang.syntax.nodes import Expr, PathExpr, StringLiteral
from nddl_lang.text.diagnostic import Edit, Fix


def sampled_parameter(context: Context, scope: Scope, owner: object, expression: Expr, row: FunctionRow) -> Type:
    """The type of what is drawn for the parameter that `expression` names; `owner` is the call or statement."""
    reference = None
    if isinstance(expression, PathExpr):
        # Locals are no parameters: where nothing has the name, none of them was meant.
        is_known = len(expression.parts) > 1 or find(context, scope, expression.parts[0].name) is not None
        reference = resolve(context, scope if is_known else Scope(scope.kind), expression)
        if reference is None:
            return FLOAT
    argument = row.signature.required[-1]
    if isinstance(reference, EnumValue | GlobalReference):
        found = reference_type(reference, None)
        assert found is not None
        context.tables.types[expression] = found
        if isinstance(reference, EnumValue) or found.kind in NUMBERS:
            context.tables.sampled[owner] = reference
            return FLOAT if isinstance(reference, EnumValue) else plain(found)
        complain_argument(context, row.name, argument, expression, phrase(found))
    elif isinstance(expression, StringLiteral) and _can_be_drawn(context, expression.value):
        fix = Fix(f"write `{expression.value}`", (Edit(expression.span, expression.value),), safe=False)
        complain_argument(context, row.name, argument, expression, "a text in quotes", fixes=(fix,))
    else:
        what = "a class" if isinstance(reference, ClassReference) else "neither"
        complain_argument(context, row.name, argument, expression, what, _global_numbers(context))
    return FLOAT


def _can_be_drawn(context: Context, name: str) -> bool:
    """Whether a global number or a value of an enum has this name."""
    return name in _global_numbers(context) or context.symbols.find_value(name) is not None


def _global_numbers(context: Context) -> Iterator[str]:
    """Names of what can be drawn."""
    for name in context.symbols.names("global"):
        known = context.symbols.find_global(name)
        if known is not None and known.type.kind in NUMBERS:
            yield name
