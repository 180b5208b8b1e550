"""Which words are meant how often in which sort of line: relations, comparisons and signs."""

import re

from checker.counterfactual.affinity import WORD
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from compiler.program import TOKEN_TIMES

EVENTS = ("consume", "produce")
TRUTHS = ("true", "false")
SAMPLED = re.compile(r"sampledParameter\s*\(\s*(\w+)")
_POINTS = re.compile(r"(\w+\.)?(start|end)\s*[<>=!]+\s*(\w+\.)?(start|end)\s*;")  # two ends of tokens
_TARGET = re.compile(r"\(\s*[\w.]+")
_BEFORE, _AFTER = re.compile(r"([\w.]+)\s*$"), re.compile(r"\s*([\w.]+)")
_REAL = re.compile(r"\d\.\d|\d\.(?!\w)")
_ROUNDED = re.compile(r"\b(ceil|floor|round)\s*\(")
_NAMED = re.compile(r"(\s*)(eq|leq|lt)(\s*\()([^,()]+)(,\s*)([^,()]+)(\)\s*)(;)")
_SIGNS = {"eq": "==", "neq": "!=", "leq": "<=", "lt": "<"}

# How often a word is meant, in lines of a sort, before any line of the model is read.
_RELATIONS = {
    "child": {"contains": 4.0, "contained_by": 2.0, "meets": 1.5, "met_by": 1.5, "before": 0.7, "after": 0.7},
    "neighbour": {"meets": 4.0, "met_by": 4.0, "before": 1.0, "after": 1.0, "contains": 0.05, "contained_by": 0.05},
    "event": {"any": 6.0},
    "between": {"before": 3.0, "meets": 1.5, "contains": 1.5, "contained_by": 1.0, "after": 0.7, "met_by": 0.7},
}
_COMPARISONS = {
    "value": {"==": 6.0, "<=": 1.0, ">=": 1.0, "<": 1.0, ">": 1.0, "!=": 0.1},
    "time": {"==": 3.0, "<=": 3.0, ">=": 1.5, "!=": 0.05},
    "rounded": {"==": 6.0, "<=": 1.0, ">=": 1.0, "!=": 0.05},  # who rounds a number sets a time by it
    "point": {"==": 6.0, "<=": 2.0, ">=": 1.0, "!=": 0.05},
    "sampled": {"==": 9.0},
    "real condition": {"==": 0.2, "<=": 1.5, ">=": 1.5, "<": 2.0, ">": 2.0, "!=": 0.05},
    "truth condition": {"==": 6.0, "<=": 0.1, ">=": 0.1, "<": 0.1, ">": 0.1, "!=": 0.5},
    "condition": {"==": 2.0, "<=": 2.0, ">=": 2.0, "<": 2.0, ">": 2.0, "!=": 1.5},
}
# The sign of what is added: between two times most write how much later one is.
SIGNED = {"time sum": {"+": 4.0, "-": 1.0}, "sum": {"+": 2.0, "-": 1.0}, "number": {}}


def sort_of(edit: SmallEdit, site: EditSite) -> tuple[object, dict[str, float]]:
    """The sort of line that a relation or comparison stands in, and how often words are meant in such lines."""
    if edit.kind is EditKind.RELATION:
        relation_sort = _relation_sort(edit, site)
        return relation_sort, _RELATIONS[relation_sort]
    if edit.kind is EditKind.SIGN:
        signs = "number" if edit.new not in SIGNED["sum"] else "time sum" if _is_about_time(site) else "sum"
        return signs, SIGNED[signs]
    before = site.text[: edit.begin - site.begin]
    is_demand = site.text.endswith(";") and before.count("(") == before.count(")")
    is_point = _POINTS.fullmatch(site.text) is not None
    if is_demand and SAMPLED.search(site.text):
        sort = "sampled"
    elif is_demand and not site.is_check:
        is_rounded = _ROUNDED.search(site.text) is not None
        sort = "point" if is_point else "value" if not _is_about_time(site) else "rounded" if is_rounded else "time"
    else:
        is_truth = any(word in TRUTHS for word in WORD.findall(site.text))
        sort = "truth condition" if is_truth else "real condition" if _REAL.search(site.text) else "condition"
    return sort, _COMPARISONS[sort]


def _relation_sort(edit: SmallEdit, site: EditSite) -> str:
    """What a relation is between: two named tokens, or the rule's own and one beside it, an event, or any other."""
    if edit.begin > site.begin:
        return "between"
    target = _TARGET.search(site.text, edit.end - site.begin)
    names = target.group().strip("( ").split(".") if target is not None else [""]
    if names[-1] in EVENTS:
        return "event"
    is_own = len(names) == 1 or names[:-1] in (["object"], [site.rule.rpartition(".")[0]])
    return "neighbour" if is_own else "child"  # tokens of one timeline do not overlap


def sum_of(edit: SmallEdit, site: EditSite, sign: str = "") -> tuple[str, str, str]:
    """A sign with the words that it stands between."""
    left, right = _BEFORE.search(site.text[: edit.begin - site.begin]), _AFTER.match(site.text[edit.end - site.begin :])
    return left.group(1) if left else "", sign or edit.old, right.group(1) if right else ""


def sign_of(word: str) -> str:
    """A comparison as a sign, also where a function is its name."""
    return _SIGNS.get(word, word)


def is_asked_for(edit: SmallEdit, wanted: str) -> bool:
    """Whether an edit writes the `wanted` comparison where one of the other way stands."""
    return bool(wanted) and sign_of(edit.new) == wanted and sign_of(edit.old)[:1] not in (wanted[:1], "=")


def is_comparison_turned(edit: SmallEdit) -> bool:
    """Whether an edit writes `<` or `<=` where `>` or `>=` stands, or the other way round."""
    ways = {sign_of(one)[:1] for one in (edit.old, edit.new)}
    return edit.kind is EditKind.COMPARISON and ways == {"<", ">"}


def compared(text: str) -> str:
    """A comparison that is written as a call, with its sign: each operand stays where it stands in the line."""
    found = _NAMED.fullmatch(text)
    if found is None:
        return text
    before, name, opening, left, comma, right, closing, end = found.groups()
    sign = sign_of(name)
    if len(sign) > len(comma):
        sign = sign[:1] if name != "eq" else ""
    return (
        f"{before}{' ' * len(name + opening)}{left}{sign:{len(comma)}}{right}{' ' * len(closing)}{end}"
        if sign
        else text
    )


def _is_about_time(site: EditSite) -> bool:
    return any(word in TOKEN_TIMES for word in WORD.findall(site.text))
