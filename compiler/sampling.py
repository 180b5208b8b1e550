"""Collect the sampled parameters of a model: their kinds, default ranges and all places of use."""

from dataclasses import replace

from compiler import constants
from compiler.body import Model
from compiler.program import DomainConstant, ParameterSite
from nddl_lang.semantics.schema import EnumValue, GlobalReference, Variable
from nddl_lang.syntax.nodes import CallConstraint, CallExpr


def note_use(node: CallExpr | CallConstraint, model: Model) -> str:
    """Enter a use of a sampled parameter into the list; its name."""
    reference = model.tables.sampled[node]
    match reference:
        case GlobalReference(variable=variable):
            name, default = variable.name, _default_range(variable, model)
        case EnumValue(value=value):
            name, default = value, None
        case _:
            raise AssertionError("a sampled parameter is a global variable or an enum value")
    site = model.sampled.get(name)
    if site is None:
        site = ParameterSite(name, _kind(node, model), default, ())
    if node.span not in site.uses:
        site = replace(site, uses=(*site.uses, node.span))
    model.sampled[name] = site
    return name


def _default_range(variable: Variable, model: Model) -> DomainConstant | None:
    """The base domain of a global variable, if the text gives it one."""
    code = constants.type_code(variable.type)
    if variable.initialiser is not None and (domain := model.constant(variable.initialiser)) is not None:
        return constants.converted(domain, code)
    return code.domain


def _kind(node: CallExpr | CallConstraint, model: Model) -> str:
    bound = node if isinstance(node, CallExpr) else node.arguments[0]
    return model.type_of(bound).kind.value
