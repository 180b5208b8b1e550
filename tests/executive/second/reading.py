"""A small mission of the suite as a description, where it lies in the second agent's family."""

import re
import tomllib
from pathlib import Path
from typing import Any, get_args

from tests.executive.second.description import (
    FAR,
    Apart,
    Between,
    Bound,
    Child,
    Description,
    First,
    Guarded,
    Item,
    Kind,
    Part,
    Relation,
    Rule,
    Wish,
)

RELATIONS: dict[str, Relation] = {name: name for name in get_args(Relation)}
WORDS = re.compile(r"\s*(#include \"[^\"]*\"|//[^\n]*|\"[^\"]*\"|[A-Za-z_]\w*|\d+\.\d+|\d+|::|==|<=|>=|!=|[^\s\w])")


class OutsideTheFamilyError(Exception):
    """The second agent does not know this."""


def described(file: Path) -> Description:
    """The mission of a file."""
    mission = tomllib.loads(file.read_text())
    head = mission["mission"]
    _known(mission, "mission", "reactor", "goal", "parameters", "check")
    _known(head, "name", "final_tick", "on_failure")
    kinds: dict[str, Kind] = {}
    models = [_Model(_text(file.parent / one.get("model", "none"))) for one in mission["reactor"]]
    parts = []
    for model in models:
        for kind in model.kinds.values():
            known = kinds.get(kind.timeline, kind)
            if any(known.parameters(name) not in (None, names) for name, names in kind.predicates):
                raise OutsideTheFamilyError("two parameter lists of one predicate")
            mine = {**dict(kinds[kind.timeline].predicates if kind.timeline in kinds else ()), **dict(kind.predicates)}
            kinds[kind.timeline] = Kind(kind.timeline, tuple(mine.items()))
    for one, model in zip(mission["reactor"], models, strict=True):
        _known(one, "name", "model", "latency", "lookahead", "internal", "external", "early", "late", "observe")
        used = one.get("external", [])
        watched = [name for name in used if model.modes[name] == "Observe" or name in one.get("observe", [])]
        lacks = tuple(
            (kind.timeline, predicate)
            for kind in kinds.values()
            for predicate, _ in kind.predicates
            if kind.timeline in model.modes and model.kinds[kind.timeline].parameters(predicate) is None
        )
        early, late = tuple(one.get("early", ())), tuple(one.get("late", ()))
        place = (one["name"], one.get("latency", 0), one.get("lookahead", 0), tuple(one.get("internal", ())))
        asked = tuple(name for name in used if name not in watched)
        means = (tuple(model.rules), tuple(model.firsts), lacks, tuple(model.ranges))
        parts.append(Part(*place, asked, tuple(watched), *means, early, late))
    if mission.get("parameters"):
        raise OutsideTheFamilyError("parameters")
    wishes, kills = tuple(map(_wish, mission.get("goal", ()))), head.get("on_failure") == "kill_reactor"
    return Description(head["name"], head["final_tick"], tuple(kinds.values()), tuple(parts), wishes, (), kills)


def _known(table: dict[str, Any], *keys: str) -> None:
    if set(table) - set(keys):
        raise OutsideTheFamilyError(str(set(table) - set(keys)))


def _pair(value: Any) -> tuple[int, int]:
    low, high = value if isinstance(value, list) else (value, value)
    if not all(isinstance(one, int) or one in (float("inf"), float("-inf")) for one in (low, high)):
        raise OutsideTheFamilyError("a number of the goal")
    return (max(-FAR, int(max(low, -FAR))), int(min(high, FAR)))


def _wish(goal: dict[str, Any]) -> Wish:
    _known(goal, "timeline", "predicate", "at", "mandatory", "start", "duration", "recall", "parameters")
    arguments = goal.get("parameters", {})
    if not all(isinstance(one, int) and not isinstance(one, bool) for one in arguments.values()):
        raise OutsideTheFamilyError("an argument of the goal")
    return Wish(
        goal["timeline"], goal["predicate"], tuple(arguments.items()), _pair(goal.get("start", [0, FAR])),
        _pair(goal["duration"]) if "duration" in goal else None, goal.get("at", 0), goal.get("mandatory", False),
        goal.get("recall"),
    )  # fmt: skip


def _text(file: Path) -> str:
    if not file.is_file():
        raise OutsideTheFamilyError("a file")
    text = file.read_text()
    return re.sub(r'#include "([^"]*)"', lambda one: _included(file.parent / one[1]), re.sub(r"//[^\n]*", "", text))


def _included(file: Path) -> str:
    return "" if file.name == "TREX.nddl" else _text(file)


class _Model:
    """Reads the statements of a model."""

    def __init__(self, text: str) -> None:
        self.words = WORDS.findall(text)
        self.place = 0
        self.kinds: dict[str, Kind] = {}
        self.classes: dict[str, Kind] = {}
        self.ranges: list[tuple[str, str, str, int, int]] = []
        self.modes: dict[str, str] = {}
        self.rules: list[Rule] = []
        self.firsts: list[First] = []
        while self.place < len(self.words):
            self._statement()

    def _statement(self) -> None:
        words = self._until("{", ";")
        match words:
            case ["class", name, "extends", "AgentTimeline", "{"]:
                self._class(name)
            case [name, "::", predicate, "{"]:
                timeline = self._timeline(name)
                self.rules.append(Rule(timeline, predicate, tuple(self._body(timeline))))
            case [name, timeline, "=", "new", other, "(", mode, *_, ";"] if name == other and timeline == name.lower():
                if mode == "Ignore":
                    raise OutsideTheFamilyError(mode)
                self.modes[timeline] = "Internal" if mode == "Private" else mode
            case ["close", "(", ")", ";"]:
                pass
            case ["fact", "(", timeline, ".", predicate, label, ")", ";"]:
                self._first(timeline, predicate, label)
            case _:
                raise OutsideTheFamilyError(" ".join(words))

    def _until(self, *stops: str) -> list[str]:
        begin = self.place
        while self.words[self.place] not in stops:
            self.place += 1
        self.place += 1
        return self.words[begin : self.place]

    def _timeline(self, name: str) -> str:
        if name not in self.classes:
            raise OutsideTheFamilyError(name)
        return self.classes[name].timeline

    def _class(self, name: str) -> None:
        timeline, predicates, default = name.lower(), {}, "undefined"
        while self.words[self.place] != "}":
            if self.words[self.place] == "predicate":
                predicate = self._until("{")[1]
                names = []
                while self.words[self.place] != "}":
                    match self._until(";"):
                        case ["int", one, ";"]:
                            names.append(one)
                        case ["int", one, "=", "[", low, high, "]", ";"]:
                            names.append(one)
                            self.ranges.append((timeline, predicate, one, int(low), int(high)))
                        case words:
                            raise OutsideTheFamilyError(" ".join(words))
                self.place += 1
                predicates[predicate] = tuple(names)
            else:
                words = self._until("}")
                default = words[-4].strip('"')
                if words[1] != "(" or "super" not in words or default not in predicates or words.count(";") != 1:
                    raise OutsideTheFamilyError(" ".join(words))
        self.place += 1
        kind = Kind(timeline, tuple(sorted(predicates.items(), key=lambda one: one[0] != default)))
        self.kinds[timeline] = self.classes[name] = kind

    def _first(self, timeline: str, predicate: str, label: str) -> None:
        arguments, start = [], None
        while self.place < len(self.words) and label in self.words[self.place : self.place + 3]:
            match self._until(";"):
                case [_, ".", "start", "==", "0", ";"] | ["eq", "(", _, ".", "start", ",", "0", ")", ";"]:
                    start = 0
                case ["eq", "(", _, ".", name, ",", value, ")", ";"] | [_, ".", name, "==", value, ";"] if (
                    name != "end"
                ):
                    arguments.append((name, int(value)))
                case words:
                    raise OutsideTheFamilyError(" ".join(words))
        if start is None:
            raise OutsideTheFamilyError("a fact that does not begin at 0")
        self.firsts.append(First(timeline, predicate, tuple(arguments)))

    def _body(self, timeline: str) -> list[Item]:
        found: list[Item] = []
        while self.words[self.place] != "}":
            found.append(self._item(timeline))
        self.place += 1
        return found

    def _item(self, timeline: str) -> Item:
        if self.words[self.place] == "if":
            test = self._until("{")
            body = tuple(self._body(timeline))
            if self.words[self.place : self.place + 1] == ["else"]:
                raise OutsideTheFamilyError("else")
            match test:
                case ["if", "(", "start", "<=", "AGENT_CLOCK", ")", "{"]:
                    return Guarded("", 0, body)
                case ["if", "(", name, "==", value, ")", "{"] if value.isdigit() and name not in (
                    "start",
                    "end",
                    "duration",
                ):
                    return Guarded(name, int(value), body)
            raise OutsideTheFamilyError(" ".join(test))
        words = self._until(";")
        match words:
            case [relation, "(", name, ".", predicate, label, ")", ";"] if relation in RELATIONS:
                its = timeline if name == "object" else self._timeline(name)
                if self.kinds[its].parameters(predicate) is None:
                    raise OutsideTheFamilyError(" ".join(words))
                return Child(RELATIONS[relation], its, predicate, label)
            case [first, relation, second, ";"] if relation in RELATIONS:
                return Between(first, RELATIONS[relation], second)
            case ["eq", "(", *left, ",", value, ")", ";"] if value.isdigit():
                return self._compared("".join(left), 0, "==", "", int(value))
        return self._comparison(words)

    def _comparison(self, words: list[str]) -> Item:
        match = re.fullmatch(r"([\w.]+)(?:([+-])(\d+))?(==|<=|>=)([\w.]+)(?:([+-])(\d+))?;", "".join(words))
        if match is None:
            raise OutsideTheFamilyError(" ".join(words))
        left, sign, plus, relation, right, other_sign, other_plus = match.groups()
        offset = int(f"{other_sign or '+'}{other_plus or 0}") - int(f"{sign or '+'}{plus or 0}")
        if left.isdigit():
            turned = {"==": "==", "<=": ">=", ">=": "<="}[relation]
            return self._compared(right, -offset, turned, "", int(left))
        if right.isdigit():
            return self._compared(left, offset, relation, "", int(right))
        return self._compared(left, offset, relation, right, 0)

    def _compared(self, left: str, offset: int, relation: str, right: str, number: int) -> Item:
        value = offset + number
        low = value if relation in ("==", ">=") else -FAR
        high = value if relation in ("==", "<=") else FAR
        if (
            "duration" in right
            or {"AGENT_CLOCK", "MISSION_END"} & {left, right}
            or ("." in left and left.count(".") > 1)
        ):
            raise OutsideTheFamilyError(f"{left} {right}")
        if right:
            if "duration" in left:
                raise OutsideTheFamilyError(left)
            return Apart(left, right, low, high)
        label, _, term = left.rpartition(".")
        return Apart(left, "", low, high) if label else Bound(term, low, high)
