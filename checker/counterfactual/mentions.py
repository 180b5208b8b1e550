"""The lines of models in; out: which variables of a rule are never read, never set or never mentioned in it.

Who declares a variable means to set it and to read it, and a parameter is there to be read: where a line is changed so
that one is that was not, or that a name stands where the other side of the comparison has the same, it is likelier.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Container, Sequence

from checker.counterfactual.word_odds import compared
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from checker.mutation.labels import Label

_PATH = re.compile(r"[A-Za-z_]\w*(?:\.\w+)*")
_NUMBERS = ("int ", "float ")
_DECLARED = re.compile(r"\w+\s+(\w+)\s*(?:=(.*))?;", re.DOTALL)
_OBJECT = re.compile(r"(\w+)\s+(\w+)\s*;")
_SET = re.compile(r"\s*([A-Za-z_][\w.]*)\s*==")
_ORDER = re.compile(r"[<>]")
_END = re.compile(r"\b(?:start|end)\b")
_LABELLED = re.compile(r"\(\s*([A-Za-z_][\w.]*)\s+(\w+)\s*\)")
_LOCAL, _CHILD = 1.5, 0.5  # what a mention of a local variable counts, and of a parameter of another token
_NAMING = (EditKind.NAME, EditKind.POINT, EditKind.TOKEN)
_OWN_END = ("end", "duration")
_CALL = re.compile(r"\s*\w+\s*\(")
_SIDES = re.compile(r"([^=<>!]+)==([^=<>!]+);")
_SAME = re.compile(r"\s*([\w.]+)\s*==\s*([\w.]+)\s*;")


class Mentions:
    """What the lines of each rule set, read and declare.

    `constants` belong to no rule, and no line needs to read `labels`.
    """

    def __init__(
        self, sites: Sequence[EditSite], constants: Container[str], counts: Counter[str], labels: Container[Label] = ()
    ) -> None:
        self._constants, self._counts, self._labels = constants, counts, labels
        self._locals: dict[object, set[str]] = defaultdict(set)
        self._set: dict[object, Counter[str]] = defaultdict(Counter)
        self._read: dict[object, Counter[str]] = defaultdict(Counter)
        self._called: dict[object, Counter[str]] = defaultdict(Counter)  # by constraints, which may set them too
        self._worked_out: dict[object, set[str]] = defaultdict(set)  # by equations: `bales * 2 == lot.tonnes`
        self._declared: dict[str, set[str]] = defaultdict(set)
        self._of_rule: dict[str, Counter[str]] = defaultdict(Counter)
        self._predicates: dict[object, dict[str, str]] = defaultdict(dict)  # of the tokens of a rule, by their labels
        self._own: dict[str, set[str]] = defaultdict(set)  # what the rules of a predicate set themselves
        self._found_out: dict[str, set[str]] = defaultdict(set)  # what they set from variables of their own
        self._classes: dict[object, dict[str, str]] = defaultdict(dict)  # of what a rule declares
        self._same_as: dict[object, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
        for site in sites:
            if not site.rule or site.is_rule:
                continue
            scope, text, skipped = _scope(site), compared(site.text), 0
            for predicate, label in _LABELLED.findall(text):
                self._predicates[scope][label] = predicate.rpartition(".")[2]
            declared = _DECLARED.fullmatch(text)
            if declared is not None:
                self._locals[scope].add(declared.group(1))
                if (made := _OBJECT.fullmatch(text)) is not None:
                    self._classes[scope][made.group(2)] = made.group(1)
                self._declared[site.rule].add(declared.group(1))
                if declared.group(2) is None:
                    continue
                skipped = declared.start(2)
                self._set[scope][declared.group(1)] += 1
            elif (first := _SET.match(text)) is not None:
                skipped = first.end()
                self._set[scope][first.group(1)] += 1
                self._own[site.rule.rpartition(".")[2]].add(first.group(1))
            for name in _PATH.findall(text, skipped):
                self._read[scope][name] += 1
                self._called[scope][name] += skipped == 0 and _CALL.match(text) is not None
            self._of_rule[site.rule].update(_PATH.findall(text))
            if (sides := _SIDES.fullmatch(text)) is not None:
                self._worked_out[scope].update(_unknowns(sides.group(1), sides.group(2), self._classes[scope]))
            if (sides := _SAME.fullmatch(text)) is not None:
                for one, other in (sides.groups(), sides.groups()[::-1]):
                    self._same_as[scope][one].add(other)
                    if other in self._locals[scope]:
                        self._found_out[site.rule.rpartition(".")[2]].add(one)

    def gain(self, edit: SmallEdit, site: EditSite) -> float:
        """How much more is mentioned that lacked it than with the old name; 1 for a parameter of the rule."""
        is_set = self.is_set_by(edit, site)
        lacking = self._weight(edit.new, site) * self._lacks(edit.new, site, is_set, 0)
        return lacking - self._weight(edit.old, site) * self._lacks(edit.old, site, is_set, 1)

    def case_gain(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where another line of the rule has the old value of a condition too, less 1 where one has the new value."""
        read = self._read[_scope(site)]
        return (read[edit.old] > 1) - (read[edit.new] > 0)

    def unset_local(self, site: EditSite) -> str:
        """The local number that a line declares, if other lines of its rule read it and none sets it; else empty.

        Of a class, an enum or a truth value it is the planner's choice, as far as conditions leave one.
        """
        declared = _DECLARED.fullmatch(site.text) if site.rule and not site.is_rule else None
        if declared is None or declared.group(2) is not None or not site.text.startswith(_NUMBERS):
            return ""
        scope, name = _scope(site), declared.group(1)
        is_set = self._set[scope][name] or self._called[scope][name] or name in self._worked_out[scope]
        return name if self._read[scope][name] and not is_set else ""

    def is_found_out(self, name: str, site: EditSite) -> bool:
        """Whether the rules of a token set one of its parameters from variables of their own: its owner tells it."""
        label, _, parameter = name.partition(".")
        return parameter in self._found_out.get(self._predicates[_scope(site)].get(label, ""), ())

    def says_the_same(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether other lines of the rule say that a new name is the same as the old one, or as a shorter name."""
        others = self._same_as[_scope(site)][edit.new]
        return any(one == edit.old or one.count(".") < edit.new.count(".") for one in others)

    def merges(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether two objects that a rule chooses have a member in common by an edit: who declares two wants two."""
        sides = _SAME.fullmatch(compared(site.after(edit)))
        if sides is None:
            return False
        for one, other in (sides.groups(), sides.groups()[::-1]):
            known = self._same_as[_scope(site)][other] if "." not in other else {other}
            if any(self._are_two(one, each, site) for each in known):
                return True
        return False

    def _are_two(self, one: str, other: str, site: EditSite) -> bool:
        """Whether paths are of one member of two objects of a class."""
        classes = self._classes[_scope(site)]
        (first, _, member), (second, _, same) = one.partition("."), other.partition(".")
        return member == same != "" and first != second and classes.get(first) == classes.get(second, "")

    def unsets(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether nothing sets a variable of a rule any more that a line has set, or a line does so by itself.

        So does one that sets it from what another line of the rule says is the same.
        """
        found = _SET.match(text := compared(site.after(edit)))
        if found is not None:
            same = {found.group(1)}
            if _SAME.fullmatch(text) is None:
                same |= self._same_as[_scope(site)][found.group(1)]
            if edit.new in same and edit.new in _PATH.findall(text, found.end()):
                return not self.is_set_by(edit, site)
        is_local = edit.old in self._locals[_scope(site)]
        return is_local and self.is_set_by(edit, site) and self._lacks(edit.old, site, True, 1)

    def compares_label(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit writes what only tells tokens apart into a line that compares which is larger."""
        label, _, parameter = edit.new.rpartition(".")
        predicate = self._predicates[_scope(site)].get(label, "") if label else site.rule.rpartition(".")[2]
        return (predicate, parameter) in self._labels and _ORDER.search(compared(site.text)) is not None

    def frees(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether nothing says any more what a local variable is: `rest <= ceil(storing)` for `==`."""
        found = _SET.match(compared(site.text))
        if edit.old != "==" or found is None or found.group(1) not in self._locals[_scope(site)]:
            return False
        return self._set[_scope(site)][found.group(1)] <= 1

    def is_set_by(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether an edit changes what a line sets: the left side of `==`."""
        text = compared(site.text)
        return bool(_SET.match(text)) and not text[: edit.begin - site.begin].strip()

    def likeness(self, edit: SmallEdit, site: EditSite) -> float:
        """1 where both sides of `==` have one name then, as in `child.depth == depth`, less 1 where they have it.

        Half as much where a line then speaks of starts alone, or of ends.
        """
        new = site.after(edit)
        gain = float((_is_alike(new) and not self._is_own(edit.new, site)) - _is_alike(site.text))
        return gain or 0.5 * (_is_of_one_end(new) - _is_of_one_end(site.text)) * (edit.kind is EditKind.POINT)

    def makes_alike(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether both sides of `==` have one name after an edit, and had not before."""
        return _is_alike(site.after(edit)) and not _is_alike(site.text)

    def _is_own(self, name: str, site: EditSite) -> bool:
        """Whether a name is a parameter of a token that the rules of the token set themselves."""
        label, _, parameter = name.partition(".")
        return parameter in self._own.get(self._predicates[_scope(site)].get(label, ""), ())

    def _weight(self, name: str, site: EditSite) -> float:
        """What a mention counts: nobody declares a variable for nothing, others may care for a token's parameters."""
        return _LOCAL if name in self._locals[_scope(site)] else _CHILD if "." in name else 1.0

    def _lacks(self, name: str, site: EditSite, is_set: bool, but: int) -> bool:
        """Whether a name is too little used, without `but` mentions of this very line."""
        if name in self._constants:
            return self._counts[name] <= but
        scope = _scope(site)
        if name in self._locals[scope]:
            set_by, read = self._set[scope][name], self._read[scope][name]
            if is_set:
                return set_by + self._called[scope][name] <= but
            return read <= but or set_by + read <= 1 + but
        if (site.rule.rpartition(".")[2], name) in self._labels:
            return False
        if name in _OWN_END:
            return sum(self._of_rule[site.rule][one] for one in _OWN_END) <= but
        if self._is_own(name, site):
            return False
        is_variable = "." in name or name in self._declared[site.rule]
        return is_variable and self._of_rule[site.rule][name] <= but


def is_doubled(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a name stands twice in a line, of which an edit takes one away."""
    return edit.kind in _NAMING and _PATH.findall(site.text).count(edit.old) > 1


def leaves_one(edit: SmallEdit) -> bool:
    """Whether a name stands in what an edit leaves out of an expression and in what it keeps."""
    left_out = Counter(_PATH.findall(edit.old)) - Counter(_PATH.findall(edit.new))
    return any(name in left_out for name in _PATH.findall(edit.new))


def _unknowns(left: str, right: str, objects: Container[str]) -> list[str]:
    """What an equation may say the value of: what stands on its left in more than a name, or opposite an object's."""
    if _PATH.fullmatch(left.strip()) is None:
        return _PATH.findall(left)
    owner, dot, _ = left.strip().partition(".")
    return _PATH.findall(right) if dot and owner in objects else []


def _scope(site: EditSite) -> object:
    return site.file, site.scope


def _is_alike(text: str) -> bool:
    sides = _SAME.fullmatch(compared(text))
    return sides is not None and sides.group(1).rpartition(".")[2] == sides.group(2).rpartition(".")[2]


def _is_of_one_end(text: str) -> bool:
    return len(set(_END.findall(text))) == 1
