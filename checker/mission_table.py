"""Take values out of one TOML table, each with its type and its limits; complain with places about all else."""

import math
import re
import sys
from collections.abc import Sequence

from checker.codes import (
    MISSING_KEY,
    OUT_OF_RANGE,
    REVERSED,
    UNKNOWN_CHOICE,
    UNKNOWN_KEY,
    WRONG_TYPE,
)
from checker.respelt import rewritten, word_in
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.nearest import begun, nearest
from nddl_lang.text.source import Anchor, Source, Span
from nddl_lang.text.toml_places import Path, Stretch
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.configuration import Bounds
from runtime.executive.outcome import SourcePlace

_MOST_TICKS = 10**12  # far from where sums of times overflow
_LARGEST = sys.float_info.max
HELD = "that can be held, below 2^51 in size"  # what is beyond counts as infinite in the engine
LEAST = math.ulp(0.0)  # of the numbers above 0
_MOST_SHOWN = 60  # characters of a value in a message
TomlTable = dict[str, object]


class MissionText:
    """A mission file's text, where its keys stand, and what is wrong with it so far."""

    def __init__(self, source: Source, places: dict[Path, Stretch]) -> None:
        self.source = source
        self.places = places
        self.elsewhere: dict[Path, Span] = {}  # what stands in another file, such as a batch file in XML
        self.diagnostics: list[Diagnostic] = []
        self.unowned: list[tuple[str, Diagnostic]] = []  # timelines that somebody names and nobody owns
        self.may_declare = False  # a key that is unknown may have been meant to say who owns a timeline
        self._anchor = Anchor(source)

    def found(self) -> tuple[Diagnostic, ...]:
        """What is wrong, in order."""
        return tuple(sorted(self.diagnostics, key=lambda diagnostic: diagnostic.span.begin))

    def span(self, begin: int, end: int) -> Span:
        """The stretch between two offsets."""
        return Span(self._anchor, begin, end)

    def key_span(self, path: Path) -> Span:
        """The key at `path`, or that of the nearest table around it."""
        while path and path not in self.places and path not in self.elsewhere:
            path = path[:-1]
        if path in self.elsewhere:
            return self.elsewhere[path]
        return self.span(*self.places[path].key) if path else self.span(0, 0)

    def entry_span(self, path: Path) -> Span:
        """The key and the value at `path`."""
        return self.span(self.places[path].key[0], self.places[path].value[1])

    def value_span(self, path: Path) -> Span:
        """The value at `path`, or the key of the nearest table around it."""
        return self.span(*self.places[path].value) if path in self.places else self.key_span(path)

    def reactor_path(self, number: int) -> Path:
        """The table of a reactor that runs a model, by its number among those: tables of reactors in code count not."""
        coded = {path[1] for path in self.places if path[:1] == ("reactor",) and path[2:] == ("code",)}
        tables = dict.fromkeys(path[1] for path in self.places if path[:1] == ("reactor",) and len(path) > 1)
        numbers = sorted(each for each in tables if isinstance(each, int) and each not in coded)
        return ("reactor", numbers[number] if number < len(numbers) else number)

    def place(self, span: Span, text: str, before: int = 0) -> SourcePlace:
        """Where a stretch begins, or so many columns before that, as reports show it with `text`."""
        name = self.source.name.replace("\\", "/").rpartition("/")[2]
        line, column = self.source.locate(span.begin)
        return SourcePlace(name, line, max(1, column - before), text)


# What other tools call keys and choices of a mission file.
_OTHER_WORDS = {
    **dict.fromkeys(("begin", "from", "earliest", "when"), "start"),
    **dict.fromkeys(("finish", "until", "latest", "deadline"), "end"),
    **dict.fromkeys(("std", "stddev", "stdev", "std_dev", "sd", "deviation"), "sigma"),
    **dict.fromkeys(("mu", "average", "loc"), "mean"),
    **dict.fromkeys(("min", "max", "bounds", "interval", "domain"), "range"),
    **dict.fromkeys(("gauss", "gaussian"), "normal"),
    **dict.fromkeys(("required", "must"), "mandatory"),
    **dict.fromkeys(("type", "sort"), "kind"),
    **dict.fromkeys(("count", "runs", "trials", "n", "number"), "missions"),
    **dict.fromkeys(("file", "source", "nddl"), "model"),
    **dict.fromkeys(("owns", "publishes"), "internal"),
    **dict.fromkeys(("uses", "subscribes"), "external"),
    **dict.fromkeys(("ticks", "duration", "horizon", "end_tick"), "final_tick"),
    **dict.fromkeys(("params", "arguments", "args"), "parameters"),
    **dict.fromkeys(("planner", "plan_cfg", "strategy"), "solver"),
    **dict.fromkeys(("delay", "lag"), "latency"),
    **dict.fromkeys(("timeout", "max_seconds"), "time_limit"),
    **dict.fromkeys(("dt", "step", "tick_length"), "tick"),
    **dict.fromkeys(("every", "period", "rhythm"), "update"),
    **dict.fromkeys(("probabilities", "probs", "odds"), "weights"),
    **dict.fromkeys(("choices", "options", "list"), "values"),
    **dict.fromkeys(("formula", "function"), "expression"),
    **dict.fromkeys(("condition", "if", "filter"), "where"),
}
# The same where the table has no such key.
_OTHER_WORDS_ELSEWHERE = {
    **dict.fromkeys(("end", "finish", "until", "latest", "deadline", "before"), "by"),
    **dict.fromkeys(("start", "begin", "since", "after", "earliest"), "from"),
    **dict.fromkeys(("limit", "max", "delay", "duration"), "ticks"),
    "horizon": "lookahead",
}
_TRUTHS = {"true": "true", "yes": "true", "on": "true", "false": "false", "no": "false", "off": "false"}
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_LEAST_LETTERS = 4  # of a key that can be told from others when it is misspelt


class Table:
    """One table under reading; `close` reports the keys that nobody asked for."""

    def __init__(
        self, text: MissionText, path: Path, values: TomlTable, caption: str, *, is_told: bool = False
    ) -> None:
        self.text = text
        self.path = path
        self.values = values
        self.caption = caption
        self.asked: list[str] = []
        self.is_told = is_told  # that it is missing as a whole
        self._missing: dict[str, Diagnostic] = {}

    def close(self) -> None:
        """Complain about each key that was not asked for, naming the one that it resembles."""
        unknown = [key for key in self.values if key not in self.asked]
        if unknown and self.path[:1] in ((), ("reactor",)):
            self.text.may_declare = True
        is_plain = len(self._missing) == len(unknown) == 1 and _meant_word(unknown[0], self.asked) is None
        lacks = next(iter(self._missing)) if is_plain else None
        if lacks is not None:  # told together
            self.text.diagnostics.remove(self._missing[lacks])
        for key in unknown:
            span = word_in(self.text.key_span((*self.path, key)), key)
            close = _meant_word(key, self.asked)
            fixes = (Fix(f"write `{close}`", (Edit(span, close),)),) if close else ()
            advice = f"did you mean `{close}`?" if close else "known keys: " + ", ".join(self.asked)
            if close is None and "parameters" in self.asked and not isinstance(self.values[key], dict):
                inner = ".".join(part for part in (*self.path, "parameters") if isinstance(part, str))
                advice += f"; parameters of the predicate stand below `[{inner}]`"
            if lacks is not None:
                advice = f"is `{lacks}` meant, which is missing? {advice}"
            self.text.diagnostics.append(UNKNOWN_KEY.at(span, key=key, table=self.caption, help=advice, fixes=fixes))

    def string(self, key: str, default: str | None = None) -> str:
        """A text; without a default the key is needed, and the text must not be empty."""
        value = self._take(key, needed=default is None)
        if isinstance(value, str):
            if default is None and not value.strip():
                self.complain_of_value(key, f'"{value}"', "a text that is not empty")
            return value
        self._complain_of_type(key, value, "a text in quotes")
        return default or ""

    def strings(self, key: str, but: str | None = None) -> tuple[str, ...]:
        """A list of texts, empty by default: also that of a misspelt key, which `close` tells of, but not of `but`."""
        value = self._take(key)
        if key not in self.values and (meant := self._misspelt(key, but)) is not None:
            value = self.values[meant]
        if isinstance(value, list) and all(isinstance(item, str) for item in value):
            return tuple(value)
        self._complain_of_type(key, value, "a list of texts", f'write ["{value}"]' if isinstance(value, str) else None)
        return (value,) if isinstance(value, str) else ()  # what hangs on it is not told too

    def flag(self, key: str) -> bool:
        """A truth value, false by default."""
        value = self._take(key)
        if isinstance(value, bool):
            return value
        meant = _TRUTHS.get(str(value).casefold())
        self._complain_of_type(key, value, "true or false", f"write `{meant}`, without quotes" if meant else None)
        return False

    def whole(self, key: str, default: int | None, minimum: int, maximum: int = _MOST_TICKS) -> int:
        """A whole number from `minimum` to `maximum`; without a default the key is needed."""
        value = self._take(key, needed=default is None)
        if isinstance(value, int) and not isinstance(value, bool):
            if minimum <= value <= maximum:
                return value
            self.complain_of_value(key, value, f"at least {minimum}" if value < minimum else f"at most {maximum}")
        else:
            self._complain_of_type(key, value, "a whole number")
            if isinstance(value, float) and math.isfinite(value):
                return max(minimum, int(value))  # so that what depends on it is not complained of
        return minimum if default is None else default

    def number(
        self, key: str, default: float, lower: float, upper: float = math.inf, *, is_finite: bool = False
    ) -> float:
        """A number from `lower` to `upper`; above 0 where `lower` is `LEAST`."""
        value = self._take(key)
        if isinstance(value, int | float) and not isinstance(value, bool):
            may_be = is_held(value) if is_finite else -_LARGEST <= value <= _LARGEST
            if lower <= value <= upper and (may_be or not is_finite):
                return float(value) if may_be else upper
            wanted = f"from {lower:g} to {upper:g}" if upper < math.inf else f"at least {lower:g}"
            if lower == LEAST:
                wanted = "greater than 0"
            if is_finite and not may_be and not lower > value:
                wanted = f"a number {HELD}" if abs(value) < math.inf else "finite"
            is_percent = (lower, upper) == (0.0, 1.0) and 1.0 < value <= 100.0
            share = f"{value / 100:g}" if is_percent else ""
            advice, written = f"{value:g} % is {share}", self.text.value_span((*self.path, key)).text
            self.complain_of_value(key, value, wanted, advice if is_percent else None, (written, share))
        else:
            self._complain_of_type(key, value, "a number")
        return default

    def numbers(self, key: str) -> tuple[float, ...]:
        """A list of finite numbers, empty by default."""
        value = self._take(key)
        if isinstance(value, list) and all(is_held(item) for item in value):
            return tuple(float(item) for item in value)
        self._complain_of_type(key, value, f"a list of finite numbers {HELD}")
        return ()

    def rows(self, key: str, width: int) -> tuple[tuple[float, ...], ...]:
        """A list of lists of `width` finite numbers, empty by default."""
        value = self._take(key)
        if not isinstance(value, list) or not all(isinstance(row, list) for row in value):
            self._complain_of_type(key, value, f"a list of rows of {width} numbers")
            return ()
        for index, row in enumerate(value):
            if len(row) != width or not all(is_held(one) for one in row):
                found = f"{len(row)}" if len(row) != width else f"what is no number {HELD}"
                span = self.text.value_span((*self.path, key, index))
                wanted = f"{width} numbers, one for each parameter"
                self.text.diagnostics.append(WRONG_TYPE.at(span, key=f"row {index + 1}", wanted=wanted, found=found))
                return ()
        return tuple(tuple(float(one) for one in row) for row in value)

    def bounds(self, key: str, *, is_finite: bool = False) -> Bounds | None:
        """A pair `[lower, upper]`, or one number for both; absent is None."""
        value = self._take(key)
        if value is None:
            return None
        if _is_number(value):
            value = [value, value]
        if not (isinstance(value, list) and len(value) == 2 and all(_is_number(item) for item in value)):
            self._complain_of_type(key, value, "a pair [lower, upper] of numbers", _as_pair(value, is_finite=is_finite))
            return None
        lower, upper = value
        if lower != lower or upper != upper:  # nan
            self.complain_of_value(key, f"[{lower}, {upper}]", "numbers at both ends")
            return None
        if lower > upper:
            span = self.text.value_span((*self.path, key))
            self.text.diagnostics.append(
                REVERSED.at(span, key=key, lower=lower, upper=upper, help=f"write [{upper}, {lower}]")
            )
            return None
        ends = (lower, upper)
        if not all(is_held(end) or abs(end) == math.inf for end in ends):
            self.complain_of_value(key, f"[{lower}, {upper}]", f"numbers {HELD}")
            return None
        if is_finite and math.inf in (-lower, upper):
            self.complain_of_value(key, f"[{lower}, {upper}]", "finite at both ends")
            return None
        return (lower, upper)

    def choice(self, key: str, choices: Sequence[str], default: str) -> str:
        """One of the words `choices`: of another one it is said which is meant, and that one is taken."""
        value = self._take(key)
        if isinstance(value, str):
            if value in choices:
                return value
            close = _meant_word(value, choices)
            span = self.text.value_span((*self.path, key))
            listed = ", ".join(choices)
            advice = f"did you mean `{close}`?" if close else None
            complaint = UNKNOWN_CHOICE.at(span, key=key, found=value, choices=listed, help=advice)
            self.text.diagnostics.append(complaint if close is None else rewritten(complaint, value, close))
            return close or default
        self._complain_of_type(key, value, "a text in quotes")
        return default

    def table(self, key: str, caption: str, *, needed: bool = False) -> "Table":
        """A table inside this one, empty if absent."""
        value = self._take(key, needed=needed)
        if isinstance(value, dict):
            return Table(self.text, (*self.path, key), value, caption)
        header = ".".join(part for part in (*self.path, key) if isinstance(part, str))
        self._complain_of_type(key, value, f"a table, [{header}]")
        return Table(self.text, (*self.path, key), {}, caption, is_told=needed)

    def tables(self, key: str, *, needed: bool = False) -> list["Table"]:
        """The items of an array of tables."""
        value = self._take(key, needed=needed)
        if isinstance(value, list) and all(isinstance(item, dict) for item in value):
            return [Table(self.text, (*self.path, key, index), item, f"[[{key}]]") for index, item in enumerate(value)]
        self._complain_of_type(key, value, f"an array of tables, [[{key}]]")
        return []

    def complain_of_missing(self, key: str) -> None:
        """Report that a key is not written, unless another one stands for it, of which `close` tells."""
        if key not in self.values and self._misspelt(key) is None:
            span = self.text.key_span(self.path)
            self._missing[key] = MISSING_KEY.at(span, table=self.caption, key=key)
            self.text.diagnostics.append(self._missing[key])

    def complain_of_type(self, key: str, wanted: str) -> None:
        """Report a value of a type that cannot be."""
        self._complain_of_type(key, self.values.get(key), wanted)

    def has(self, key: str) -> bool:
        """Whether the key is written."""
        return key in self.values

    def means(self, key: str) -> bool:
        """Whether the key is written, or another one that may be meant to be it."""
        return key in self.values or self._misspelt(key) is not None

    def complain_of_value(
        self, key: str, found: object, wanted: str, advice: str | None = None, meant: tuple[str, str] = ("", "")
    ) -> None:
        """Report a value of the right type that cannot be; of `meant` the second is to be written for the first."""
        span = self.text.value_span((*self.path, key))
        complaint = OUT_OF_RANGE.at(span, key=key, wanted=wanted, found=_short(found), help=advice)
        self.text.diagnostics.append(rewritten(complaint, *meant) if meant[1] else complaint)

    def _take(self, key: str, *, needed: bool = False) -> object:
        self.asked.append(key)
        if key not in self.values and needed and (meant := self._misspelt(key)) is not None:
            return self.values[meant]  # `close` tells
        if needed and not self.is_told:
            self.complain_of_missing(key)
        return self.values.get(key)

    def _misspelt(self, key: str, but: str | None = None) -> str | None:
        """The key that stands in the table for a longer one which is missing; `but` stands for itself."""
        other = next((each for each in self.values if _OTHER_WORDS.get(each.casefold()) == key), None)
        keys = [each for each in self.values if each != but]
        return (nearest(key, keys) if len(key) >= _LEAST_LETTERS else None) or other

    def _complain_of_type(self, key: str, value: object, wanted: str, advice: str | None = None) -> None:
        if key in self.values:
            span = self.text.value_span((*self.path, key))
            self.text.diagnostics.append(
                WRONG_TYPE.at(span, key=key, wanted=wanted, found=describe(value), help=advice)
            )


def _meant_word(word: str, known: Sequence[str]) -> str | None:
    """The one of the known words that was meant by another: misspelt, cut short, or the word of another tool."""
    others = (words.get(word.casefold()) for words in (_OTHER_WORDS, _OTHER_WORDS_ELSEWHERE))
    return nearest(word, known) or begun(word, known) or next((other for other in others if other in known), None)


def _as_pair(value: object, *, is_finite: bool) -> str | None:
    """How a range is written that is a text, or a list of other than two numbers."""
    if isinstance(value, list) and value and all(_is_number(each) for each in value):
        least, most = min(value), max(value)
        if len(value) == 1 and not is_finite:
            return f"a pair has two numbers: write [{least}, {least}], or [{least}, inf] for {least} or more"
        return f"a pair has two numbers: write [{least}, {most}]"
    numbers = _NUMBER.findall(re.sub(r"(?<=\d)\s*-\s*(?=\d)", " ", value)) if isinstance(value, str) else []
    return f"write [{numbers[0]}, {numbers[1]}]" if len(numbers) == 2 else None


def describe(value: object) -> str:
    """What kind of TOML value this is, in words."""
    match value:
        case bool():
            return "true or false"
        case int() | float():
            return f"the number {_short(value)}"
        case str():
            return f'the text "{_short(value)}"'
        case list():
            return "a list"
        case dict():
            return "a table"
        case _:
            return "a date or time"


def _short(value: object) -> str:
    """A value in so many digits as a message has room for."""
    text = str(value)
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}..."


def is_held(value: object) -> bool:
    """Whether it is a number that the engine can tell from infinity."""
    return isinstance(value, int | float) and not isinstance(value, bool) and -HALF_INF < value < HALF_INF


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
