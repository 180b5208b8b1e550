"""Instructions of a program as text, one line each."""

from collections.abc import Iterator
from typing import assert_never

from compiler.program import (
    FIRST_PARAMETER,
    TOKEN_VARIABLES,
    Assign,
    Call,
    Child,
    Constant,
    DomainConstant,
    Field,
    GlobalVariable,
    Guard,
    Instruction,
    LocalVariable,
    NewGlobal,
    NewObject,
    NewToken,
    NewVariable,
    ObjectLoop,
    Operand,
    Post,
    Relate,
    Sample,
    SuperCode,
    TokenVariable,
    TypeCode,
    UnionOf,
)

INDENT = "  "


def body(code: tuple[SuperCode | Instruction, ...], depth: int) -> Iterator[str]:
    """The lines of a body, indented."""
    for instruction in code:
        yield INDENT * depth + _instruction_text(instruction)
        match instruction:
            case Guard(then=then, otherwise=otherwise):
                yield from body(then, depth + 1)
                if otherwise:
                    yield INDENT * depth + "else"
                    yield from body(otherwise, depth + 1)
            case ObjectLoop(body=inner):
                yield from body(inner, depth + 1)
            case _:
                pass


def _instruction_text(instruction: SuperCode | Instruction) -> str:
    """One instruction, without the bodies inside it."""
    match instruction:
        case NewVariable(slot=slot, name=name, type=type_, domain=domain, copy_of=copy_of):
            return f"v{slot}: {_type_text(type_)} {name or '-'}{_given(domain, copy_of)}"
        case NewObject(slot=slot, global_index=index):
            place = f"v{slot} = " if slot is not None else f"g{index} = " if index is not None else ""
            return place + _new(instruction)
        case Post(name=name, operands=operands, message=message):
            return f"{name}({_operands(operands)})" + (f" : {message}" if message else "")
        case Sample(target=target, parameter=parameter):
            return f"sample {_operand_text(target)} from {parameter}"
        case Child():
            role = f"{instruction.role} " if instruction.role else ""
            label = f" {instruction.label}" if instruction.label else ""
            relation = f"t{instruction.origin} {instruction.relation}{_bounds(instruction.bounds)}"
            what = f"child {role}{instruction.predicate}{label} on {_object(instruction.object)}"
            return f"t{instruction.slot} = {what}, {relation}"
        case Relate():
            return f"t{instruction.origin} {instruction.relation}{_bounds(instruction.bounds)} t{instruction.target}"
        case Guard(condition=condition, decided_by=decided_by):
            return f"if {_operand_text(condition)} decided by ({_operands(decided_by)})"
        case ObjectLoop(slot=slot, collection=collection):
            return f"foreach v{slot} in {_operand_text(collection)}"
        case NewGlobal(index=index, name=name, type=type_, domain=domain, copy_of=copy_of):
            return f"g{index}: {_type_text(type_)} {name}{_given(domain, copy_of)}"
        case Assign(target=target, domain=domain, value=value):
            given = _new(value) if isinstance(value, NewObject) else _given(domain, value).removeprefix(" = ")
            return f"{_operand_text(target)} = {given}"
        case NewToken():
            label = f" {instruction.label}" if instruction.label else ""
            what = f"{instruction.kind} {instruction.predicate}{label} on {_object(instruction.object)}"
            return f"t{instruction.slot} = {what}"
        case Call():
            return f"{_callee(instruction)}{instruction.method}({_operands(instruction.arguments)})"
        case SuperCode(class_name=name, constructor=number, arguments=arguments):
            return f"super {name}#{number}({_operands(arguments)})"
        case _:
            assert_never(instruction)


def _operand_text(operand: Operand) -> str:
    """Where a variable is found."""
    match operand:
        case Constant(domain=domain):
            return _domain_text(domain)
        case GlobalVariable(index=index):
            return f"g{index}"
        case LocalVariable(slot=slot):
            return f"v{slot}"
        case TokenVariable(token=token, variable=number):
            return f"t{token}.{TOKEN_VARIABLES[number] if number < FIRST_PARAMETER else f'p{number - FIRST_PARAMETER}'}"
        case Field(base=base, members=members):
            return ".".join(("this" if base is None else _operand_text(base), *members))
        case UnionOf(operands=operands):
            return f"union({_operands(operands)})"
        case _:
            assert_never(operand)


def _domain_text(domain: DomainConstant) -> str:
    """A set of values and its type."""
    if domain.interval is not None:
        text = f"[{domain.interval[0]}, {domain.interval[1]}]"
    else:
        text = "{" + ", ".join(map(str, domain.values or ())) + "}"
    return f"{text} {domain.type_name}"


def _type_text(type_: TypeCode) -> str:
    """A type, with the restriction of a typedef."""
    return type_.type_name if type_.domain is None else f"{type_.type_name} within {_domain_text(type_.domain)}"


def _operands(operands: tuple[Operand, ...]) -> str:
    return ", ".join(_operand_text(operand) for operand in operands)


def _object(holder: Operand | str) -> str:
    return holder if isinstance(holder, str) else _operand_text(holder)


def _bounds(bounds: tuple[tuple[int, int], ...]) -> str:
    return "".join(f" [{lower}, {upper}]" for lower, upper in bounds)


def _given(domain: DomainConstant | None, copy_of: Operand | None) -> str:
    if domain is not None:
        return f" = {_domain_text(domain)}"
    return "" if copy_of is None else f" = copy of {_operand_text(copy_of)}"


def _new(made: NewObject) -> str:
    arguments = ", ".join(_new(a) if isinstance(a, NewObject) else _operand_text(a) for a in made.arguments)
    return f"new {made.class_name}#{made.constructor}({arguments})" + (f" {made.name}" if made.name else "")


def _callee(call: Call) -> str:
    if call.token is not None:
        return f"t{call.token}."
    if call.variable is not None:
        return f"{_operand_text(call.variable)}."
    return f"{call.class_name}." if call.class_name is not None else ""
