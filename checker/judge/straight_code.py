"""Straight code for single tokens: a writer of Python text, in which a value that is not of its kind ends a judgement.

What is written says of one token either how much of it was judged, and all of that plainly holds, or nothing (None).
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from checker.judge.bench import Tok, clock
from checker.judge.bodies import Written
from checker.judge.columns import FLOAT, INT, TEXT
from checker.judge.meanings import Meaning, is_true
from checker.judge.operands import VariableNames, domain_value
from checker.judge.row_code import UnwrittenError, kind_of
from checker.judge.steps import Domain
from checker.judge.values import difference, hull, is_near, is_open, lies_within, may_be_equal
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    OBJECT,
    START,
    STATE,
    Constant,
    GlobalVariable,
    LocalVariable,
    Operand,
    TokenVariable,
    TypeCode,
)
from runtime.executive.record import TokenRecord, Value, ValueRange

ByKey = Mapping[int, TokenRecord]
OPEN = "?"  # the kind of what may be open: it goes to the meanings of constraints alone
_LONGEST = float("inf")
_DEEPEST = 64  # merged into what is merged into ...
_AT = {field: k for k, field in enumerate(TokenRecord._fields)}
_PLACE = {OBJECT: _AT["object"], START: _AT["start"], END: _AT["end"], DURATION: _AT["duration"]}
_CLASSES = {"float": "float", "int": "int", "bool": "bool"}


def standing_for(by_key: ByKey, record: TokenRecord) -> TokenRecord:
    """The token that stands for one that is merged."""
    for _ in range(_DEEPEST):
        other = by_key.get(record.merged_into)
        if other is None:
            break
        record = other
    return record


def lasts_rightly(record: TokenRecord, least: int) -> bool:
    """Whether the times of a token make its duration, which is not too short, as far as they are known."""
    length = difference(record.end, record.start)
    is_known = isinstance(record.duration, int) or not isinstance(length, int)
    return is_known and lies_within(length, least, _LONGEST) and may_be_equal(record.duration, length)


def _may_relate(a: Value, b: Value, lower: float, upper: float) -> bool:
    """Whether two times of which one is open may be related; where one determines the other it should not be."""
    if lower == upper and (isinstance(a, int) or isinstance(b, int)):
        return False
    gap = hull(difference(b, a))
    return gap is None or (gap[0] <= upper and lower <= gap[1])


class Named(NamedTuple):
    """A value by the text that stands for it, and its kind."""

    text: str
    kind: str


class StraightText:
    """The text of a function in the making, and the values that it names."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.scope: dict[str, object] = {
            "is_near": is_near,
            "standing_for": standing_for,
            "lasts_rightly": lasts_rightly,
            "may_relate": _may_relate,
            "is_true": is_true,
            "clock": lambda bench, record: clock(bench, Tok(record)),
        }
        self.skipped: list[str] = []
        self.count = 0

    def fresh(self, letter: str) -> str:
        """A name of its own."""
        self.count += 1
        return f"{letter}{self.count}"

    def value(self, value: object) -> str:
        """The text for a value: a literal where there is one, else a name."""
        if isinstance(value, (bool, int, str)) or (isinstance(value, float) and value - value == 0.0):
            return f"({value!r})"
        name = self.fresh("k")
        self.scope[name] = value
        return name


class StraightWriter:
    """Writes what is judged of one body: what its slots and tokens are called there, and what was judged so far."""

    def __init__(self, text: StraightText, names: VariableNames, written: Written) -> None:
        self.text = text
        self.names = names
        self.written = written
        self.indent = 1
        self.judged = 0  # since this was last written
        self.slots: dict[int, Named] = {}
        self.tokens: dict[int, tuple[str, str]] = {0: ("t", names.tokens[0][1])}  # with their predicates
        self.read: dict[tuple[int, int], Named] = {}  # variables of tokens; of token -1 global ones
        self.run = ""  # the run that is followed
        self.many = [0, 0, 0]  # locals, children and guards that were taken of it

    # ---- text ----

    def emit(self, line: str) -> None:
        """Add a line."""
        self.text.lines.append("    " * self.indent + line)

    def refuse_if(self, condition: str) -> None:
        """Whatever does not plainly hold ends the judgement."""
        self.emit(f"if {condition}: return None")

    def named(self, expression: str, kind: str) -> Named:
        """A value with a name."""
        name = self.text.fresh("v")
        self.emit(f"{name} = {expression}")
        return Named(name, kind)

    def count(self) -> None:
        """Write how much was judged."""
        if self.judged:
            self.emit(f"j += {self.judged}")
            self.judged = 0

    # ---- runs ----

    def follow(self, run: str, write: Callable[["StraightWriter"], None]) -> None:
        """Write what follows a run: it has as many locals, children and guards as are taken."""
        self.run = run
        lines = self.text.lines
        at = len(lines)
        self.emit(f"{run}l, {run}c, {run}g = {run}[1:]")
        self.emit("")
        write(self)
        sizes = zip("lcg", self.many, strict=True)
        lines[at + 1] += f"if {' or '.join([f'len({run}{part}) != {many}' for part, many in sizes])}: return None"
        self.count()

    def take(self, part: int) -> str:
        """The next local (0), child (1) or guard (2) of the run."""
        if not self.run:
            raise UnwrittenError
        self.many[part] += 1
        return f"{self.run}{'lcg'[part]}[{self.many[part] - 1}]"

    def branch(self) -> "StraightWriter":
        """The writer of a branch, with slots and tokens of its own."""
        inner = StraightWriter(self.text, self.names, self.written)
        inner.indent = self.indent + 1
        inner.slots, inner.tokens, inner.read = dict(self.slots), dict(self.tokens), dict(self.read)
        return inner

    # ---- values ----

    def plain(self, expression: str, type_kind: str) -> Named:
        """A value of the record, which must be a single one of its type."""
        found = self.named(expression, kind_of(type_kind))
        self.refuse_if(f"{found.text}.__class__ is not {_CLASSES.get(type_kind, 'str')}")
        return found

    def operand(self, operand: Operand) -> Named:
        """The value of an operand."""
        match operand:
            case Constant(domain=domain):
                return self.constant(domain_value(domain))
            case GlobalVariable(index=index) if index != self.names.clock:
                known = self.read.get((-1, index))
                if known is None:
                    type_kind = self.names.program.globals[index][1].kind
                    known = self.read[(-1, index)] = self.plain(f"bench.globals[{index}]", type_kind)
                return known
            case GlobalVariable():
                return self.named("clock(bench, t)", OPEN)
            case LocalVariable(slot=slot) if slot in self.slots:
                return self.slots[slot]
            case TokenVariable(token=token, variable=variable) if variable != STATE and token in self.tokens:
                return self.variable(token, variable)
            case _:
                raise UnwrittenError

    def constant(self, value: Value) -> Named:
        """A value that is written in the model."""
        if is_open(value):
            raise UnwrittenError
        kind = TEXT if isinstance(value, str) else FLOAT if isinstance(value, float) else INT
        return Named(self.text.value(value), kind)

    def variable(self, token: int, variable: int) -> Named:
        """A variable of a token, which is read once."""
        known = self.read.get((token, variable))
        if known is None:
            known = self.read[(token, variable)] = self._read(token, variable)
        return known

    def _read(self, token: int, variable: int) -> Named:
        name, predicate = self.tokens[token]
        if variable == DURATION:
            end, start = (self.variable(token, each) for each in (END, START))
            return self.named(f"{end.text} - {start.text}", INT)
        if variable in (START, END, OBJECT):
            return self.plain(f"{name}[{_PLACE[variable]}]", "string" if variable == OBJECT else "int")
        parameters = self.names.predicates[predicate].parameters
        number = variable - FIRST_PARAMETER
        if not 0 <= number < len(parameters):
            raise UnwrittenError
        return self.plain(f"{name}[{_AT['arguments']}][{number}]", parameters[number].type.kind)

    def local(self, type_: TypeCode) -> Named:
        """The next named variable of the run."""
        return self.plain(self.take(0), type_.kind)

    # ---- judgements ----

    def call(self, function: Callable[..., object], values: list[Named]) -> str:
        """The text that calls a function."""
        return f"{self.text.value(function)}({', '.join([each.text for each in values])})"

    def need(self, meaning: Meaning, values: list[Named]) -> None:
        """A constraint must hold by its meaning."""
        self.refuse_if(f"{self.call(meaning, values)} is not True")

    def need_equal(self, a: Named, b: Named) -> None:
        """Two values must be equal."""
        self.refuse_if(f"not ({equal_text(a, b)})")

    def need_allowed(self, test: Domain, held: Named) -> None:
        """A declaration must allow a value; this is one judgement."""
        if held.kind == OPEN:
            raise UnwrittenError
        self.judged += 1
        if test.class_name:
            if held.kind != TEXT:
                raise UnwrittenError
            classes = [code.name for code in self.names.program.classes]
            kinds = frozenset(each for each in classes if self.names.is_kind_of(each, test.class_name))
            self.refuse_if(f"{held.text} not in members or members[{held.text}][0] not in {self.text.value(kinds)}")
            return
        for limit in test.limits:
            if isinstance(limit, ValueRange):
                if held.kind == TEXT:
                    raise UnwrittenError
                self.refuse_if(f"not {self.text.value(limit.lower)} <= {held.text} <= {self.text.value(limit.upper)}")
            else:
                values = frozenset(limit.values if isinstance(limit, tuple) else (limit,))
                self.refuse_if(f"{held.text} not in {self.text.value(values)}")


def is_exact(*values: Named) -> bool:
    """Whether values are equal only if they are the same: names, and whole numbers."""
    return all(each.kind == TEXT for each in values) or all(each.kind == INT for each in values)


def equal_text(a: Named, b: Named) -> str:
    """The text that says whether two values are equal."""
    if (a.kind == TEXT) != (b.kind == TEXT) or OPEN in (a.kind, b.kind):
        raise UnwrittenError
    same = f"{a.text} == {b.text}"
    return same if is_exact(a, b) else f"{same} or is_near({a.text}, {b.text})"


def finish(text: StraightText) -> Callable[..., tuple[int, int] | None]:
    """The function of a text."""
    head = ["def judge(t, by_key, bench):", "    members = bench.members", "    j = o = 0"]
    tail = [f"    bench.skip({reason!r})" for reason in text.skipped]
    source = "\n".join([*head, *text.lines, *tail, "    return j, o", ""])
    exec(compile(source, "<straight code>", "exec"), text.scope)
    return text.scope["judge"]  # type: ignore[return-value]
