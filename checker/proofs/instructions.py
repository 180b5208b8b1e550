"""One instruction of a body in, what it demands as a claim of z3 out: the meaning of a line, read off the text."""

from math import isinf

import z3

from checker.judge.relations import demands
from checker.proofs.claims import Claim, Number, claim_of, is_silent
from checker.proofs.operands import Binding, number, token_number
from compiler.program import END, OBJECT, START, Assign, Child, NewObject, NewVariable, Operand, Post, Relate
from nddl_lang.semantics.natives import NATIVE_CLASSES

_POINTS = (START, END)


def post_claim(post: Post, binding: Binding) -> Claim | None:
    """What a constraint demands; None where it has no translation."""
    if is_silent(post.name):
        return z3.BoolVal(True)
    base: list[Claim] = []
    numbers = [number(each, binding, base) for each in post.operands]
    if any(each is None for each in numbers):
        return None
    found = claim_of(post.name, numbers)
    return None if found is None else z3.And(found, *base)


def drawn_claim(target: Operand, value: Number, binding: Binding) -> Claim | None:
    """That what is sampled has the value that was drawn: a local variable, or a time or parameter of a token."""
    base: list[Claim] = []
    found = number(target, binding, base)
    return None if found is None else z3.And(found == value, *base)


def relation_claim(given: Child | Relate, binding: Binding) -> Claim | None:
    """What the relation of a child, or of two tokens, demands of their times."""
    target = given.slot if isinstance(given, Child) else given.target
    times: list[Number] = []
    for slot in (given.origin, target):
        found = binding.token(slot)
        if found is None:
            return None
        times += [token_number(*found, point, binding.names, binding.symbols) for point in _POINTS]
    parts: list[Claim] = []
    for first, second, lower, upper in demands(given.relation, given.bounds):
        gap = times[second] - times[first]
        if lower == upper:
            parts.append(gap == int(lower))
            continue
        if not isinf(lower):
            parts.append(gap >= int(lower))
        if not isinf(upper):
            parts.append(gap <= int(upper))
    return z3.And(*parts)


def object_claim(child: Child, binding: Binding) -> Claim | None:
    """On which object a child is."""
    if child.object == "any":
        return z3.BoolVal(True)
    theirs = binding.token(child.slot)
    ours = binding.token(0)
    if theirs is None or ours is None:
        return None
    target = token_number(*theirs, OBJECT, binding.names, binding.symbols)
    if child.object == "own":
        return target == token_number(*ours, OBJECT, binding.names, binding.symbols)
    assert not isinstance(child.object, str)
    return _equality(target, child.object, binding)


def _equality(target: Number, operand: Operand, binding: Binding) -> Claim | None:
    """That a number equals an operand."""
    base: list[Claim] = []
    value = number(operand, binding, base)
    return None if value is None else z3.And(target == value, *base)


def assign_claim(given: Assign, binding: Binding) -> Claim | None:
    """What an assignment leaves of its target."""
    base: list[Claim] = []
    target = number(given.target, binding, base)
    if target is None or isinstance(given.value, NewObject):
        return None
    if given.domain is not None:
        return z3.And(binding.symbols.within(target, given.domain), *base)
    return None if given.value is None else _equality(target, given.value, binding)


def domain_claim(new: NewVariable, target: Number, binding: Binding) -> Claim:
    """What the declaration of a local variable allows."""
    parts = [binding.symbols.within(target, each) for each in (new.type.domain, new.domain) if each is not None]
    if new.type.kind == "bool":
        parts.append(z3.And(target >= 0, target <= 1))
    return z3.And(*parts)


def given_claim(new: NewObject, member: str, target: Number, binding: Binding) -> Claim | None:
    """What making an object of a native class gives one of its members (`store.levelLimitMin`)."""
    native = NATIVE_CLASSES.get(new.class_name)
    names = [] if native is None else [one.name for one in native.constructors[new.constructor].parameters]
    name = member.rpartition(".")[2]
    given = new.arguments[names.index(name)] if name in names else None
    return None if given is None or isinstance(given, NewObject) else _equality(target, given, binding)
