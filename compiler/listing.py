"""Write a program as text, one line per instruction: for tests and for those who want to see what a model became."""

from collections.abc import Iterator
from typing import assert_never

from compiler.program import (
    FIRST_PARAMETER,
    TOKEN_VARIABLES,
    Assign,
    Call,
    Child,
    ClassCode,
    Constant,
    DomainConstant,
    Field,
    Foreach,
    GlobalVariable,
    Guard,
    Instruction,
    LocalVariable,
    NewGlobal,
    NewObject,
    NewToken,
    NewVariable,
    Operand,
    ParameterCode,
    Post,
    PredicateCode,
    Program,
    Relate,
    Sample,
    SuperCode,
    TokenVariable,
    TypeCode,
    UnionOf,
)

INDENT = "  "


def listing(program: Program) -> str:
    """The whole program, native classes left out."""
    return "\n".join(_lines(program)) + "\n"


def _lines(program: Program) -> Iterator[str]:
    for class_ in program.classes:
        if class_.span is not None:
            yield from _class(class_)
    for predicate in program.predicates:
        if predicate.span is not None:
            yield from _predicate(predicate)
    for number, rule in enumerate(program.rules):
        yield f"rule {number} on {rule.predicate}: {rule.slots} slots, {rule.tokens} tokens, after {rule.declared_at}"
        yield from body(rule.body, 1)
    for site in program.sampled:
        default = "" if site.default is None else f" in {domain_text(site.default)}"
        yield f"sampled {site.name}: {site.kind}{default}, {len(site.uses)} uses"
    yield f"script: {len(program.globals)} globals, {program.script_slots} slots, {program.script_tokens} tokens"
    yield from body(program.script, 1)


def _class(class_: ClassCode) -> Iterator[str]:
    native = f" native {class_.native}" if class_.native else ""
    yield f"class {class_.name} extends {class_.base}{native}"
    for member in class_.members:
        yield f"{INDENT}{member.name}: {type_text(member.type)}"
    for constructor in class_.constructors:
        types = ", ".join(type_text(parameter) for parameter in constructor.parameters)
        yield f"{INDENT}constructor({types}): {constructor.slots} slots"
        yield from body(constructor.body, 2)


def _predicate(predicate: PredicateCode) -> Iterator[str]:
    word = "action" if predicate.is_action else "event" if predicate.is_event else "predicate"
    rules = f" rules {', '.join(map(str, predicate.rules))}" if predicate.rules else ""
    effects = f" effects {', '.join(predicate.effects)}" if predicate.effects else ""
    yield f"{word} {predicate.name}{rules}{effects}"
    for parameter in predicate.parameters:
        yield f"{INDENT}{_parameter(parameter)}"
    yield from body(predicate.body, 1)


def _parameter(parameter: ParameterCode) -> str:
    return f"{parameter.name}: {type_text(parameter.type)}{_given(parameter.domain, parameter.copy_of)}"


def body(code: tuple[SuperCode | Instruction, ...], depth: int) -> Iterator[str]:
    """The lines of a body, indented."""
    for instruction in code:
        yield INDENT * depth + instruction_text(instruction)
        match instruction:
            case Guard(then=then, otherwise=otherwise):
                yield from body(then, depth + 1)
                if otherwise:
                    yield INDENT * depth + "else"
                    yield from body(otherwise, depth + 1)
            case Foreach(body=inner):
                yield from body(inner, depth + 1)
            case _:
                pass


def instruction_text(instruction: SuperCode | Instruction) -> str:
    """One instruction, without the bodies inside it."""
    match instruction:
        case NewVariable(slot=slot, name=name, type=type_, domain=domain, copy_of=copy_of):
            return f"v{slot}: {type_text(type_)} {name or '-'}{_given(domain, copy_of)}"
        case NewObject(slot=slot, global_index=index):
            place = f"v{slot} = " if slot is not None else f"g{index} = " if index is not None else ""
            return place + _new(instruction)
        case Post(name=name, operands=operands, message=message):
            return f"{name}({_operands(operands)})" + (f" : {message}" if message else "")
        case Sample(target=target, parameter=parameter):
            return f"sample {operand_text(target)} from {parameter}"
        case Child():
            role = f"{instruction.role} " if instruction.role else ""
            label = f" {instruction.label}" if instruction.label else ""
            relation = f"t{instruction.origin} {instruction.relation}{_bounds(instruction.bounds)}"
            what = f"child {role}{instruction.predicate}{label} on {_object(instruction.object)}"
            return f"t{instruction.slot} = {what}, {relation}"
        case Relate():
            return f"t{instruction.origin} {instruction.relation}{_bounds(instruction.bounds)} t{instruction.target}"
        case Guard(condition=condition, decided_by=decided_by):
            return f"if {operand_text(condition)} decided by ({_operands(decided_by)})"
        case Foreach(slot=slot, collection=collection):
            return f"foreach v{slot} in {operand_text(collection)}"
        case NewGlobal(index=index, name=name, type=type_, domain=domain, copy_of=copy_of):
            return f"g{index}: {type_text(type_)} {name}{_given(domain, copy_of)}"
        case Assign(target=target, domain=domain, value=value):
            given = _new(value) if isinstance(value, NewObject) else _given(domain, value).removeprefix(" = ")
            return f"{operand_text(target)} = {given}"
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


def operand_text(operand: Operand) -> str:
    """Where a variable is found."""
    match operand:
        case Constant(domain=domain):
            return domain_text(domain)
        case GlobalVariable(index=index):
            return f"g{index}"
        case LocalVariable(slot=slot):
            return f"v{slot}"
        case TokenVariable(token=token, variable=number):
            return f"t{token}.{TOKEN_VARIABLES[number] if number < FIRST_PARAMETER else f'p{number - FIRST_PARAMETER}'}"
        case Field(base=base, members=members):
            return ".".join(("this" if base is None else operand_text(base), *members))
        case UnionOf(operands=operands):
            return f"union({_operands(operands)})"
        case _:
            assert_never(operand)


def domain_text(domain: DomainConstant) -> str:
    """A set of values and its type."""
    if domain.interval is not None:
        text = f"[{domain.interval[0]}, {domain.interval[1]}]"
    else:
        text = "{" + ", ".join(map(str, domain.values or ())) + "}"
    return f"{text} {domain.type_name}"


def type_text(type_: TypeCode) -> str:
    """A type, with the restriction of a typedef."""
    return type_.type_name if type_.domain is None else f"{type_.type_name} within {domain_text(type_.domain)}"


def _operands(operands: tuple[Operand, ...]) -> str:
    return ", ".join(operand_text(operand) for operand in operands)


def _object(holder: Operand | str) -> str:
    return holder if isinstance(holder, str) else operand_text(holder)


def _bounds(bounds: tuple[tuple[int, int], ...]) -> str:
    return "".join(f" [{lower}, {upper}]" for lower, upper in bounds)


def _given(domain: DomainConstant | None, copy_of: Operand | None) -> str:
    if domain is not None:
        return f" = {domain_text(domain)}"
    return "" if copy_of is None else f" = copy of {operand_text(copy_of)}"


def _new(made: NewObject) -> str:
    arguments = ", ".join(_new(a) if isinstance(a, NewObject) else operand_text(a) for a in made.arguments)
    return f"new {made.class_name}#{made.constructor}({arguments})" + (f" {made.name}" if made.name else "")


def _callee(call: Call) -> str:
    if call.token is not None:
        return f"t{call.token}."
    if call.variable is not None:
        return f"{operand_text(call.variable)}."
    return f"{call.class_name}." if call.class_name is not None else ""
