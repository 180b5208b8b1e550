"""Sites in, the same out with edits of what comes next on a timeline.

Where all other rules of a class say which token their own one meets, a rule that says nothing may lack it. A rule that
asks for one more token of its own kind with the same arguments, under a condition on one of them, never ends doing so.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Container, Iterator, Sequence
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind

_MEETS = re.compile(r"\s*meets\s*\(\s*object\s*\.\s*(\w+)\s+\w+\s*\)\s*;")
_NEXT = re.compile(r"\s*(?:meets|before)\s*\(\s*object\s*\.\s*(\w+)\s+(\w+)\s*\)\s*;")
_HANDED_ON = re.compile(r"\s*(\w+)\.(\w+)\s*==\s*(\w+)\s*;")
_COMPARED = re.compile(r"([\w.]+)\s*([<>])=?\s*([\w.]+)")
_LABEL = "following"

_Scope = tuple[str, tuple[int, int]]


def with_successors(sites: Sequence[EditSite]) -> list[EditSite]:
    """All sites; a rule without a word of what it meets, and a chain that does not advance, have edits that say so."""
    numbers = {(site.file, site.scope): {name for name, _ in site.inputs} for site in sites if site.is_rule}
    rules: dict[_Scope, list[EditSite]] = defaultdict(list)
    for site in sites:
        if not site.is_rule and (site.file, site.scope) in numbers:
            rules[site.file, site.scope].append(site)
    found: dict[EditSite, list[SmallEdit]] = defaultdict(list)
    wanted: dict[EditSite, set[tuple[int, str]]] = defaultdict(set)
    for scope, lines in rules.items():
        lines.sort(key=lambda one: one.begin)
        for site, edit in _advanced(lines, numbers[scope]):
            found[site].append(edit)
            wanted[site].add((edit.begin, edit.new))
    for lines, predicates in _silent(rules):
        last = _last_outside(lines)
        if last is not None:
            at = last.begin + len(last.text)
            line = last.first + last.text.count("\n")
            found[last] += [
                SmallEdit(EditKind.LINE, last.file, at, at, "", f" meets(object.{one} {_LABEL});", line)
                for one in predicates
            ]
    return [
        replace(site, edits=(*site.edits, *found[site]), wanted=site.wanted | wanted[site]) if site in found else site
        for site in sites
    ]


def _silent(rules: dict[_Scope, list[EditSite]]) -> Iterator[tuple[list[EditSite], list[str]]]:
    """The rules that do not say what comes next where all others of their class do, each with what they may meet."""
    classes: dict[tuple[str, str], list[list[EditSite]]] = defaultdict(list)
    for (file, _), lines in rules.items():
        classes[file, lines[0].rule.rpartition(".")[0]].append(lines)
    for group in classes.values():
        met = [{one.group(1) for site in lines if (one := _MEETS.fullmatch(site.text))} for lines in group]
        if sum(not each for each in met) != 1 or len(group) < 2:
            continue
        names = [lines[0].rule.rpartition(".")[2] for lines in group]
        at = next(number for number, each in enumerate(met) if not each)
        named = Counter(name for each in met for name in sorted(each))
        before = [name for name, each in zip(names, met, strict=True) if names[at] in each]
        left = [name for name in names if not named[name]]  # nothing leads there
        found = dict.fromkeys((*before, *(name for name, _ in named.most_common()), *left))
        yield group[at], [name for name in found if name != names[at]]


def _last_outside(lines: Sequence[EditSite]) -> EditSite | None:
    """The last statement of a rule before its first condition."""
    found = None
    for site in lines:
        if not site.text.rstrip().endswith(";"):
            break
        found = site
    return found


def _advanced(lines: Sequence[EditSite], numbers: set[str]) -> Iterator[tuple[EditSite, SmallEdit]]:
    """Of a chain whose next token has the arguments of its own one: what a condition compares, one step further on."""
    own = lines[0].rule.rpartition(".")[2]
    for child in lines:
        asked = _NEXT.fullmatch(child.text)
        if asked is None or asked.group(1) != own:
            continue
        said = [
            (site, one) for site in lines if (one := _HANDED_ON.fullmatch(site.text)) and one.group(1) == asked.group(2)
        ]
        others = [
            site for site in lines if re.match(rf"\s*{asked.group(2)}\.(?!start|end|duration)\w+\s*==", site.text)
        ]
        if len(others) != len(said) or any(one.group(2) != one.group(3) for _, one in said):
            continue  # something about it is another one
        conditions = [site.text for site in lines if not site.text.rstrip().endswith(";")]
        for site, one in said:
            steps = {sign for text in conditions for sign in _steps(one.group(2), numbers, text)}
            if one.group(2) in numbers and len(steps) == 1:
                yield site, site.edit(EditKind.MISSING, *one.span(3), f"{one.group(3)} {steps.pop()} 1")


def _steps(name: str, numbers: Container[str], condition: str) -> Iterator[str]:
    """The sign of the steps by which a number comes nearer to what it is compared with: the first of two counts."""
    for left, sign, right in _COMPARED.findall(condition):
        if name == (left if left in numbers else right):
            yield "+" if (sign == "<") is (name == left) else "-"
