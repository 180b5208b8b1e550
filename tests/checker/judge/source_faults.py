"""Small faults in the source of the engine: one node of a syntax tree changed, and the function compiled anew."""

import ast
import gc
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from random import Random
from types import CodeType, FunctionType

_OTHER_TESTS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
}
_SIDES = [("lower", "upper"), ("start", "end"), ("START", "END"), ("LOWER", "UPPER"), ("min", "max"), ("first", "last")]


@dataclass(frozen=True, slots=True)
class SourceFault:
    """A changed function: where it is found among those that are loaded, what was changed, and its new code."""

    file: str
    line: int
    function: str
    kind: str
    code: CodeType

    def put_in_place(self) -> None:
        """Have the function run the changed code, wherever it was imported to."""
        for each in gc.get_objects():
            if (
                isinstance(each, FunctionType)
                and each.__code__.co_qualname == self.function
                and each.__code__.co_firstlineno == self.code.co_firstlineno
                and each.__code__.co_filename == self.code.co_filename
            ):
                each.__code__ = self.code


def _swapped(name: str) -> str | None:
    for a, b in _SIDES:
        for one, other in ((a, b), (b, a)):
            if one in name.split("_"):
                return "_".join(other if part == one else part for part in name.split("_"))
    return None


def _changes(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """What may take the place of a node, with the kind of fault that it is."""
    match node:
        case ast.Compare(ops=[op]) if type(op) in _OTHER_TESTS:
            for other in _OTHER_TESTS[type(op)]:
                new = deepcopy(node)
                new.ops = [other()]
                yield "comparison", new
        case ast.BinOp(op=ast.Add() | ast.Sub()):
            new_sum = deepcopy(node)
            new_sum.op = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
            yield "sign", new_sum
        case ast.BoolOp():
            new_junction = deepcopy(node)
            new_junction.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
            yield "junction", new_junction
            for k in range(len(node.values)):
                rest = [one for n, one in enumerate(node.values) if n != k]
                yield "part of a condition left out", deepcopy(ast.BoolOp(node.op, rest) if rest[1:] else rest[0])
        case ast.Constant(value=bool(value)):
            yield "truth value", ast.Constant(not value)
        case ast.Constant(value=int(value)):
            yield "constant", ast.Constant(value + 1)
            yield "constant", ast.Constant(value - 1)
        case ast.Expr(value=ast.Call()):
            yield "call left out", ast.Pass()
        case ast.AugAssign():
            yield "change left out", ast.Pass()
        case ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            yield "change left out", ast.Pass()
        case ast.If(test=test):
            new_if = deepcopy(node)
            new_if.test = ast.UnaryOp(ast.Not(), deepcopy(test))
            yield "condition", new_if
        case ast.Continue():
            yield "loop", ast.Break()
        case ast.Break():
            yield "loop", ast.Continue()
        case ast.For():
            items = ast.Call(ast.Name("list", ast.Load()), [deepcopy(node.iter)], [])
            for kind, step in (("order", ast.Slice(None, None, ast.Constant(-1))), ("first left out", _FROM_ONE)):
                new_loop = deepcopy(node)
                new_loop.iter = ast.Subscript(items, deepcopy(step), ast.Load())
                yield kind, new_loop
        case ast.Name(id=name) if (side := _swapped(name)) is not None:
            yield "side", ast.Name(side, node.ctx)
        case ast.Attribute(attr=name) if (side := _swapped(name)) is not None:
            yield "side", ast.Attribute(deepcopy(node.value), side, node.ctx)
        case ast.Call(args=[first, second, *rest]):
            new_call = deepcopy(node)
            new_call.args = [deepcopy(second), deepcopy(first), *deepcopy(rest)]
            yield "arguments swapped", new_call


_FROM_ONE = ast.Slice(ast.Constant(1), None, None)


class _Exchange(ast.NodeTransformer):
    """Put a node in the place of another one."""

    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        """The new one for the old one."""
        return ast.copy_location(self.new, node) if node is self.old else self.generic_visit(node)


class FaultySource:
    """The faults that the lines of one file can have."""

    def __init__(self, file: str, lines: set[int]) -> None:
        self.file = file
        self.tree = ast.parse(Path(file).read_text(encoding="utf-8"))
        self.places = [
            (node, kind, new)
            for node in ast.walk(self.tree)
            if getattr(node, "lineno", 0) in lines
            for kind, new in _changes(node)
        ]

    def fault(self, dice: Random) -> SourceFault | None:
        """One of them; None where the dice choose what is in no function, or cannot be compiled."""
        kind = dice.choice(sorted({kind for _, kind, _ in self.places}))
        node, _, new = dice.choice([one for one in self.places if one[1] == kind])
        spot = next(k for k, each in enumerate(ast.walk(self.tree)) if each is node)
        tree = deepcopy(self.tree)
        old = next(each for k, each in enumerate(ast.walk(tree)) if k == spot)
        try:
            _Exchange(old, deepcopy(new)).visit(tree)
            whole = compile(ast.fix_missing_locations(tree), self.file, "exec")
        except (SyntaxError, ValueError, TypeError):
            return None
        line: int = getattr(node, "lineno", 0)
        inside = [code for code in _functions(whole) if code.co_firstlineno <= line]
        if not inside:
            return None
        code = max(inside, key=lambda one: one.co_firstlineno)
        return SourceFault(self.file, line, code.co_qualname, kind, code)


def _functions(code: CodeType) -> Iterator[CodeType]:
    """The functions of a module and the methods of its classes."""
    for each in code.co_consts:
        if isinstance(each, CodeType):
            if each.co_flags & 1:  # CO_OPTIMIZED: a function, not the body of a class
                yield each
            else:
                yield from _functions(each)
