"""Judge what nddlc makes of a conformance case: the case and its printed object in, the differences out."""

import json
import re
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from typing import Any, NamedTuple

Facts = dict[str, Any]
Ranges = list[tuple[float, float]]

TOLERANCE = 1e-5  # between floats
MOST_RENAMINGS = 10000
BASIC_TYPES = {"int", "float", "bool", "string", "symbol"}
DOMAIN = re.compile(r"(<= )?(?:\[(.*)\]|\{(.*)\}) (\S+)( open)?", re.DOTALL)
ITEM = re.compile(r'"(?:[^"\\]|\\.)*"|[^,\s]+')
TIMES, LINKS = ("start", "duration", "end"), ("master", "merged_into")


class Domain(NamedTuple):
    """A domain text, read: numbers as disjoint ranges, other values as a set of texts."""

    is_upper: bool
    type: str
    is_open: bool
    ranges: Ranges | None
    values: set[str]


def read_domain(text: str) -> Domain:
    """Read the notation of the suite's README."""
    found = DOMAIN.fullmatch(text)
    if found is None:
        raise ValueError(f"not a domain: {text!r}")
    upper, interval, members, kind, is_open = found.groups()
    items = ITEM.findall(interval or members or "")
    if kind not in ("int", "float"):
        if interval is not None:
            raise ValueError(f"not an interval: {text!r}")
        values = {json.loads(item) if item.startswith('"') else item for item in items}
        return Domain(bool(upper), kind, bool(is_open), None, values)
    gap = 1 if kind == "int" else TOLERANCE
    numbers = [float(item) if item in ("-inf", "+inf") or kind == "float" else int(item) for item in items]
    if interval is not None and not (len(numbers) == 2 and numbers[0] <= numbers[1]):
        raise ValueError(f"not an interval: {text!r}")
    ranges: Ranges = []
    for number in sorted(numbers):  # neighbours share a range, so that {1, 2, 3} is [1, 3]
        joined = ranges and (interval is not None or number - ranges[-1][1] <= gap)
        ranges.append((ranges.pop()[0] if joined else number, number))
    return Domain(bool(upper), kind, bool(is_open), ranges, set())


def same_domain(expected: str, actual: str, enums: set[str]) -> bool:
    """Whether `actual` is the expected domain, or lies within it where that is all that is asked."""
    want, got = read_domain(expected), read_domain(actual)
    if want.is_open != got.is_open or (want.type != got.type and {want.type, got.type} & (BASIC_TYPES | enums)):
        return False  # the type names of objects are informative only
    if want.ranges is None or got.ranges is None:
        return got.values <= want.values and bool(got.values) if want.is_upper else got.values == want.values
    if want.is_upper:
        return bool(got.ranges) and all(
            any(low >= least - TOLERANCE and high <= most + TOLERANCE for least, most in want.ranges)
            for low, high in got.ranges
        )
    return len(want.ranges) == len(got.ranges) and all(
        _close(one, other)
        for mine, yours in zip(want.ranges, got.ranges, strict=True)
        for one, other in zip(mine, yours, strict=True)
    )


def _close(one: float, other: float) -> bool:
    return one == other or abs(one - other) <= TOLERANCE


# ---- tokens; those without a name have a # in their id ----


def token_differences(want: Facts, got: Facts, enums: set[str]) -> list[str]:
    """The keys in which two tokens differ, apart from the names of anonymous tokens."""
    return [key for key, value in want.items() if not _same_fact(key, value, got.get(key), enums)]


def _same_fact(key: str, want: Any, got: Any, enums: set[str]) -> bool:
    if key == "id" or (key in LINKS and "#" in (want or "") and "#" in (got or "")):
        return True  # the renamings look after these
    if key == "object" and got:
        return same_domain(want, got, enums)
    if key == "params" and got is not None:
        return want.keys() == got.keys() and all(same_domain(want[name], got[name], enums) for name in want)
    if key in TIMES and got:
        return all(_close(float(one), float(other)) for one, other in zip(want, got, strict=True))
    return bool(want == got)


def token_candidates(expected: list[Facts], actual: list[Facts], enums: set[str]) -> tuple[list[str], dict[str, Any]]:
    """The differences, and for each expected token the actual ones that it may stand for."""
    problems: list[str] = []
    candidates: dict[str, list[str]] = {}
    want, got = (Counter(token["predicate"] for token in tokens) for tokens in (expected, actual))
    for predicate in sorted(want.keys() | got.keys()):
        if want[predicate] != got[predicate]:
            problems.append(f"tokens of {predicate}: expected {want[predicate]}, got {got[predicate]}")
    if len({token["id"] for token in actual}) < len(actual):
        problems.append("tokens: an id occurs twice")
    for token in expected:
        name = token["id"]
        rivals = [rival for rival in actual if rival["id"] == name or ("#" in name and "#" in rival["id"])]
        notes = {rival["id"]: token_differences(token, rival, enums) for rival in rivals}
        candidates[name] = [rival for rival, note in notes.items() if not note]
        if not candidates[name]:
            alike = [rival for rival in rivals if rival["predicate"] == token["predicate"]]
            shown = [{key: rival.get(key) for key in notes[rival["id"]]} for rival in alike]
            wanted = {key: token.get(key) for rival in shown[:1] for key in rival}
            problems.append(f"token {name}: expected {wanted}, got {shown[:1] or 'none'}")
    return problems, candidates


def renamings(
    expected: list[Facts], actual: dict[str, Facts], candidates: dict[str, list[str]], names: dict[str, str]
) -> Iterator[dict[str, str]]:
    """All ways to extend the renaming `names` (expected id to actual id) that respect the links."""
    if len(names) == len(expected):
        yield names
        return
    name = expected[len(names)]["id"]
    for candidate in candidates[name]:
        longer = names | {name: candidate}
        if candidate not in names.values() and all(
            actual[longer[token["id"]]].get(key) == longer[token[key]]
            for token in expected[: len(longer)]
            for key in LINKS
            if token.get(key) in longer
        ):
            yield from renamings(expected, actual, candidates, longer)


# ---- cases ----


def fact_differences(want: Facts, got: Facts, enums: set[str]) -> list[str]:
    """Differences in domains, tokens and order, as far as the expectation names them."""
    domains = got.get("domains") or {}
    problems = [
        f"{key}: expected {text}, got {domains.get(key, 'no such variable')}"
        for key, text in (want.get("domains") or {}).items()
        if key not in domains or not same_domain(text, domains[key], enums)
    ]
    choices: list[dict[str, str]] = []
    if "tokens" in want:
        actual = got.get("tokens") or []
        found, candidates = token_candidates(want["tokens"], actual, enums)
        problems += found
        if not found:
            by_id = {token["id"]: token for token in actual}
            choices = list(islice(renamings(want["tokens"], by_id, candidates, {}), MOST_RENAMINGS))
            problems += [] if choices else ["tokens: no renaming respects master and merged_into"]
    if "order" in want:
        listed = {line: order for line, order in (got.get("order") or {}).items() if order}
        orders = [
            {line: [names.get(t, t) for t in o] for line, o in want["order"].items()} for names in choices or [{}]
        ]
        if listed not in [{line: order for line, order in each.items() if order} for each in orders]:
            problems.append(f"order: expected {want['order']}, got {listed}")
    return problems


def differences(want: Facts, got: Facts, enums: set[str]) -> list[str]:
    """How the printed object `got` breaks the expectation `want`; nothing if the case passes."""
    if got["load"] == "error":
        return _refusal_differences(want, got)
    if want["load"] == "error" and want.get("also_accept") != "ok":
        return [f"accepted: expected an error of kind {want.get('error_kind')} in line {want.get('line')}"]
    if want.get("consistent") is not None and got.get("consistent") is not want["consistent"]:
        return [f"consistent: expected {want['consistent']}, got {got.get('consistent')}"]
    solve = want.get("solve")
    if solve is None:
        return [] if want.get("consistent") is False else fact_differences(want, got, enums)
    result = (got.get("solve") or {}).get("result")
    if result != solve["result"]:
        return [f"result: expected {solve['result']}, got {result}"]
    return [] if solve.get("choice_order") else fact_differences(solve, got, enums)


def _refusal_differences(want: Facts, got: Facts) -> list[str]:
    first = next(complaint for complaint in got["diagnostics"] if complaint["severity"] == "error")
    if want["load"] == "ok" and want.get("also_accept") != "error":
        return [f"refused: line {first['line']}: {first['message']}"]
    if want["load"] == "error" and want.get("line") not in (None, first["line"]):
        return [f"error line: expected {want['line']}, got {first['line']}: {first['message']}"]
    if want["load"] == "error" and want.get("error_kind") not in (None, first["kind"]):
        return [f"error kind: expected {want['error_kind']}, got {first['kind']}: {first['message']}"]
    return []
