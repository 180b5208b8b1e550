"""Objects of a model by name: a program in, the class of each object that is a global variable or a part of one out."""

from collections.abc import Iterator, Mapping

from compiler.program import Assign, ClassCode, NewObject, Program, SuperCode

RESOURCES = frozenset({"Reservoir", "Reusable", "CBReusable", "Unary"})  # classes of the language


def named_objects(program: Program) -> dict[str, str]:
    """The class of each object: of those that global variables hold, and of those that constructors make in them."""
    classes = {each.name: each for each in program.classes}
    found = {name: code.type_name for name, code in program.globals if code.kind == "object"}
    made: list[tuple[str, NewObject, frozenset[str]]] = [
        (program.globals[each.global_index][0], each, frozenset())
        for each in program.script
        if isinstance(each, NewObject) and each.global_index is not None
    ]
    for name, each, around in made:
        if each.class_name not in around:  # a class that makes one of its own kind has no end
            inner = around | {each.class_name}
            parts = [(f"{name}.{one.name}", one, inner) for one in _parts(each.class_name, each.constructor, classes)]
            found.update({called: one.class_name for called, one, _ in parts})
            made += parts
    return found


def made_as(program: Program, name: str) -> NewObject | None:
    """Where the script makes the object of a name."""
    return next((one for one in program.script if isinstance(one, NewObject) and one.name == name), None)


def resources_of(program: Program) -> list[str]:
    """The names of the resources among the objects of a model."""
    kinds = {code.name for code in program.classes if code.native in RESOURCES}
    return [name for name, class_name in named_objects(program).items() if class_name in kinds]


def _parts(name: str, constructor: int, classes: Mapping[str, ClassCode]) -> Iterator[NewObject]:
    """What a constructor of a class makes and keeps in members."""
    code = classes[name]
    if constructor >= len(code.constructors):
        return
    for step in code.constructors[constructor].body:
        if isinstance(step, SuperCode):
            yield from _parts(step.class_name, step.constructor, classes)
        elif isinstance(step, Assign) and isinstance(step.value, NewObject) and step.value.name is not None:
            yield step.value
