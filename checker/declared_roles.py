"""Role of a timeline as its model declares it: a model's file in, timelines by role out (reference of T-REX, 1.1).

In T-REX the model says it (`Lights lum = new Lights(Internal)`), and an agent file may leave it out. It is read from
the text, since a mission file is read before its models are compiled: a mode is a word in `new` or in a constructor.
"""

from collections.abc import Iterator, Mapping
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
    modes = _declared(model)
    if modes is None:
        return {}
    for name, mode in modes:
        for key in _KEYS.get(mode, ()):
            found[key].append(name)
    return {key: tuple(names) for key, names in found.items()}


def declared_objects(model: Path) -> dict[str, str]:
    """The objects of a model, each with its mode, which is empty where the text does not tell it."""
    return dict(_declared(model) or ())


def _declared(model: Path) -> list[tuple[str, str]] | None:
    """The objects that the script makes, each with its mode; None where the model cannot be read."""
    try:
        module = read_model(model).module
    except (OSError, ValueError):
        return None  # told where the model is read
    classes = {
        one.name.name: one for one in module.statements if isinstance(one, ClassDecl) and one.members is not None
    }
    return [
        each
        for statement in module.statements
        if isinstance(statement, VariableDecl)
        for one in statement.declarators
        if isinstance(one.initialiser, NewExpr)
        for each in _made(one.name.name, _words(one.initialiser, {}), classes)
    ]


_Words = tuple[str, tuple[str, ...]]  # a class, and the names given to its constructor


def _made(
    name: str, new: _Words, classes: Mapping[str, ClassDecl], around: frozenset[str] = frozenset()
) -> Iterator[tuple[str, str]]:
    """The objects of a global variable and of what constructors put into its members, each with its mode.

    The mode is empty if the text does not tell it, or if the object is no timeline of an agent.
    """
    class_name, given = new
    mode = ""
    parts: list[tuple[str, _Words]] = []
    for _ in range(_DEEPEST):
        code = classes.get(class_name)
        if code is None or code.members is None:  # that it is not there is told where the model is read
            mode = next((word for word in given if word in _KEYS), "")
            break
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
        set_to = [(one.target.parts[-1].name, one.value) for one in body if isinstance(one, Assignment)]
        parts += [(member, _words(value, values)) for member, value in set_to if isinstance(value, NewExpr)]
        if class_name == _TIMELINE:
            mode = next((_word(value, values) for member, value in set_to if member == _MODE), "")
            break
        if code.base is None:
            break
        above = next((one for one in body if isinstance(one, SuperCall)), None)
        given = () if above is None else tuple(_word(each, values) for each in above.arguments)
        class_name = code.base.name
    yield name, mode
    inner = around | {new[0]}
    for member, words in parts:
        if words[0] not in inner:  # a class that makes one of its own kind has no end
            yield from _made(f"{name}.{member}", words, classes, inner)


def _words(made: NewExpr, values: Mapping[str, str]) -> _Words:
    return made.class_name.name, tuple(_word(each, values) for each in made.arguments)


def _word(value: Expr, values: Mapping[str, str]) -> str:
    """The name that an expression is, a parameter replaced by what was given for it; empty if it is none."""
    if not isinstance(value, PathExpr):
        return ""
    word = value.parts[-1].name
    return values.get(word, word) if len(value.parts) == 1 else word
