"""Every name of a correct model is tied to what it means."""

from nddl_lang.analysis import Analysis, analyse_text
from nddl_lang.semantics.schema import (
    ClassReference,
    EnumValue,
    GlobalReference,
    LocalReference,
    MemberReference,
    Reference,
    TokenReference,
    TokenVariableReference,
)
from nddl_lang.syntax.nodes import PathExpr

MODEL = """\
enum Mode { on, off }
class Bulb { int watts; Bulb(int w) { watts = w; } }
class Lamp extends Timeline {
  Bulb bulb;
  Lamp(Bulb bulb) { bulb = bulb; }
  predicate lit { int level; Mode mode; level <= 100; }
  predicate dark { }
}
class Spot extends Lamp { Spot(Bulb b) { super(b); this.bulb.watts = 5; } }
int LIMIT = 90;
Lamp::lit {
  int top = LIMIT;
  meets(object.dark level);
  level <= top;
  level.start == end;
  object.bulb.watts <= this.level;
  mode == on;
  mode != Mode.off;
  Lamp others;
  foreach (other in others) { any(other.dark d); d.object != object; }
}
Bulb b = new Bulb(60);
Lamp lamp = new Lamp(b);
Bulb.close();
goal(lamp.lit g);
g.state == ACTIVE;
g.object == lamp;
lamp.bulb.watts == 60;
"""


def name(reference: Reference) -> str:
    """What a reference says, in words."""
    match reference:
        case EnumValue(enum=enum, value=value):
            return f"value {enum}.{value}"
        case GlobalReference(variable=variable):
            return f"global {variable.name}"
        case LocalReference(variable=variable):
            return f"local {variable.name}"
        case ClassReference(name=class_name):
            return f"class {class_name}"
        case TokenReference(label=label):
            return f"token {label.name}"
        case TokenVariableReference(label=label, name=variable_name):
            return f"variable {variable_name} of {label.name}"
        case MemberReference(base=base, members=members):
            owner = "this" if base is None else name(base)
            return f"member {'.'.join(member.name for member in members)} of {owner}"


def meanings(analysis: Analysis) -> dict[tuple[int, str], str]:
    """Line and text of each path, and what it means."""
    return {
        (path.span.line, path.span.text): name(reference)
        for path, reference in analysis.tables.references.items()
        if isinstance(path, PathExpr)
    }


def test_each_path_means_what_the_order_of_look_up_says() -> None:
    analysis = analyse_text("model.nddl", MODEL)
    assert analysis.diagnostics == ()
    found = meanings(analysis)
    assert found[(5, "bulb")] == "local bulb"  # the value; the target before it is the member
    assert found[(9, "this.bulb.watts")] == "member bulb.watts of this"
    assert found[(13 - 1, "LIMIT")] == "global LIMIT"
    assert found[(14, "level")] == "variable level of this"
    assert found[(14, "top")] == "local top"
    assert found[(15, "level.start")] == "variable start of level"
    assert found[(15, "end")] == "variable end of this"
    assert found[(16, "object.bulb.watts")] == "member bulb.watts of variable object of this"
    assert found[(16, "this.level")] == "variable level of this"
    assert found[(17, "on")] == "value Mode.on"
    assert found[(18, "Mode.off")] == "value Mode.off"
    assert found[(20, "d.object")] == "variable object of d"
    assert found[(24, "Bulb")] == "class Bulb"
    assert found[(26, "g.state")] == "variable state of g"
    assert found[(26, "ACTIVE")] == "value TokenStates.ACTIVE"
    assert found[(28, "lamp.bulb.watts")] == "member bulb.watts of global lamp"


def test_a_target_of_a_constructor_is_the_member_even_under_a_parameter_of_its_name() -> None:
    analysis = analyse_text("model.nddl", MODEL)
    targets = [
        name(reference)
        for path, reference in analysis.tables.references.items()
        if isinstance(path, PathExpr) and path.span.line == 5
    ]
    assert sorted(targets) == ["local bulb", "member bulb of this"]


def test_a_child_knows_its_predicate_and_its_object() -> None:
    analysis = analyse_text("model.nddl", MODEL)
    found = {
        target.predicate.full_name: target.object if isinstance(target.object, str) else name(target.object)
        for target in analysis.tables.targets.values()
    }
    assert found == {"Lamp.dark": "local other", "Lamp.lit": "global lamp"}
    objects = [target.object for target in analysis.tables.targets.values()]
    assert objects[0] == "own"


def test_a_subclass_has_the_predicates_of_its_base_under_its_own_name() -> None:
    schema = analyse_text("model.nddl", MODEL).schema
    inherited = schema.find_predicate("Spot", "lit")
    assert inherited is not None
    assert inherited.full_name == "Spot.lit"
    assert [parameter.name for parameter in inherited.parameters] == ["level", "mode"]
    assert inherited.declared_in == ("Lamp",)


def test_doc_comments_stay_with_what_they_describe() -> None:
    schema = analyse_text("model.nddl", "/// How bright.\nint level;\n/// A lamp.\nclass Lamp { }\n").schema
    assert schema.globals["level"].doc == "How bright."
    assert schema.classes["Lamp"].doc == "A lamp."
