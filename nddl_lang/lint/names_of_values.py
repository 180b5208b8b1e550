"""Find variables whose name is an enum value: they can never be read by that name."""

from collections.abc import Iterator

from nddl_lang.lint.codes import HIDDEN_BY_VALUE
from nddl_lang.lint.local_names import named_variables
from nddl_lang.lint.whole import Whole
from nddl_lang.text.diagnostic import Diagnostic


def lint_names_of_values(whole: Whole) -> Iterator[Diagnostic]:
    """A parameter, local or global variable that is called like an enum value."""
    values = whole.analysis.schema.enum_values
    if values.keys().isdisjoint(whole.usage.names):
        return
    for part, each in zip(whole.parts, whole.gists, strict=True):
        if not each.names.isdisjoint(values):
            for name in named_variables(part):
                if (value := values.get(name.name)) is not None:
                    yield HIDDEN_BY_VALUE.at(name.span, help="give it another name", name=name.name, enum=value.enum)
