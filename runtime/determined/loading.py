"""Load a determined reactor once per process: its register code, constants and first tokens; refuse it with reasons."""

from array import array
from collections.abc import Mapping
from dataclasses import dataclass, field

from compiler.determined.analysis import analyse
from compiler.determined.assemble import compile_block
from compiler.determined.code import FOLLOW, STRIDE, TARGET, Line, RegisterBlock, RegisterLayout
from compiler.determined.model import ReactorModel
from compiler.determined.reasons import ChoiceReason, FreeChoice, UndeterminedError
from compiler.determined.relations import FOLLOWING, MERGED, PREVIOUS, ROOT, TOGETHER
from compiler.program import DomainConstant, PredicateCode, Program
from runtime.determined.machine import Machine
from runtime.determined.reading import TokenReading, outlines_of, readings_of
from runtime.determined.tables import CodeTables
from runtime.determined.tags import FAR, IS_FOLLOWING, IS_MERGED, IS_PREVIOUS, IS_TOGETHER, NONE
from runtime.determined.token_walk import BlockTokens
from runtime.executive.columns import RunOutline
from runtime.executive.record import ReactorRecord
from runtime.executive.workbench import Workbench
from runtime.plan.tags import FLAG_FACT

_FIRST_TICK = 0
# Name, kind and type of a parameter; what others were told of values of its type, None for reals.
ParameterShape = tuple[str, str, str, dict[float, DomainConstant] | None]
_FOUND = {MERGED: IS_MERGED, PREVIOUS: IS_PREVIOUS, FOLLOWING: IS_FOLLOWING}


@dataclass(frozen=True, slots=True)
class FirstToken:
    """A fact of the model's script: it holds from the first tick on."""

    line: int
    block: int
    values: Mapping[int, float]
    end: tuple[int, int]


@dataclass(eq=False, slots=True)
class RegisterProgram:
    """A reactor as register code; blocks for further sets of given parameters are added when they are asked for."""

    model: ReactorModel
    layout: RegisterLayout
    order: tuple[int, ...]
    internal: tuple[int, ...]  # own timelines in the order of the configuration
    frame: ReactorRecord  # what the record of a mission says of globals, objects and the script
    defaults: list[int] = field(default_factory=list)
    first: list[FirstToken] = field(default_factory=list)
    blocks: list[RegisterBlock | None] = field(default_factory=lambda: [None])
    numbers: dict[tuple[int, int, int], int] = field(default_factory=dict)
    code: "array[int]" = field(default_factory=lambda: array("i", bytes(4 * STRIDE)))
    starts: "array[int]" = field(default_factory=lambda: array("q", [0]))
    constants: dict[int, float] = field(default_factory=dict)  # register -> value of globals and members
    names: list[str] = field(default_factory=list)  # texts of the numbers of symbols
    read: list[tuple[TokenReading, ...]] = field(default_factory=lambda: [()])
    tokens: BlockTokens = field(default_factory=BlockTokens)
    shown: "array[int]" = field(default_factory=lambda: array("q"))  # registers, block after block
    shown_first: "array[int]" = field(default_factory=lambda: array("q", [0, 0]))
    outlines: list[tuple[tuple[RunOutline, ...], ...]] = field(default_factory=lambda: [()])  # by block, by token
    told: dict[tuple[str, str], dict[float, DomainConstant]] = field(default_factory=dict)  # by type: what others heard
    shapes: dict[str, list[ParameterShape]] = field(default_factory=dict)  # the parameters of a predicate
    initial: "array[float]" = field(default_factory=lambda: array("d", [0.0]))  # registers as a mission finds them
    tables: CodeTables = field(init=False)
    tabled: int = 0  # of how many blocks they tell

    def __post_init__(self) -> None:
        """Nothing is compiled yet."""
        self.tables = CodeTables(len(self.layout.lines))

    def block(self, line: int, predicate: PredicateCode, mask: int) -> int:
        """The number of a block, and of all that follow from it; raises `UndeterminedError`."""
        key = (line, self.model.number(predicate), mask)
        if key in self.numbers:
            return self.numbers[key]
        made = compile_block(self.model, self.layout, line, predicate, mask)
        number = len(self.blocks)
        self.numbers[key] = number
        self.blocks.append(made)
        self._show(made, readings_of(made, self.model.program.rules))
        base = len(self.code) // STRIDE
        self.starts.append(base * STRIDE)
        here = len(self.code)
        for instruction in made.instructions:
            numbers = list(instruction)
            if numbers[0] in TARGET:
                numbers[TARGET[numbers[0]]] += base
            self.code.extend(numbers)
        for k, instruction in enumerate(made.instructions):
            if instruction[0] == FOLLOW:
                _, target, _, successor, low, high, *_ = instruction
                wanted = (low & 0xFFFFFFFF) | high << 32
                follower = self.block(target, self.model.program.predicates[successor], wanted)
                self.code[here + STRIDE * k + 6] = follower
        return number

    def _show(self, made: RegisterBlock, readings: tuple[TokenReading, ...]) -> None:
        """Note which tokens a new block knows, and which registers show what it did."""
        self.read.append(readings)
        registers = [k for each in readings for body in each.bodies for k in body.registers()]
        registers += [k for token in made.tokens for k, _ in token.context]
        indices = {register: index for index, register in enumerate(dict.fromkeys(registers))}
        self.shown.extend(indices)
        self.shown_first.append(len(self.shown))
        self.outlines.append(outlines_of(readings, indices))
        for token in made.tokens:
            self.tokens.how.append(_FOUND.get(token.how, IS_TOGETHER))
            self.tokens.line.append(token.line)
            self.tokens.predicate.append(self.model.number(token.predicate))
            for register, truth in token.context:
                self.tokens.indices.append(indices[register])
                self.tokens.truths.append(truth)
            self.tokens.context.append(len(self.tokens.indices))
        self.tokens.first.append(len(self.tokens.how))

    def readings(self, number: int) -> tuple[TokenReading, ...]:
        """How the registers show what block `number` did."""
        return self.read[number]

    def name_of(self, number: int) -> str:
        """The text, enum value or object of a number."""
        return self.all_names()[number]

    def all_names(self) -> list[str]:
        """Texts, enum values and objects by number."""
        symbols = self.layout.symbols
        if len(self.names) < len(symbols):
            self.names[:] = sorted(symbols, key=lambda name: symbols[name])
        return self.names

    def begun_by(self, number: int) -> set[int]:
        """The timelines on which a block begins something, now or next."""
        block = self.blocks[number]
        assert block is not None
        return {token.line for token in block.tokens if token.how in (ROOT, TOGETHER, FOLLOWING)}

    def machine(self, world: object) -> Machine:
        """A machine on which nothing has happened yet."""
        machine = Machine(len(self.layout.lines), self.tables, world)
        for number, line in enumerate(self.layout.lines):
            machine.present.is_used[number] = line.role != "own"
        self.bring_up_to_date(machine)
        return machine

    def bring_up_to_date(self, machine: Machine) -> None:
        """Give a machine the code and the registers of blocks that were compiled since."""
        layout = self.layout
        self._fill_tables()
        if len(machine.registers) < layout.top:
            registers = array("d", self.initial)
            registers[: len(machine.registers)] = array("d", machine.registers)
            machine.registers = registers
            kept = array("d", registers)
            kept[: len(machine.kept)] = array("d", machine.kept)
            machine.kept = kept
        count = max(len(layout.samples), 1)
        if len(machine.sample_value) < count:
            missing = count - len(machine.sample_value)
            machine.sample_value = array("d", machine.sample_value) + array("d", bytes(8 * missing))
            machine.sample_until = array("q", machine.sample_until) + array("q", [NONE] * missing)
            machine.kept_value = array("d", machine.kept_value) + array("d", bytes(8 * missing))
            machine.kept_until = array("q", machine.kept_until) + array("q", [NONE] * missing)

    def _fill_tables(self) -> None:
        """What all machines share, brought up to date with the blocks that were compiled."""
        layout, tables = self.layout, self.tables
        if len(self.initial) < layout.top:
            self.initial = array("d", [float("nan")]) * layout.top
            for register, value in (*layout.presets.items(), *self.constants.items()):
                self.initial[register] = value
        if self.tabled == len(self.starts):
            return
        self.tabled = len(self.starts)
        tables.current = array("q", layout.current)
        tables.following = array("q", layout.following)
        tables.incoming = array("q", layout.incoming)
        tables.wished = array("q", layout.wished)
        tables.previous = array("q", layout.previous)
        tables.remembers = array("q", [number in layout.remembered for number in range(len(layout.lines))])
        tables.starts = array("q", layout.starts)
        tables.width = array("q", layout.widths)
        tables.size = array("q", [len(each.parameters) for each in self.model.program.predicates])
        tables.default_block = array("q", self.defaults)
        tables.order = array("q", [*self.order, *[NONE] * (len(layout.lines) - len(self.order))])
        tables.code = array("i", self.code)
        tables.block_start = array("q", self.starts)
        tables.block_predicate = array(
            "q", [NONE if each is None else self.model.number(each.predicate) for each in self.blocks]
        )
        tables.block_mask = array("q", [0 if each is None else each.mask for each in self.blocks])
        tables.block_sure = array("q", [each is not None and each.is_sure for each in self.blocks])
        tables.block_free = array("q", [each is not None and each.always_begins(layout) for each in self.blocks])
        tables.shown = array("q", self.shown or [0])
        tables.shown_first = array("q", self.shown_first)


def load_determined(
    bench: Workbench, program: Program, internal: tuple[str, ...], external: tuple[str, ...], lookahead: int
) -> tuple[RegisterProgram | None, tuple[ChoiceReason, ...]]:
    """The register code of a reactor whose script has been run in `bench`, or the choices that are in the way."""
    lines = _lines_of(bench, internal, external)
    analysis = analyse(program, lines, lookahead)
    if analysis.reasons:
        return None, analysis.reasons
    numbers = tuple(analysis.model.line_numbers[name] for name in internal)
    loaded = RegisterProgram(analysis.model, analysis.layout, analysis.order, numbers, bench.recorder.close())
    reasons: dict[ChoiceReason, None] = {}
    _load_facts(loaded, bench, reasons)
    _load_defaults(loaded, reasons)
    _load_constants(loaded, bench, reasons)
    loaded.names = sorted(loaded.layout.symbols, key=lambda name: loaded.layout.symbols[name])
    return (None, tuple(reasons)) if reasons else (loaded, ())


def _lines_of(bench: Workbench, internal: tuple[str, ...], external: tuple[str, ...]) -> tuple[Line, ...]:
    """The timelines of the model: those of the reactor first, in the order of the configuration."""
    objects = bench.database.objects.names
    found = []
    for name in (*internal, *external):
        state = bench.timeline(name, name in internal)
        default = bench.predicate_name(state.default).rpartition(".")[2] if state.default >= 0 else ""
        found.append(Line(name, _class_of(bench, name), default, "own" if name in internal else "used"))
    for name in objects:
        if name not in internal and name not in external and bench.database.plan.object_timeline[objects.index(name)]:
            found.append(Line(name, _class_of(bench, name), "", "other"))
    return tuple(found)


def _class_of(bench: Workbench, name: str) -> str:
    number = bench.database.plan.object_class[bench.database.objects.names.index(name)]
    return bench.database.program.classes[number].name


def _load_facts(loaded: RegisterProgram, bench: Workbench, reasons: dict[ChoiceReason, None]) -> None:
    """The facts of the script: each must hold at the first tick, with values or without, but not with a choice."""
    objects = bench.database.objects.names
    taken: set[int] = set()
    for t in bench.all_tokens():
        if not bench.rows.flags[t] & FLAG_FACT:
            continue
        predicate = bench.database.program.predicates[bench.predicate_of(t)]
        o = bench.object_of(t)
        line = loaded.model.line_numbers.get(objects[o], NONE) if o >= 0 else NONE
        if line < 0 or loaded.model.lines[line].role != "own":
            reasons[ChoiceReason(FreeChoice.NO_TIMELINE, predicate.name, predicate.span)] = None
            continue
        if line in taken or bench.started_at(t) != _FIRST_TICK:
            reasons[ChoiceReason(FreeChoice.LATER_FACT, predicate.name, predicate.span)] = None
            continue
        taken.add(line)
        values: dict[int, float] = {}
        for k, (name, domain) in enumerate(bench.arguments(t)):
            value = number_of(loaded.layout, domain)
            if value is not None:
                values[k] = value
            elif not is_open(domain) and domain.kind in ("int", "float"):
                reasons[ChoiceReason(FreeChoice.UNKNOWN_VALUE, f"{predicate.name}.{name}", predicate.span)] = None
        own = loaded.model.predicate(line, predicate.name.rpartition(".")[2])
        assert own is not None
        try:
            block = loaded.block(line, own, sum(1 << k for k in values))
        except UndeterminedError as obstacle:
            reasons[obstacle.reason] = None
            continue
        end = bench.end(t)
        bounds = (int(max(bench.lower(end), _FIRST_TICK + 1)), int(min(bench.upper(end), FAR)))
        loaded.first.append(FirstToken(line, block, values, bounds))


def _load_defaults(loaded: RegisterProgram, reasons: dict[ChoiceReason, None]) -> None:
    """The default token of each own timeline. One that cannot be compiled is in the way where it is the first token."""
    obstacles: dict[int, ChoiceReason] = {}
    for number, line in enumerate(loaded.model.lines):
        loaded.defaults.append(0)
        predicate = loaded.model.predicate(number, line.default) if line.role == "own" and line.default else None
        if predicate is None:
            continue
        try:
            loaded.defaults[number] = loaded.block(number, predicate, 0)
        except UndeterminedError as obstacle:
            obstacles[number] = obstacle.reason
    begun = {each.line: each.block for each in loaded.first}
    waiting = [n for n in loaded.order if loaded.model.lines[n].role == "own"]
    started: set[int] = set()
    for n in waiting:
        number = begun.get(n, 0 if n in started else loaded.defaults[n])
        if number == 0 and n not in started and n in obstacles:
            reasons[obstacles[n]] = None
        block = loaded.blocks[number]
        if block is not None:
            started |= {token.line for token in block.tokens if token.how == TOGETHER and not token.context}


def _load_constants(loaded: RegisterProgram, bench: Workbench, reasons: dict[ChoiceReason, None]) -> None:
    """Global variables and members that the code reads: they must have a value when the mission starts."""
    for index, register in loaded.layout.globals.items():
        name, type_ = loaded.model.program.globals[index]
        v = bench.database.plan.globals[index]
        _load_constant(loaded, bench, v, type_.kind, type_.type_name, register, name, reasons)
    for (name, path), register in loaded.layout.members.items():
        found = _member(bench, name, path)
        if found is None:
            reasons[ChoiceReason(FreeChoice.UNKNOWN_VALUE, f"{name}.{'.'.join(path)}", None)] = None
        else:
            text = f"{name}.{'.'.join(path)}"
            _load_constant(loaded, bench, found[0], found[1], found[2], register, text, reasons)


def _load_constant(
    loaded: RegisterProgram,
    bench: Workbench,
    v: int,
    kind: str,
    type_name: str,
    register: int,
    name: str,
    reasons: dict[ChoiceReason, None],
) -> None:
    value = number_of(loaded.layout, bench.domain(v, kind, type_name))
    if value is None:
        reasons[ChoiceReason(FreeChoice.UNKNOWN_VALUE, name, None)] = None
    else:
        loaded.constants[register] = value


def _member(bench: Workbench, name: str, path: tuple[str, ...]) -> tuple[int, str, str] | None:
    """The variable, kind and type of a member of an object, through members that are objects."""
    plan, program = bench.database.plan, bench.database.program
    objects = bench.database.objects.names
    if name not in objects:
        return None
    o = objects.index(name)
    for depth, part in enumerate(path):
        for k, each in enumerate(program.classes[plan.object_class[o]].members):
            if each.name == part:
                v = plan.object_var0[o] + k
                break
        else:
            return None
        if depth == len(path) - 1:
            return int(v), each.type.kind, each.type.type_name
        if not bench.engine.is_singleton(v):
            return None
        o = int(bench.lower(v))
    return None


def number_of(layout: RegisterLayout, domain: DomainConstant) -> float | None:
    """The number that stands for the one value of a domain; None where there are more."""
    if domain.interval is not None:
        return float(domain.interval[0]) if domain.interval[0] == domain.interval[1] else None
    values = domain.values or ()
    if len(values) != 1:
        return None
    return float(layout.symbol(values[0])) if isinstance(values[0], str) else float(values[0])


def is_open(domain: DomainConstant) -> bool:
    """Whether a domain says nothing at all: a number without bounds."""
    return domain.interval is not None and domain.interval[0] <= -FAR and domain.interval[1] >= FAR
