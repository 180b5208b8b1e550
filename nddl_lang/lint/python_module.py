"""Read the constraints of a Python module from its syntax tree: text in, descriptions and gaps out. Nothing is run."""

import ast
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from nddl_lang.semantics.described import Description

LIST = "CONSTRAINTS"
_API = "runtime.user.constraint"
_BASES = (f"{_API}.Constraint", f"{_API}.Function")
_FUNCTION = f"{_API}.function"
_FUNCTION_PARAMETERS = ("name", "inputs", "result", "compute", "meaning", "files")
_FIELDS = ("name", "signature", "meaning", "result", "forward_only", "gives")
_LONGEST = 10_000  # characters of a text, or items of a list, that are followed


@dataclass(frozen=True, slots=True)
class Gap:
    """What only running the module would tell: its line, and why."""

    line: int
    reason: str


@dataclass(frozen=True, slots=True)
class ReadModule:
    """The constraints that a module's text describes, each with its line, and what cannot be read from it."""

    found: tuple[tuple[int, Description], ...] = ()
    gaps: tuple[Gap, ...] = ()


class _Unknown:
    """A value that only running the module would tell."""


_UNKNOWN = _Unknown()


@dataclass(frozen=True, slots=True)
class _Imported:
    """A name of another module, by its whole name."""

    name: str


@dataclass(eq=False, slots=True)
class _Class:
    """A class of constraints: its attributes, those inherited among them, and how it is initialised."""

    name: str
    attributes: dict[str, object]
    initialiser: ast.FunctionDef | None
    hidden: frozenset[str] = frozenset()  # fields that an inherited initialiser sets


@dataclass(eq=False, slots=True)
class _Object:
    """A constraint that the module makes."""

    kind: str
    line: int
    attributes: dict[str, object] = field(default_factory=dict)


def read_module(text: str) -> ReadModule:
    """Read a module's text; whatever it holds, nothing of it is executed."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
        return _Reader().read(tree)
    except SyntaxError as problem:
        return ReadModule((), (Gap(problem.lineno or 1, f"it is no Python: {problem.msg}"),))
    except (ValueError, RecursionError, MemoryError):
        return ReadModule((), (Gap(1, "it cannot be parsed"),))


class _Reader:
    """Follows what a module's top level binds, as far as it is plain."""

    def __init__(self) -> None:
        self.names: dict[str, object] = {}

    def read(self, tree: ast.Module) -> ReadModule:
        for statement in tree.body:
            self._follow(statement)
        offered = self.names.get(LIST)
        if offered is None:
            return ReadModule((), (Gap(1, f"it has no list `{LIST}`"),))
        items = offered if isinstance(offered, tuple) else (offered,)
        found: list[tuple[int, Description]] = []
        gaps: list[Gap] = []
        for item in items:
            told = _description(item)
            if isinstance(told, Gap):
                gaps.append(told)
            else:
                found.append(told)
        return ReadModule(tuple(found), tuple(gaps))

    # ---- statements ----

    def _follow(self, statement: ast.stmt) -> None:
        match statement:
            case ast.Import(names=names):
                for alias in names:
                    first = alias.name.partition(".")[0]
                    self.names[alias.asname or first] = _Imported(alias.name if alias.asname else first)
            case ast.ImportFrom(module=str(module), names=names, level=0):
                for alias in names:
                    if alias.name == "*" and module == _API:
                        public = ("Constraint", "Function", "View", "function", "near")
                        self.names |= {each: _Imported(f"{module}.{each}") for each in public}
                    else:
                        self.names[alias.asname or alias.name] = _Imported(f"{module}.{alias.name}")
            case ast.ClassDef():
                self.names[statement.name] = self._class(statement)
            case ast.Assign(targets=targets, value=value):
                made = self._value(value)
                for target in targets:
                    self._bind(target, made)
            case ast.AnnAssign(target=target, value=ast.expr() as value):
                self._bind(target, self._value(value))
            case ast.AugAssign(target=ast.Name(id=name), op=ast.Add(), value=value):
                self.names[name] = _joined(self.names.get(name, _UNKNOWN), self._value(value))
            case ast.Expr(
                value=ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr=attribute), args=[given])
            ) if attribute in ("append", "extend") and name in self.names:
                added = self._value(given)
                self.names[name] = _joined(self.names[name], (added,) if attribute == "append" else added)
            case ast.If(test=ast.Compare(left=ast.Name(id="__name__"))):
                pass  # what a program does that is no module
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case _:
                self.names |= dict.fromkeys(_touched(statement), _UNKNOWN)

    def _bind(self, target: ast.expr, value: object) -> None:
        match target:
            case ast.Name(id=name):
                self.names[name] = value
            case ast.Attribute(value=ast.Name(id=name), attr=attribute) if isinstance(
                owner := self.names.get(name), _Class | _Object
            ):
                owner.attributes[attribute] = value
            case _:
                self.names |= dict.fromkeys(_touched(target), _UNKNOWN)

    def _class(self, node: ast.ClassDef) -> object:
        """A class whose only base is a constraint; of any other one nothing is known."""
        if node.decorator_list or node.keywords or len(node.bases) != 1:
            return _UNKNOWN
        base = self._value(node.bases[0])
        made = _Class(node.name, {}, None)
        if isinstance(base, _Class):
            made = _Class(node.name, dict(base.attributes), base.initialiser, base.hidden)
        elif base == _Imported(_BASES[1]):
            made.attributes |= {"result": 0, "forward_only": True}
        elif base != _Imported(_BASES[0]):
            return _UNKNOWN
        inner = _Reader()
        inner.names = dict(self.names)
        for statement in node.body:
            match statement:
                case ast.FunctionDef(name="__init__"):
                    if made.initialiser is not None:
                        made.hidden = frozenset(_fields_set(made.initialiser))
                    made.initialiser = statement
                case ast.FunctionDef() | ast.AsyncFunctionDef():
                    made.attributes[statement.name] = _UNKNOWN
                case _:
                    before = dict(inner.names)
                    inner._follow(statement)
                    changed = {each: made_ for each, made_ in inner.names.items() if before.get(each) is not made_}
                    made.attributes |= changed
        return made

    # ---- values ----

    def _value(self, node: ast.expr) -> object:
        match node:
            case ast.Constant(value=value):
                return value
            case ast.Name(id=name):
                return self.names.get(name, _UNKNOWN)
            case ast.Tuple(elts=items) | ast.List(elts=items):
                made: object = ()
                for item in items:
                    made = _joined(
                        made, self._value(item.value) if isinstance(item, ast.Starred) else (self._value(item),)
                    )
                return made
            case ast.JoinedStr(values=parts):
                texts = [
                    self._value(each.value)
                    if isinstance(each, ast.FormattedValue) and each.conversion == -1 and each.format_spec is None
                    else self._value(each)
                    for each in parts
                ]
                return (
                    "".join(str(each) for each in texts) if all(isinstance(each, str) for each in texts) else _UNKNOWN
                )
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return _joined(self._value(left), self._value(right))
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as number)):
                return -number
            case ast.Attribute(value=inner, attr=attribute):
                owner = self._value(inner)
                if isinstance(owner, _Imported):
                    return _Imported(f"{owner.name}.{attribute}")
                if isinstance(owner, _Class | _Object):
                    return owner.attributes.get(attribute, _UNKNOWN)
                return _UNKNOWN
            case ast.Call():
                return self._call(node)
            case _:
                return _UNKNOWN

    def _call(self, node: ast.Call) -> object:
        called = self._value(node.func)
        if called == _Imported(_FUNCTION):
            given = self._given(node, _FUNCTION_PARAMETERS)
            result, inputs = given.get("result", _UNKNOWN), given.get("inputs", _UNKNOWN)
            taken: object = _UNKNOWN
            if isinstance(result, str) and isinstance(inputs, str):
                taken = f"result:{'bool' if result == 'bool' else 'number'} {inputs}".rstrip()
            told = {"name": given.get("name", _UNKNOWN), "meaning": given.get("meaning", _UNKNOWN)}
            more = {"signature": taken, "gives": result, "result": 0, "forward_only": True}
            return _Object("function", node.lineno, told | more)
        if called == _Imported(_BASES[1]):
            return _Object("Function", node.lineno, {"result": 0, "forward_only": True})
        if isinstance(called, _Class):
            return self._made(called, node)
        return _UNKNOWN

    def _made(self, class_: _Class, node: ast.Call) -> _Object:
        """What a call of a class makes: its attributes, and what the initialiser sets plainly."""
        made = _Object(class_.name, node.lineno, class_.attributes | dict.fromkeys(class_.hidden, _UNKNOWN))
        code = class_.initialiser
        if code is None:
            return made
        made.attributes |= dict.fromkeys(_fields_set(code), _UNKNOWN)
        parameters = [each.arg for each in (*code.args.posonlyargs, *code.args.args)]
        first = parameters[0] if parameters else ""
        inner = _Reader()
        inner.names = dict(self.names) | dict.fromkeys(parameters, _UNKNOWN)
        defaults = code.args.defaults
        inner.names |= {
            name: self._value(each) for name, each in zip(parameters[-len(defaults) :], defaults, strict=False)
        }
        inner.names |= {
            each.arg: _UNKNOWN if default is None else self._value(default)
            for each, default in zip(code.args.kwonlyargs, code.args.kw_defaults, strict=True)
        }
        inner.names |= self._given(node, parameters[1:])
        inner.names[first] = made
        for statement in code.body:
            match statement:
                case ast.Assign(targets=[ast.Attribute(value=ast.Name(id=name), attr=attribute)], value=value) if (
                    name == first
                ):
                    made.attributes[attribute] = inner._value(value)
        return made

    def _given(self, node: ast.Call, parameters: Sequence[str]) -> dict[str, object]:
        """The arguments of a call by the names of its parameters."""
        if any(isinstance(each, ast.Starred) for each in node.args) or any(each.arg is None for each in node.keywords):
            return dict.fromkeys(parameters, _UNKNOWN)
        given = {name: self._value(each) for name, each in zip(parameters, node.args, strict=False)}
        return given | {str(each.arg): self._value(each.value) for each in node.keywords}


def _joined(left: object, right: object) -> object:
    """Two texts, or two lists, one behind the other."""
    if isinstance(left, str) and isinstance(right, str) and len(left) + len(right) <= _LONGEST:
        return left + right
    if isinstance(left, tuple) and isinstance(right, tuple) and len(left) + len(right) <= _LONGEST:
        return left + right
    if isinstance(left, tuple):
        return (*left, _UNKNOWN)
    return _UNKNOWN


def _touched(node: ast.AST) -> Iterator[str]:
    """The names that a statement binds somewhere, or whose object it may change."""
    for each in ast.walk(node):
        match each:
            case ast.Name(id=name, ctx=ast.Store() | ast.Del()):
                yield name
            case ast.Attribute(value=ast.Name(id=name)) | ast.Subscript(value=ast.Name(id=name)):
                yield name
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.alias(name=name, asname=other):
                yield other or name.partition(".")[0]


def _fields_set(code: ast.FunctionDef) -> Iterator[str]:
    """The fields of a description that an initialiser sets in any way."""
    for each in ast.walk(code):
        if isinstance(each, ast.Attribute) and isinstance(each.ctx, ast.Store) and each.attr in _FIELDS:
            yield each.attr


def _description(item: object) -> tuple[int, Description] | Gap:
    """What a list of constraints has at one place, or why that cannot be told."""
    if isinstance(item, _Class):
        return Gap(1, f"`{LIST}` has the class `{item.name}`; write `{item.name}()`")
    if not isinstance(item, _Object):
        return Gap(1, f"what `{LIST}` holds is computed")
    told: dict[str, object] = {"result": None, "forward_only": False, "gives": None, "meaning": "", "signature": ""}
    told |= {"name": ""} | {each: item.attributes[each] for each in _FIELDS if each in item.attributes}
    match told:
        case {
            "name": name,
            "signature": str(taken),
            "meaning": str(meaning),
            "result": (int() | None) as result,
            "forward_only": bool(is_forward),
            "gives": (str() | None) as gives,
        } if name is not _UNKNOWN:
            return item.line, Description(item.kind, name, taken, meaning, result, is_forward, gives)
    unclear = next((each for each in _FIELDS if told[each] is _UNKNOWN), "signature")
    return Gap(item.line, f"the `{unclear}` of `{item.kind}` is computed")
