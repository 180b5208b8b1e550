"""Sites in, the same out with more edits wanted: those that hand a function what it calls its argument.

Of a function or constraint of the project's own, `sand_for(metres)` in Python, the names of the arguments are known:
where a model hands it `frames` and has `metres` as well, that was meant (so no call of 10 in right models).
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from nddl_lang.lint.python_module import read_module
from nddl_lang.semantics.callables import NATIVE_CALLABLES
from nddl_lang.semantics.described import DescriptionError, described
from nddl_lang.semantics.signature import Signature

_CALLED = re.compile(r"([A-Za-z_]\w*)\s*$")
_BEGINS, _ENDS = ("(", ","), (",", ")")
_NAMES = (EditKind.NAME, EditKind.LIMIT)
_NATIVE = {*NATIVE_CALLABLES.constraints, *NATIVE_CALLABLES.functions}
_LEAST = 3  # letters of a name that says what is meant

_Called = tuple[str, bool]  # a name, and whether it is called as a statement


def with_arguments(sites: Sequence[EditSite], modules: Iterable[str]) -> list[EditSite]:
    """All sites; in calls of what the texts of Python `modules` define, arguments are wanted by their names."""
    known = {key: signature for text in modules for key, signature in _signatures(text)}
    return [_with_wanted(site, known) for site in sites] if known else list(sites)


def _signatures(text: str) -> Iterable[tuple[_Called, Signature]]:
    """The constraints and functions of a module, as far as its text tells, each with what it takes."""
    found = [("", description) for _, description in read_module(text).found]
    try:
        callables = described(NATIVE_CALLABLES, found)
    except DescriptionError:
        return
    yield from (((row.name, False), row.signature) for row in callables.functions.values() if row.name not in _NATIVE)
    yield from (((row.name, True), row.signature) for row in callables.constraints.values() if row.name not in _NATIVE)


def _with_wanted(site: EditSite, known: Mapping[_Called, Signature]) -> EditSite:
    found = {(edit.begin, edit.new) for edit in site.edits if edit.kind in _NAMES and _is_named(site, edit, known)}
    return replace(site, wanted=site.wanted | found) if found else site


def _is_named(site: EditSite, edit: SmallEdit, known: Mapping[_Called, Signature]) -> bool:
    """Whether an edit changes a whole argument to what the function calls it, which it was not called before."""
    before, behind = site.text[: edit.begin - site.begin].rstrip(), site.text[edit.end - site.begin :].lstrip()
    place = _place(before) if before.endswith(_BEGINS) and behind.startswith(_ENDS) else None
    if place is None or place[0] not in known:
        return False
    argument = known[place[0]].argument(place[1])
    name = argument.name if argument is not None else ""
    return len(name) >= _LEAST and edit.new.rpartition(".")[2] == name != edit.old.rpartition(".")[2]


def _place(before: str) -> tuple[_Called, int] | None:
    """What is called where a text ends, and the number of the argument that begins there."""
    depth = count = 0
    for at in range(len(before) - 1, -1, -1):
        depth += (before[at] == ")") - (before[at] == "(")
        count += before[at] == "," and depth == 0
        if depth < 0:
            called = _CALLED.search(before[:at])
            return ((called.group(1), called.start() == 0), count) if called is not None else None
    return None
