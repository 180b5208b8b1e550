"""Role of a timeline as its model declares it: a model's file in, timelines by role out (reference of T-REX, 1.1).

In T-REX the model says it (`Lights lum = new Lights(Internal)`), and an agent file may leave it out. It is read from
the text, since a mission file is read before its models are compiled: a mode is a word in `new` or in a constructor.
"""

from collections.abc import Mapping
from pathlib import Path

from checker.model_graph import read_model
from nddl_lang.syntax.nodes import (
    Assignment,
    ClassDecl,
    ConstructorDecl,
    Expr,
    NewExpr,
    PathExpr,
    SuperCall,
    VariableDecl,
)

_TIMELINE, _MODE = "AgentTimeline", "mode"
_KEYS = {"Internal": ("internal",), "External": ("external",), "Observe": ("external", "observe")}
_DEEPEST = 64  # classes above each other


def declared_roles(model: Path) -> dict[str, tuple[str, ...]]:
    """What a mission file would list of a model: `internal`, `external`, `observe`; empty where it cannot be read."""
    found: dict[str, list[str]] = {"internal": [], "external": [], "observe": []}
    try:
        module = read_model(model).module
    except (OSError, ValueError):
        return {}  # told where the model is read
    classes = {
        one.name.name: one for one in module.statements if isinstance(one, ClassDecl) and one.members is not None
    }
    for statement in module.statements:
        if isinstance(statement, VariableDecl):
            for one in statement.declarators:
                if isinstance(one.initialiser, NewExpr):
                    for key in _KEYS.get(_mode(one.initialiser, classes), ()):
                        found[key].append(one.name.name)
    return {key: tuple(names) for key, names in found.items()}


def _mode(made: NewExpr, classes: Mapping[str, ClassDecl]) -> str:
    """The mode with which an object is made; empty if the text does not tell, or it is no timeline of an agent."""
    name: str = made.class_name.name
    given = tuple(_word(each, {}) for each in made.arguments)
    for _ in range(_DEEPEST):
        code = classes.get(name)
        if code is None or code.members is None:  # that it is not there is told where the model is read
            return next((word for word in given if word in _KEYS), "")
        made_by = next(
            (one for one in code.members if isinstance(one, ConstructorDecl) and len(one.parameters) == len(given)),
            None,
        )
        body = made_by.body if made_by is not None else ()
        values = (
            {}
            if made_by is None
            else {one.name.name: word for one, word in zip(made_by.parameters, given, strict=True)}
        )
        if name == _TIMELINE:
            set_to = [one.value for one in body if isinstance(one, Assignment) and one.target.parts[-1].name == _MODE]
            return _word(set_to[0], values) if set_to else ""
        if code.base is None:
            return ""
        above = next((one for one in body if isinstance(one, SuperCall)), None)
        given = () if above is None else tuple(_word(each, values) for each in above.arguments)
        name = code.base.name
    return ""


def _word(value: Expr, values: Mapping[str, str]) -> str:
    """The name that an expression is, a parameter replaced by what was given for it; empty if it is none."""
    if not isinstance(value, PathExpr):
        return ""
    word = value.parts[-1].name
    return values.get(word, word) if len(value.parts) == 1 else word
