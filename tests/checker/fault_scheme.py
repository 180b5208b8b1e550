"""Draw faults of a model by a scheme, before any is flown: `python -m tests.checker.fault_scheme SEED MODEL...`.

Twelve kinds of small mistakes, two lines of each, drawn by the seed from all lines where one of the kind can be made.
It reads texts alone and knows nothing of how causes are found. Each folder gets a `faults.toml` for `fault_study`.
"""

import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

_EACH = 2
_CONSTANT = re.compile(r"^(?:int|float)\s+([A-Z][A-Z0-9_]*)\s*=\s*(-?[\d.]+)\s*;")
_LABEL = re.compile(r"\b(?:contains|any|starts|ends|meets|met_by|before|after|contained_by)\s*\(\s*[\w.]+\s+(\w+)\s*\)")
_RELATIONS = ("before", "after", "meets", "met_by", "starts", "ends", "contains", "contained_by", "equals")
_SIGNS = {"<=": ">=", ">=": "<=", "<": ">", ">": "<", "==": "<="}
_OPERATORS = {"+": "-", "-": "+", "*": "/", "/": "*"}
_MOMENTS = {"start": "end", "end": "duration", "duration": "end"}
_PLACE = re.compile(r"(?<=[\w)]) ([-+*/]) (?=[\w(])")
_FACTOR = re.compile(r" [*/] [\w.]+(?![\w.(])")
_TRUTHS = {"true": "false", "false": "true"}


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a file, what constants its file has, and what tokens and variables its rule names."""

    file: str
    number: int
    text: str
    constants: tuple[str, ...]
    values: tuple[tuple[str, ...], ...]
    paths: tuple[str, ...]
    is_in_rule: bool


def lines_of(folder: Path) -> list[Line]:
    """All lines of the models of a folder without comments and includes."""
    found = []
    texts = {path.name: path.read_text() for path in sorted(folder.glob("*.nddl"))}
    whole = "\n".join(texts.values())
    values = tuple(
        tuple(one.strip() for one in each.split(",")) for each in re.findall(r"\benum\s+\w+\s*\{([^}]*)\}", whole)
    )
    for name, text in texts.items():
        lines = text.splitlines()
        constants = tuple(one.group(1) for line in lines if (one := _CONSTANT.match(line)))
        begun, depth = 0, 0
        for number, line in enumerate(lines, 1):
            code = line.split("//")[0]
            if re.match(r"\w+::\w+", line):
                begun = number
            end = next((at for at in range(number, len(lines)) if lines[at].startswith("}")), len(lines))
            rule = "\n".join(lines[begun - 1 : end]) if begun else ""
            is_inside = bool(begun) and depth > 0
            paths = tuple(sorted(set(re.findall(r"(?<![\w.])[a-z]\w*\.[a-z]\w*(?![\w(.])", rule)))) if is_inside else ()
            if code.strip() and not code.startswith("#"):
                found.append(Line(name, number, line, constants, values, paths, is_inside))
            depth += code.count("{") - code.count("}")
            begun = begun if depth > 0 or number == begun else 0
    return found


def faults_of(line: Line) -> Iterator[tuple[str, str]]:
    """Every fault that can be made in a line, each with its kind."""
    code, comment = line.text.split("//")[0], line.text[len(line.text.split("//")[0]) :]

    def put(first: int, last: int, new: str) -> str:
        return code[:first] + new + code[last:] + comment

    if (known := _CONSTANT.match(code)) is not None:
        number = known.group(2)
        for kind, factor in (("larger", 4.0), ("smaller", 0.25)):
            changed = float(number) * factor
            new = repr(round(changed, 6)) if "." in number else str(round(changed))
            yield kind, put(*known.span(2), new)
    if not line.is_in_rule:
        return
    for found in re.finditer(r"\b[A-Z][A-Z0-9_]+\b", code):
        if found.group() in line.constants and "sampledParameter" not in code:
            others = (one for one in line.constants if one != found.group())
            yield from (("constant", put(*found.span(), one)) for one in others)
    for found in re.finditer(r"<=|>=|==|<|>", code):
        yield "comparison", put(*found.span(), _SIGNS[found.group()])
    for found in _PLACE.finditer(code):
        yield "operator", put(*found.span(1), _OPERATORS[found.group(1)])
    for found in re.finditer(rf"\b({'|'.join(_RELATIONS)})\b(?=\s*\(|\s+\w+\s*;)", code):
        others = (one for one in _RELATIONS if one != found.group(1))
        yield from (("relation", put(*found.span(1), one)) for one in others)
    for found in re.finditer(r"(?<![\w])(start|end|duration)\b", code):
        yield "moment", put(*found.span(1), _MOMENTS[found.group(1)])
    for found in _FACTOR.finditer(code):
        yield "less a factor", put(*found.span(), "")
    if (ended := re.search(r"(?<=[\w)])\s*;\s*$", code)) is not None and re.search(r"<=|>=|==|<|>", code):
        for one in line.constants:
            yield "one factor more", put(ended.start(), ended.start(), f" * {one}")
    if re.search(r"<=|>=|==|<|>|\bcontains\b|\bbefore\b", code) and code.rstrip().endswith(";"):
        yield "gone", ""
    for found in re.finditer(r"\b(true|false)\b", code):
        yield "value", put(*found.span(), _TRUTHS[found.group()])
    for values in line.values:
        for found in re.finditer(r"\b[a-z]\w*\b", code):
            if found.group() in values:
                yield from (("value", put(*found.span(), one)) for one in values if one != found.group())
    for found in re.finditer(r"(?<![\w.])[a-z]\w*\.([a-z]\w*)(?![\w(.])", code):
        if found.group(1) in _MOMENTS:
            continue
        alike = (one for one in line.paths if one != found.group() and one.rpartition(".")[2] not in _MOMENTS)
        yield from (("name", put(*found.span(), one)) for one in alike)


def drawn(folder: Path, seed: int) -> str:
    """The file of faults."""
    chance = np.random.default_rng(seed)
    kinds: dict[str, dict[tuple[str, int], list[tuple[Line, str]]]] = {}
    for line in lines_of(folder):
        for kind, new in faults_of(line):
            kinds.setdefault(kind, {}).setdefault((line.file, line.number), []).append((line, new))
    told = [f"# Faults drawn by tests/checker/fault_scheme.py, seed {seed}, before any of them was flown."]
    for kind, places in sorted(kinds.items()):
        chosen = [list(places.values())[at] for at in chance.permutation(len(places))[:_EACH]]
        for edits in chosen:
            line, new = edits[int(chance.integers(len(edits)))]
            told.append(
                f'\n[[fault]]\nkind = "{kind}"\nfile = "{line.file}"\nline = {line.number}\n'
                f"old = {json.dumps(line.text.strip())}\nnew = {json.dumps(new.strip())}"
            )
    return "\n".join(told) + "\n"


def main() -> None:
    """Write the faults of each model that is named."""
    for name in sys.argv[2:]:
        text = drawn(Path(name), int(sys.argv[1]))
        (Path(name) / "faults.toml").write_text(text)
        print(f"{name}: {text.count('[[fault]]')} faults")


if __name__ == "__main__":
    main()
