"""Small faults in the source of the engine: one node of a syntax tree changed, and the function compiled anew.

A fault is there always, or only at some of the moments at which its node is reached: then the mission goes on for
longer, and what it does is nearer to what is right.
"""

import ast
import builtins
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property
from itertools import count
from pathlib import Path
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


_NOW = "__fault_is_there__"  # a name among the built-in ones: a function can be given no other global
_MOMENTS: dict[str, Callable[[int, int], bool]] = {
    "always": lambda _count, _nth: True,
    "once": lambda count, nth: count == nth,
    "from then on": lambda count, nth: count >= nth,
    "now and then": lambda count, nth: count % (nth + 1) == 0,
}
MOMENTS = tuple(_MOMENTS)


@dataclass(frozen=True, slots=True)
class Place:
    """A node of a file, in a function, and what may take its place."""

    file: str
    line: int
    function: str
    change: str
    text: str  # of what is changed
    spot: int  # place of the node in the walk through the tree
    new: ast.AST


@dataclass(frozen=True, slots=True)
class SourceFault:
    """A changed function: where it is, when it is changed, and its new code."""

    place: Place
    moment: str
    nth: int
    code: CodeType

    def put_in_place(self, functions: list[FunctionType]) -> None:
        """Have those of these functions that it is about run the changed code, from now on counted anew."""
        self.count_anew()
        for each in functions:
            old = each.__code__
            if (old.co_qualname, old.co_firstlineno, old.co_filename) == (
                self.code.co_qualname,
                self.code.co_firstlineno,
                self.code.co_filename,
            ):
                each.__code__ = self.code

    def count_anew(self) -> None:
        """Begin to count the moments."""
        counts = count(1)
        is_there = _MOMENTS[self.moment]
        setattr(builtins, _NOW, lambda: is_there(next(counts), self.nth))


def _swapped(name: str) -> str | None:
    for a, b in _SIDES:
        for one, other in ((a, b), (b, a)):
            if one in name.split("_"):
                return "_".join(other if part == one else part for part in name.split("_"))
    return None


def _changes(node: ast.AST, tells: bool) -> Iterator[tuple[str, ast.AST]]:
    """What may take the place of a node, with the kind of change; `tells`: its function says whether it succeeded."""
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
        case ast.Return(value=ast.Call()) if tells:
            yield "taken as done", ast.Return(ast.Constant(True))
        case ast.If(test=ast.UnaryOp(op=ast.Not(), operand=ast.Call()), body=[ast.Return()], orelse=[]) if tells:
            yield "taken as done", ast.Pass()
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
        case ast.Name(id=name, ctx=ast.Load()) if (side := _swapped(name)) is not None:
            yield "side", ast.Name(side, node.ctx)
        case ast.Attribute(attr=name, ctx=ast.Load()) if (side := _swapped(name)) is not None:
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


def _at_moments(old: ast.AST, new: ast.AST) -> ast.AST:
    """The new one at the moments of the fault, else the old one."""
    now = ast.Call(ast.Name(_NOW, ast.Load()), [], [])
    if isinstance(old, ast.stmt):
        assert isinstance(new, ast.stmt)
        return ast.If(now, [new], [deepcopy(old)])
    assert isinstance(old, ast.expr) and isinstance(new, ast.expr)
    return ast.IfExp(now, new, deepcopy(old))


class FaultySource:
    """The faults that one file can have."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.tree = ast.parse(Path(file).read_text(encoding="utf-8"))

    @cached_property
    def places(self) -> list[Place]:
        """Every node of a function or method that can be changed, with each of its changes."""
        spots = {node: spot for spot, node in enumerate(ast.walk(self.tree))}
        return [
            Place(
                self.file, getattr(node, "lineno", 0), name, change, ast.unparse(node).split("\n")[0], spots[node], new
            )
            for name, function in _functions(self.tree, "")
            for statement in function.body
            for node in ast.walk(statement)
            for change, new in _changes(node, _tells(function))
        ]

    def fault(self, place: Place, moment: str, nth: int) -> SourceFault | None:
        """The fault of a place; None where the changed function cannot be compiled."""
        tree = deepcopy(self.tree)
        old = next(each for spot, each in enumerate(ast.walk(tree)) if spot == place.spot)
        try:
            _Exchange(old, _at_moments(old, deepcopy(place.new))).visit(tree)
            whole = compile(ast.fix_missing_locations(tree), self.file, "exec")
        except (SyntaxError, ValueError, TypeError):
            return None
        code = next(code for code in _codes(whole) if code.co_qualname == place.function)
        return SourceFault(place, moment, nth, code)


def _tells(function: ast.FunctionDef) -> bool:
    return isinstance(function.returns, ast.Name) and function.returns.id == "bool"


def _functions(tree: ast.Module | ast.ClassDef, above: str) -> Iterator[tuple[str, ast.FunctionDef]]:
    for each in tree.body:
        if isinstance(each, ast.FunctionDef):
            yield above + each.name, each
        elif isinstance(each, ast.ClassDef):
            yield from _functions(each, f"{above}{each.name}.")


def _codes(code: CodeType) -> Iterator[CodeType]:
    """The functions of a module and the methods of its classes."""
    for each in code.co_consts:
        if isinstance(each, CodeType):
            if each.co_flags & 1:  # CO_OPTIMIZED: a function, not the body of a class
                yield each
            else:
                yield from _codes(each)
