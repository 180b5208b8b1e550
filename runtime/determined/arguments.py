"""Parameters as registers hold them, and as reactors tell each other."""

from collections.abc import Sequence
from typing import Any

from compiler.determined.reasons import UndeterminedError
from compiler.program import DomainConstant, ParameterCode, PredicateCode
from runtime.determined.loading import ParameterShape, RegisterProgram, is_open, number_of
from runtime.determined.log import Log
from runtime.determined.machine import Machine
from runtime.executive.messages import Arguments, make_domain
from runtime.plan.tags import INFINITY


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


def shapes_of(program: RegisterProgram, predicate: PredicateCode) -> list[ParameterShape]:
    """The parameters of a predicate."""
    shapes = program.shapes.get(predicate.name)
    if shapes is None:
        shapes = program.shapes[predicate.name] = [_shape_of(program, each) for each in predicate.parameters]
    return shapes


def arguments_at(shapes: list[ParameterShape], names: Sequence[str], log: Log, first: int) -> Arguments:
    """The same of values that stand in a log, from an index on."""
    told = []
    for k, shape in enumerate(shapes):
        told.append(_told(shape, names, log.values[first + k]))
    return tuple(told)


def values_at(shapes: list[ParameterShape], names: Sequence[str], log: Log, first: int) -> list[Any]:
    """Values that stand in a log, from an index on, as Python has them; two bounds where one was never fixed."""
    found: list[Any] = []
    for k, shape in enumerate(shapes):
        value, kind = log.values[first + k], shape[1]
        if value != value:
            found.append((-INFINITY, INFINITY))
        elif kind == "float":
            found.append(value + 0.0)  # no negative zero
        elif kind == "int":
            found.append(int(value))
        elif kind == "bool":
            found.append(bool(value))
        else:
            found.append(names[int(value)])
    return found


def arguments_from(shapes: list[ParameterShape], names: Sequence[str], values: Sequence[float]) -> Arguments:
    """Values of parameters as others read them; `names` are those that numbers stand for."""
    told = []
    for k, shape in enumerate(shapes):
        told.append(_told(shape, names, values[k]))
    return tuple(told)


def _told(shape: ParameterShape, names: Sequence[str], value: float) -> tuple[str, DomainConstant]:
    """A parameter by its name, with what a register says of it."""
    name, kind, type_name, known = shape
    domain = None if known is None else known.get(value)
    if domain is None:
        domain = _domain_of(names, kind, type_name, value)
        if known is not None and value == value:
            known[value] = domain
    return name, domain


def _shape_of(program: RegisterProgram, parameter: ParameterCode) -> ParameterShape:
    """Name, kind and type of a parameter, and what others were told of its type; reals are too many to be kept."""
    kind, type_name = parameter.type.kind, parameter.type.type_name
    known = None if kind == "float" else program.told.setdefault((kind, type_name), {})
    return parameter.name, kind, type_name, known


def _domain_of(names: Sequence[str], kind: str, type_name: str, value: float) -> DomainConstant:
    """What a register says of a variable; NaN leaves it open."""
    if value != value:
        return make_domain(kind, type_name, (-INFINITY, INFINITY), None)
    if kind == "float":
        number = value + 0.0  # no negative zero
        return make_domain(kind, type_name, (number, number), None)
    if kind == "int":
        return make_domain(kind, type_name, (int(value), int(value)), None)
    if kind == "bool":
        return make_domain(kind, type_name, None, (bool(value),))
    return make_domain(kind, type_name, None, (names[int(value)],))
