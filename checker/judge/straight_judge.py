"""Judge single tokens by straight code, written once for each predicate; what does not plainly hold is left over."""

from collections.abc import Callable, Sequence

from checker.judge.bench import Bench
from checker.judge.bodies import Written
from checker.judge.operands import VariableNames
from checker.judge.row_code import UnwrittenError
from checker.judge.steps import Domain, domain_test
from checker.judge.straight_code import ByKey, StraightText, StraightWriter, finish, standing_for
from checker.judge.straight_steps import compile_straight, in_turn
from compiler.program import FIRST_PARAMETER, OBJECT, PredicateCode, Program
from runtime.executive.record import TokenRecord

_Straight = Callable[[TokenRecord, ByKey, Bench], tuple[int, int] | None]


class StraightJudge:
    """The straight code of all predicates of a program, written when first asked for."""

    def __init__(self, program: Program, written: Written, codes: dict[str, PredicateCode]) -> None:
        self.program = program
        self.written = written
        self.codes = codes
        self._known: dict[str, _Straight | None] = {}

    def judge(self, bench: Bench, tokens: Sequence[TokenRecord]) -> list[TokenRecord]:
        """Judge tokens that plainly hold; the others come back, in their order."""
        by_key, last, known = bench.tokens.by_key, bench.last_tick, self._known
        if len(by_key) < len(tokens):
            return list(tokens)
        left = []
        judged = opened = 0
        for one in tokens:
            state = one[3]
            if state == "active":
                name, start = one[1], one[5]
                if not isinstance(start, int):
                    left.append(one)
                    continue
                if start > last:
                    continue
                if name not in known:
                    known[name] = self._written(self.codes[name])
                code = known[name]
                found = None if code is None else code(one, by_key, bench)
                if found is not None:
                    judged += found[0]
                    opened += found[1]
                    continue
            elif state == "merged":
                if _is_merged_rightly(one, by_key):
                    judged += 1
                    continue
            else:
                continue
            left.append(one)
        bench.judged += judged
        bench.open += opened
        return left

    def _written(self, known: PredicateCode) -> _Straight | None:
        """The code of all that is judged of a token; None where there is none."""
        names = self._names(known.name)
        text = StraightText()
        writer = StraightWriter(text, names, self.written)
        try:
            self._write_own(known, writer, names)
            writer.count()
            for index, number in enumerate(known.rules):
                rule = self.program.rules[number]
                inner = StraightWriter(text, self._names(rule.predicate), self.written)
                run = inner.named(f"t[12][{index}]", "").text
                inner.refuse_if(f"{run}[0] != {number}")
                steps = compile_straight(rule.body, inner.names, self.written)
                inner.follow(run, in_turn(steps))
        except UnwrittenError:
            return None
        return finish(text)

    def _names(self, predicate: str) -> VariableNames:
        names = VariableNames(self.program)
        names.tokens[0] = ("", predicate)
        return names

    def _write_own(self, known: PredicateCode, writer: StraightWriter, names: VariableNames) -> None:
        """Times, parameters and object of a token, and the body of its predicate."""
        least = 0 if known.is_event else 1
        writer.refuse_if(f"t[10] == 'cut' or len(t[12]) != {len(known.rules)}")
        writer.emit("a, b = t[5], t[6]")
        writer.emit("if a.__class__ is int is b.__class__:")
        writer.emit(f"    if t[4] != b - a or b - a < {least}: return None")
        writer.emit(f"elif not lasts_rightly(t, {least}): return None")
        writer.judged += 1
        for k, parameter in enumerate(known.parameters):
            test = domain_test(parameter.type, parameter.domain, names)
            if test is not None:
                writer.need_allowed(test, writer.variable(0, FIRST_PARAMETER + k))
        writer.need_allowed(Domain((), known.class_name, names), writer.variable(0, OBJECT))
        writer.judged += bool(known.rules)  # that these have fired
        in_turn(compile_straight(known.body, names, self.written))(writer)


def _is_merged_rightly(one: TokenRecord, by_key: ByKey) -> bool:
    """Whether a merged token has the very values of the one that stands for it."""
    other = standing_for(by_key, one)
    return (
        other is not one
        and one.fate != "cut"
        and one.predicate == other.predicate
        and one.start == other.start
        and one.end == other.end
        and one.arguments == other.arguments
    )
