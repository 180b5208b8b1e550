"""Elaborate a block: one token that starts, with all that starts at the same tick because of it, as a worksheet."""

from itertools import pairwise

from compiler.determined import code
from compiler.determined.code import BlockToken, GuardRecord, LocalRecord, RegisterLayout, Shown, begun_with
from compiler.determined.domains import drawn, equation, within
from compiler.determined.items import Context, Item, Worksheet
from compiler.determined.model import ReactorModel, values_of
from compiler.determined.operations import DEMANDS, FUNCTIONS, Cell, Way, demand
from compiler.determined.reasons import FreeChoice, UndeterminedError
from compiler.determined.relations import FOLLOWING, MERGED, PREVIOUS, RELATIONS, ROOT, TOGETHER, RuleInstance
from compiler.determined.times import Time, demand_time, is_time_constraint
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    OBJECT,
    START,
    Assign,
    Child,
    Constant,
    DomainConstant,
    Field,
    GlobalVariable,
    Guard,
    Instruction,
    LocalVariable,
    NewVariable,
    Operand,
    Post,
    PredicateCode,
    Sample,
    TokenVariable,
    TypeCode,
)
from nddl_lang.text.source import Span


class Elaboration:
    """Walks the rules of a token and of the tokens that start with it."""

    def __init__(
        self, model: ReactorModel, layout: RegisterLayout, line: int, predicate: PredicateCode, mask: int
    ) -> None:
        self.model, self.layout = model, layout
        self.sheet = Worksheet()
        self.tokens: list[BlockToken] = []
        self.banks: list[int] = []
        self.guards: list[GuardRecord] = []
        self.locals: list[LocalRecord] = []
        self.draws: list[int] = []
        self.mask = mask
        self.sheet.given.add(0)
        self._start_token(ROOT, line, predicate, -1, -1, 0, ())
        for number, token in enumerate(self.tokens):
            if token.how == FOLLOWING:
                self._declare_follower(number, token)

    # ---- tokens ----

    def _start_token(
        self, how: str, line: int, predicate: PredicateCode, parent: int, rule: int, slot: int, context: Context
    ) -> int:
        layout = self.layout
        number = len(self.tokens)
        self.tokens.append(BlockToken(how, line, predicate, parent, rule, slot, context))
        bank = {FOLLOWING: layout.following, PREVIOUS: layout.previous}.get(how, layout.current)[line]
        self.banks.append(bank)
        name = self.model.lines[line].name
        for k, parameter in enumerate(predicate.parameters):
            self.sheet.names[bank + k] = (
                f"{name}.{predicate.name.rpartition('.')[2]}.{parameter.name}",
                parameter.span,
            )
        if how == MERGED:
            self.sheet.given.add(layout.starts[line])
        if how == FOLLOWING and layout.tells_lengths:
            self.sheet.names[self._lasting(number)] = (f"{name}.{predicate.name.rpartition('.')[2]}.duration", None)
            self.sheet.homes[self._lasting(number)] = context
        if how == ROOT and layout.tells_lengths and self.mask >> (layout.widths[line] - 1) & 1:
            lasting, span = self._lasting(number), self.model.span_of(predicate)
            self.sheet.given.add(lasting)
            self.sheet.items.append(
                Item(context, span, "duration", (lasting,), (), ((code.LAST_EXACTLY, line, lasting),))
            )
        if how in (MERGED, PREVIOUS):
            self.sheet.doubtful |= {bank + k for k in range(len(predicate.parameters))}
        if how in (ROOT, TOGETHER):
            self.sheet.given.add(layout.starts[line])
            for k, parameter in enumerate(predicate.parameters):
                self.sheet.homes[bank + k] = context
                if how == ROOT and self.mask >> k & 1:
                    self.sheet.given.add(bank + k)
                self.sheet.wanted[bank + k] = context
                if self.model.may_stay_open(parameter.type, parameter.domain):
                    self.sheet.openable.add(bank + k)
                self._declare(number, k, context)
            self._run(RuleInstance(number, -1, {0: number}), predicate.body, context)
            for index in predicate.rules:
                self._run(RuleInstance(number, index, {0: number}), self.model.program.rules[index].body, context)
        if how == FOLLOWING:
            for k in range(len(predicate.parameters)):
                self.sheet.homes[bank + k] = context
        return number

    def _declare(self, number: int, k: int, context: Context) -> None:
        """Hold a parameter within its declared domains, and equal to what its declaration says that it is."""
        predicate = self.tokens[number].predicate
        parameter = predicate.parameters[k]
        span, cell = parameter.span or self.model.span_of(predicate), Cell(self.banks[number] + k, parameter.type.kind)
        self._restrict(cell, parameter.type, parameter.domain, context, span, parameter.name)
        if parameter.copy_of is not None:
            body = RuleInstance(number, -1, {0: number})
            self._equate(cell, self._cell(parameter.copy_of, body, span), context, span, parameter.name)

    def _declare_follower(self, number: int, token: BlockToken) -> None:
        """The same of what is said of a token that follows: it is in the plan before it starts."""
        said = {register for item in self.sheet.items for register in item.needs if item.rank < 1}
        for k in range(len(token.predicate.parameters)):
            if self.banks[number] + k in said:
                self._declare(number, k, token.context)
        lasting = self._lasting(number)
        if self.layout.tells_lengths and lasting in said:
            span, check = self.model.span_of(token.predicate), (code.ORDER, self._constant(1.0), lasting)
            self.sheet.items.append(Item(token.context, span, "duration", (lasting,), (), (check,)))

    def _lasting(self, number: int) -> int:
        """The register that says how long a token lasts, where the one before it does."""
        return self.banks[number] + self.layout.widths[self.tokens[number].line] - 1

    def _child(self, child: Child, body: RuleInstance, context: Context) -> None:
        span = child.span
        what = f"{child.relation}({child.predicate.rpartition('.')[2]})"
        parent = self.tokens[body.tokens[child.origin]]
        how = RELATIONS.get(child.relation)
        if child.origin != 0 or how is None or (child.bounds and not self.model.are_usual(child)):
            raise UndeterminedError(FreeChoice.OPEN_TIMES, what, span)
        line, predicate = self.model.target(child, parent.line)
        if self.model.lines[line].role != "own" and how != MERGED:
            raise UndeterminedError(FreeChoice.ASKED_OF_OTHERS, what, span)
        if line == parent.line and how in (TOGETHER, MERGED):
            raise UndeterminedError(FreeChoice.OPEN_TIMES, what, span)
        if how == TOGETHER and any(each.line == line for each in begun_with(self.tokens, parent)):
            raise UndeterminedError(FreeChoice.MERGED, what, span)
        if how == PREVIOUS and line != parent.line:
            raise UndeterminedError(FreeChoice.OPEN_TIMES, what, span)
        if how == MERGED:
            self._act((code.MERGE, line, self.model.number(predicate)), context, span, what, -1)
        if how == PREVIOUS:
            self._act((code.PREVIOUS, line, self.model.number(predicate)), context, span, what, -1)
        if how == TOGETHER:
            self._act((code.BEGIN, line, self.model.number(predicate)), context, span, what, -1)
        number = len(self.tokens)
        body.tokens[child.slot] = number
        self._start_token(how, line, predicate, body.token, body.rule, child.slot, context)
        if child.relation in ("equals", "ends"):
            self._act((code.TIE, parent.line, line), context, span, what, 0)
        elif child.relation == "contained_by":
            self._act((code.WITHIN, parent.line, line), context, span, what, 0)
        elif child.relation == "starts_during":
            self._act((code.LAST_LEAST, line, self.layout.constant(1.0)), context, span, what, 0)
        elif how == FOLLOWING:
            bank = tuple(self.banks[number] + k for k in range(len(predicate.parameters)))
            if self.layout.tells_lengths:
                bank += (self._lasting(number),)
            act = (code.FOLLOW, line, parent.line, number)
            self.sheet.items.append(Item(context, span, what, bank, (), (act,), 1))

    # ---- bodies ----

    def _run(self, body: RuleInstance, instructions: tuple[Instruction, ...], context: Context) -> None:
        for instruction in instructions:
            self._step(instruction, body, context)

    def _step(self, instruction: Instruction, body: RuleInstance, context: Context) -> None:
        match instruction:
            case NewVariable(slot=slot, name=name, type=type_, domain=domain, copy_of=copy_of, span=span):
                cell = Cell(self.layout.take(1), type_.kind)
                body.locals[slot] = cell
                self.sheet.homes[cell.register] = context
                self.sheet.names[cell.register] = (name or span.text, span)
                if name is not None:
                    shown = Shown(name, cell.register, type_.kind, type_.type_name)
                    self.locals.append(LocalRecord(body.token, body.rule, slot, shown, context))
                    if not self.model.may_stay_open(type_, domain):
                        self.sheet.wanted[cell.register] = context
                self._restrict(cell, type_, domain, context, span, name or span.text)
                if copy_of is not None:
                    self._equate(cell, self._cell(copy_of, body, span), context, span, name or span.text)
            case Post():
                self._post(instruction, body, context)
            case Sample(target=target, parameter=parameter, span=span):
                drawn = self._operand(target, body, span)
                if isinstance(drawn, Time):
                    drawn = self._computed_time(drawn, context, span)
                assert isinstance(drawn, Cell)
                self._draw(drawn, parameter, context, span)
            case Child():
                self._child(instruction, body, context)
            case Guard():
                self._guard(instruction, body, context)
            case Assign(target=target, domain=domain, value=None, span=span) if domain is not None:
                self._assign(target, domain, body, context, span)
            case Assign(target=target, domain=None, value=value, span=span) if _is_operand(value):
                self._post(Post("eq", (target, value), None, span), body, context)  # type: ignore[arg-type]
            case _:
                raise UndeterminedError(FreeChoice.STATEMENT, instruction.span.text.split("\n")[0], instruction.span)

    def _guard(self, guard: Guard, body: RuleInstance, context: Context) -> None:
        condition = self._cell(guard.condition, body, guard.span)
        self.guards.append(GuardRecord(body.token, body.rule, condition.register, context, guard.span))
        # A condition that is never known is one that the general engine would wait for.
        self.sheet.wanted.setdefault(condition.register, context)
        for branch, truth in ((guard.then, True), (guard.otherwise, False)):
            self._run(body, branch, (*context, (condition.register, truth)))

    def _assign(
        self, target: Operand, domain: DomainConstant, body: RuleInstance, context: Context, span: Span
    ) -> None:
        constant = Constant(domain)
        if isinstance(target, TokenVariable) and target.variable in (START, END, DURATION):
            self._post(Post("eq", (target, constant), None, span), body, context)
            return
        cell = self._cell(target, body, span)
        self._restrict(cell, TypeCode(cell.kind, cell.kind, None), domain, context, span, span.text)

    def _post(self, post: Post, body: RuleInstance, context: Context) -> None:
        """One constraint: about times, an equality, a function or a comparison."""
        layout, span, name = self.layout, post.span, post.name
        operands = [self._operand(operand, body, span) for operand in post.operands]
        if is_time_constraint(operands) and name in FUNCTIONS and name != "temporalDistance":
            operands = [
                self._computed_time(each, context, span) if isinstance(each, Time) else each for each in operands
            ]
        if is_time_constraint(operands):
            for act in demand_time(layout, name, operands, self._lines_of, span):
                self.sheet.items.append(Item(context, span, span.text, act.needs, (), act.instructions))
            return
        if name in ("eq", "concurrent") and any(isinstance(each, DomainConstant) for each in operands):
            for each in operands:
                for other in operands:
                    if isinstance(each, DomainConstant) and isinstance(other, Cell):
                        self._restrict(other, TypeCode(other.kind, other.kind, None), each, context, span, span.text)
            return
        cells = []
        for each, operand in zip(operands, post.operands, strict=True):
            if not isinstance(each, Cell):
                raise UndeterminedError(FreeChoice.END, _text(operand, span), span)
            cells.append(each)
        registers = tuple(cell.register for cell in cells)
        if name in ("eq", "concurrent"):
            for first, second in pairwise(cells):
                self._equate(first, second, context, span, span.text)
        elif name == "neq" and all(cell.kind == "bool" for cell in cells):
            a, b = cells
            ways = tuple(
                Way((x.register,), (y.register,), ((code.NOT, x.register, y.register),)) for x, y in ((a, b), (b, a))
            )
            self.sheet.items.append(Item(context, span, span.text, registers, ways))
        elif name in DEMANDS and len(cells) == 2:
            self.sheet.items.append(Item(context, span, span.text, registers, (), demand(layout, name, cells)))
        elif name in FUNCTIONS and (ways := tuple(FUNCTIONS[name](layout, cells))):
            self.sheet.items.append(Item(context, span, span.text, registers, ways))
        elif name == "or":
            self._either(cells, context, span)
        else:
            raise UndeterminedError(FreeChoice.FUNCTION, name, span)

    def _computed_time(self, time: Time, context: Context, span: Span) -> Cell:
        """A register for an end or a duration that a function computes."""
        cell = Cell(self.layout.take(1), "int")
        self.sheet.homes[cell.register] = context
        for act in demand_time(self.layout, "eq", (time, cell), self._lines_of, span):
            self.sheet.items.append(Item(context, span, span.text, act.needs, (), act.instructions))
        return cell

    def _either(self, cells: list[Cell], context: Context, span: Span) -> None:
        """At least one of some truth values."""
        instructions: list[tuple[int, ...]] = []
        so_far = cells[0].register
        for cell in cells[1:]:
            result = self.layout.take(1)
            instructions.append((code.OR, result, so_far, cell.register))
            so_far = result
        instructions.append((code.HOLD, so_far))
        registers = tuple(cell.register for cell in cells)
        self.sheet.items.append(Item(context, span, span.text, registers, (), tuple(instructions)))

    def _equate(self, a: Cell, b: Cell, context: Context, span: Span, name: str) -> None:
        self.sheet.items.append(equation(self.layout, a, b, context, span, name))

    def _draw(self, target: Cell, parameter: str, context: Context, span: Span) -> None:
        number = self.layout.sample(parameter)
        self.draws.append(number)
        self.sheet.items += drawn(self.layout, target, number, context, span)

    def _restrict(
        self, cell: Cell, type_: TypeCode, given: DomainConstant | None, context: Context, span: Span, name: str
    ) -> None:
        """Hold a variable within its declared domains."""
        for domain in (type_.domain, given):
            if domain is not None:
                self.sheet.items += within(self.layout, self._constant, cell, domain, context, span, name)

    # ---- operands ----

    def _constant(self, value: float) -> int:
        register = self.layout.constant(value)
        self.sheet.given.add(register)
        return register

    def _cell(self, operand: Operand, body: RuleInstance, span: Span) -> Cell:
        found = self._operand(operand, body, span)
        if isinstance(found, Cell):
            return found
        raise UndeterminedError(FreeChoice.END, _text(operand, span), span)

    def _operand(self, operand: Operand, body: RuleInstance, span: Span) -> "Cell | Time | DomainConstant":
        layout = self.layout
        match operand:
            case Constant(domain=domain):
                allowed = values_of(domain, layout)
                if allowed is None or len(allowed) != 1:
                    return domain
                return Cell(self._constant(allowed[0]), domain.kind)
            case GlobalVariable(index=index):
                name, type_ = self.model.program.globals[index]
                if name == "AGENT_CLOCK":
                    raise UndeterminedError(FreeChoice.CLOCK, span.text.split("\n")[0], span)
                register = layout.global_variable(index)
                self.sheet.given.add(register)
                return Cell(register, type_.kind)
            case LocalVariable(slot=slot):
                if slot not in body.locals:
                    raise UndeterminedError(FreeChoice.STATEMENT, span.text.split("\n")[0], span)
                return body.locals[slot]
            case TokenVariable(token=token, variable=variable) if variable >= FIRST_PARAMETER:
                number = body.tokens[token]
                record = self.tokens[number]
                k = variable - FIRST_PARAMETER
                parameter = record.predicate.parameters[k]
                if record.how == PREVIOUS:
                    # What starts unplanned looks for its predecessor only after the present is synchronised.
                    layout.remembered.add(record.line)
                    self._act((code.PLANNED,), record.context, span, parameter.name, -1)
                if self.model.lines[record.line].role != "own" and record.how != MERGED and record.how != ROOT:
                    raise UndeterminedError(FreeChoice.ASKED_OF_OTHERS, parameter.name, span)
                return Cell(self.banks[number] + k, parameter.type.kind)
            case TokenVariable(token=token, variable=variable) if variable in (START, END, DURATION):
                record = self.tokens[body.tokens[token]]
                if variable == START and record.how in (ROOT, TOGETHER):
                    return Cell(0, "int")
                if variable == START and record.how == MERGED:
                    return Cell(layout.starts[record.line], "int")
                if variable == DURATION and record.how == FOLLOWING:
                    return Cell(self._lasting(body.tokens[token]), "int")
                if record.how in (ROOT, TOGETHER, MERGED):
                    return Time(body.tokens[token], variable)
                raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
            case Field():
                return self._member(operand, body, span)
            case _:
                raise UndeterminedError(FreeChoice.STATEMENT, span.text.split("\n")[0], span)

    def _member(self, operand: Field, body: RuleInstance, span: Span) -> Cell:
        """A member of an object that is known beforehand: a constant of the mission."""
        match operand.base:
            case TokenVariable(token=token, variable=variable) if variable == OBJECT:
                name = self.model.lines[self.tokens[body.tokens[token]].line].name
            case GlobalVariable(index=index):
                name = self.model.program.globals[index][0]
            case _:
                raise UndeterminedError(FreeChoice.STATEMENT, span.text.split("\n")[0], span)
        kind = self.model.member_kind(name, operand.members)
        if kind is None:
            raise UndeterminedError(FreeChoice.STATEMENT, span.text.split("\n")[0], span)
        register = self.layout.member(name, operand.members)
        self.sheet.given.add(register)
        return Cell(register, kind)

    def _lines_of(self, time: Time) -> int:
        return self.tokens[time.token].line

    def _act(self, instruction: tuple[int, ...], context: Context, span: Span, name: str, rank: int) -> None:
        self.sheet.items.append(Item(context, span, name, (), (), (instruction,), rank))


def _is_operand(value: object) -> bool:
    return isinstance(value, (Constant, GlobalVariable, LocalVariable, TokenVariable, Field))


def _text(operand: Operand, span: Span) -> str:
    words = {END: "end", DURATION: "duration", START: "start"}
    if isinstance(operand, TokenVariable) and operand.variable in words:
        return words[operand.variable]
    return span.text.split("\n")[0]
