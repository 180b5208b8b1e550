"""Parameters as registers hold them, and as reactors tell each other."""

from collections.abc import Sequence

from compiler.determined.reasons import UndeterminedError
from compiler.program import DomainConstant, ParameterCode, PredicateCode
from runtime.determined.loading import ParameterShape, RegisterProgram, is_open, number_of
from runtime.determined.machine import Machine
from runtime.executive.messages import Arguments

_INFINITY = 4503599627370495


def given_block(
    program: RegisterProgram, machine: Machine, line: int, short: str, arguments: Arguments
) -> tuple[int, dict[int, float]] | None:
    """The block and the values of a token that comes from outside; None where only the general engine can tell."""
    predicate = program.model.predicate(line, short)
    if predicate is None or predicate.is_action or predicate.is_event:
        return None
    values = _values_of(program, predicate, arguments)
    if values is None:
        return None
    try:
        block = program.block(line, predicate, sum(1 << k for k in values))
    except UndeterminedError:
        return None
    program.bring_up_to_date(machine)
    return block, values


def _values_of(program: RegisterProgram, predicate: PredicateCode, arguments: Arguments) -> dict[int, float] | None:
    """The parameters that are given a value, as numbers; None where one is given a choice, or is not known."""
    numbers = {parameter.name: k for k, parameter in enumerate(predicate.parameters)}
    values: dict[int, float] = {}
    for name, domain in arguments:
        if name not in numbers:
            return None
        parameter = predicate.parameters[numbers[name]]
        if is_open(domain):
            continue
        value = number_of(program.layout, domain)
        if value is None or (domain.interval is None) == (parameter.type.kind in ("int", "float")):
            return None
        if parameter.type.kind == "int" and value != int(value):
            return None
        values[numbers[name]] = value
    return values


def arguments_of(program: RegisterProgram, predicate: PredicateCode, values: Sequence[float]) -> Arguments:
    """Parameters as others read them."""
    return arguments_from(shapes_of(program, predicate), program.all_names(), values)


def shapes_of(program: RegisterProgram, predicate: PredicateCode) -> list[ParameterShape]:
    """The parameters of a predicate."""
    shapes = program.shapes.get(predicate.name)
    if shapes is None:
        shapes = program.shapes[predicate.name] = [_shape_of(program, each) for each in predicate.parameters]
    return shapes


def arguments_from(shapes: list[ParameterShape], names: Sequence[str], values: Sequence[float]) -> Arguments:
    """Values of parameters as others read them; `names` are those that numbers stand for."""
    told = []
    for k, (name, kind, type_name, known) in enumerate(shapes):
        value = values[k]
        domain = None if known is None else known.get(value)
        if domain is None:
            domain = _domain_of(names, kind, type_name, value)
            if known is not None and value == value:
                known[value] = domain
        told.append((name, domain))
    return tuple(told)


def _shape_of(program: RegisterProgram, parameter: ParameterCode) -> ParameterShape:
    """Name, kind and type of a parameter, and what others were told of its type; reals are too many to be kept."""
    kind, type_name = parameter.type.kind, parameter.type.type_name
    known = None if kind == "float" else program.told.setdefault((kind, type_name), {})
    return parameter.name, kind, type_name, known


def _domain_of(names: Sequence[str], kind: str, type_name: str, value: float) -> DomainConstant:
    """What a register says of a variable; NaN leaves it open."""
    if value != value:
        return DomainConstant(kind, type_name, (-_INFINITY, _INFINITY), None)
    if kind == "float":
        return DomainConstant(kind, type_name, (value + 0.0, value + 0.0), None)  # no negative zero
    if kind == "int":
        return DomainConstant(kind, type_name, (int(value), int(value)), None)
    if kind == "bool":
        return DomainConstant(kind, type_name, None, (bool(value),))
    return DomainConstant(kind, type_name, None, (names[int(value)],))
