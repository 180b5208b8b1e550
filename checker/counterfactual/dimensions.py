"""The lines of models in; out: whether a line ties quantities of different dimensions, by dimensional analysis.

Each variable and constant has an unknown dimension; times have one. A product adds dimensions, what is summed or
compared has one (`mulEq(speed, time, HEIGHT)`: that of a height is that of a speed and that of a time). A line is odd
that ties quantities which all others leave apart, and one that they imply is likely meant so. What a single line
speaks of has the dimension that this line gives it. (Kennedy, Types for Units-of-Measure; by Gaussian elimination,
exponents are small.)
"""

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Container, Iterable, Mapping, Sequence

from checker.mutation.edits import EditSite, SmallEdit
from compiler.program import TOKEN_TIMES
from nddl_lang.semantics.constraints import CONSTRAINTS

_TOKEN = re.compile(r"[A-Za-z_][\w.]*|\d+\.\d*|\d+|==|!=|<=|>=|[-+*/()<>,]")
_LABELLED = re.compile(r"\(\s*([A-Za-z_][\w.]*)\s+(\w+)\s*\)")
_DECLARED = re.compile(r"(?:int|float)\s+(\w+)\s*(?:=(.*))?;", re.DOTALL)
_COMPARING = ("==", "!=", "<=", ">=", "<", ">")
_THROUGH = ("ceil", "floor", "round", "abs", "sampledParameter", "min", "max")
_TRUTHS = ("true", "false")
_PRODUCTS = ("mulEq", "multEq")
_SUMS = ("addEq", "eq", "neq", "leq", "lt", "subEq", "diffEq")
_TIME: object = "time"
_SMALL = 1e-9

# Exponents by quantity; None where nothing is known of it.
_Vector = Mapping[object, float]
_Dimension = _Vector | None


class Dimensions:
    """What all lines say of dimensions; `constants` are the global variables."""

    def __init__(self, sites: Sequence[EditSite], constants: Container[str]) -> None:
        self._constants = constants
        self._labels: dict[object, dict[str, str]] = defaultdict(dict)
        self._locals: dict[object, set[str]] = defaultdict(set)
        for site in sites:
            for predicate, label in _LABELLED.findall(site.text):
                self._labels[_scope(site)][label] = predicate.rpartition(".")[2]
            if site.rule and (declared := _DECLARED.match(site.text)) is not None:
                self._locals[_scope(site)].add(declared.group(1))
        self._said = {site: self._equations(site, site.text) for site in sites if not site.is_rule}
        self._rest: dict[EditSite, tuple[list[_Vector], Counter[object]]] = {}

    def gain(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where a line is odd and an edit puts that right, -1 where it makes the line odd, else 0."""
        if not 0 <= edit.begin - site.begin <= edit.end - site.begin <= len(site.text):
            return 0
        return self._oddness(site, self._said.get(site, [])) - self._oddness(
            site, self._equations(site, site.after(edit))
        )

    def _oddness(self, site: EditSite, said: Sequence[_Vector]) -> int:
        """1 where a line ties what the others leave apart."""
        if not said:
            return 0
        if site not in self._rest:
            others = [one for other, each in self._said.items() if other is not site for one in each]
            self._rest[site] = _echelon(others), Counter(key for one in others for key in one)
        basis, uses = self._rest[site]
        for one in said:
            left = _reduced(one, basis)
            if left and all(uses[key] for key in one):
                return 1
        return 0

    def _equations(self, site: EditSite, text: str) -> list[_Vector]:
        """What a line says: sums of exponents that are 0."""
        if site.named or not text:
            return []
        reader = _Reader(text, lambda name: self._quantity(name, site))
        return reader.equations()

    def _quantity(self, name: str, site: EditSite) -> object:
        """What a name in a line stands for; None for truth values, and for what is no number."""
        label, _, last = name.rpartition(".")
        labels = self._labels[_scope(site)]
        if name in _TRUTHS:
            return None
        if last in TOKEN_TIMES and label in ("", *labels):
            return _TIME
        if label in labels:
            return ("parameter", labels[label], last)
        if label:
            return ("member", last)
        if name in self._locals[_scope(site)]:
            return ("local", _scope(site), name)
        if name in self._constants:
            return ("constant", name)
        return ("parameter", site.rule.rpartition(".")[2], name)


class _Reader:
    """Reads the dimensions of one line, by recursive descent."""

    def __init__(self, text: str, quantity: Callable[[str], object]) -> None:
        declared = _DECLARED.fullmatch(text)
        if declared is not None:
            text = f"{declared.group(1)} == {declared.group(2)}" if declared.group(2) else ""
        self._tokens = _TOKEN.findall(text)
        self._at = 0
        self._quantity = quantity
        self._found: list[_Vector] = []

    def equations(self) -> list[_Vector]:
        """What the line says."""
        self._expression()
        return [one for one in self._found if one]

    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _take(self) -> str:
        token = self._next()
        self._at += 1
        return token

    def _equal(self, one: _Dimension, other: _Dimension) -> _Dimension:
        if one is not None and other is not None:
            self._found.append(_sum(one, other, -1.0))
        return one if one is not None else other

    def _expression(self) -> _Dimension:
        """A comparison: its sides have one dimension, and itself has none that counts."""
        found = self._total()
        while self._next() in _COMPARING:
            self._take()
            self._equal(found, self._total())
            found = None
        return found

    def _total(self) -> _Dimension:
        is_share = self._next() == "1.0"  # `1.0 - dust`
        found = self._product()
        while self._next() in ("+", "-"):
            self._take()
            found = self._equal({} if is_share else found, self._product())
        return found

    def _product(self) -> _Dimension:
        found = self._factor()
        while self._next() in ("*", "/"):
            sign = 1.0 if self._take() == "*" else -1.0
            other = self._factor()
            found = None if found is None or other is None else _sum(found, other, sign)
        return found

    def _factor(self) -> _Dimension:
        token = self._take()
        if token == "-":
            return self._factor()
        if token == "(":
            found = self._expression()
            self._take()
            return found
        if self._next() == "(" and token and (token[0].isalpha() or token[0] == "_"):
            return self._call(token)
        if token[:1].isdigit() or not token or not (token[0].isalpha() or token[0] == "_"):
            return None  # a number may be of any dimension
        quantity = self._quantity(token)
        return None if quantity is None else {quantity: 1.0}

    def _call(self, name: str) -> _Dimension:
        self._take()
        arguments = []
        while self._next() not in (")", ""):
            arguments.append(self._expression())
            if self._next() == ",":
                self._take()
            elif self._next() != ")":
                break
        self._take()
        known = CONSTRAINTS.get(name)
        name = known.name if known is not None else name
        if name in _PRODUCTS and len(arguments) == 3 and arguments[0] is not None and arguments[1] is not None:
            self._equal(_sum(arguments[0], arguments[1], 1.0), arguments[2])
        elif name in _SUMS or name in _THROUGH:
            found: _Dimension = None
            for one in arguments:
                found = self._equal(found, one)
            return found if name in _THROUGH else None
        return None


def _sum(one: _Vector, other: _Vector, sign: float) -> _Vector:
    total = dict(one)
    for key, exponent in other.items():
        total[key] = total.get(key, 0.0) + sign * exponent
    return {key: exponent for key, exponent in total.items() if abs(exponent) > _SMALL}


def _echelon(equations: Iterable[_Vector]) -> list[_Vector]:
    """A basis of what equations say, each with a quantity first that those after it do not have."""
    basis: list[_Vector] = []
    for one in equations:
        left = _reduced(one, basis)
        if left:
            basis.append(left)
    return basis


def _reduced(one: _Vector, basis: Iterable[_Vector]) -> _Vector:
    """What is left of an equation beside others; nothing where they imply it."""
    for other in basis:
        first = next(iter(other))
        if first in one:
            one = _sum(one, other, -one[first] / other[first])
    return one


def _scope(site: EditSite) -> object:
    return site.file, site.scope
