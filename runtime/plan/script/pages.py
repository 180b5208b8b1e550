"""The pages of the codes about statements that fail when the script is run."""

from nddl_lang.text.page import RulePage
from runtime.plan.script.codes import (
    CLOSED_ALREADY,
    CLOSED_CLASS,
    ENDLESS_OBJECT,
    LOOSE_ITEM,
    NO_OBJECT,
    NOT_ONE_OBJECT,
    NOT_ORDERED,
    NOT_REJECTABLE,
    OTHER_PREDICATE,
    OUTSIDE_DOMAIN,
    SEVERAL_VALUES,
    WRONG_OBJECT,
    WRONG_STATE,
)

_LAMP = "class Lamp extends Timeline { predicate On { int level = [0 9]; } predicate Off { } }\n"
_ROOM = _LAMP + "class Room extends Timeline { predicate Lit { } }\nRoom::Lit { starts(Lamp.On on); }\n"
_BOX = "class Lid { }\nclass Box { Lid lid; Box() { lid = new Lid(); } }\n"
_TWO = _LAMP + "Lamp a = new Lamp();\nLamp b = new Lamp();\nclose();\n"
_STOPS = "The script stops here: what would come after it builds on what did not happen."

SCRIPT_PAGES = (
    RulePage(
        OUTSIDE_DOMAIN,
        "A variable is specified, or given a value, that it cannot have any more.",
        _STOPS,
        "class Lens { int size; Lens(int s) { size = s; } }\nLens lens = new Lens(12);\nint x = [0 9];\n"
        "x.specify(lens.size);\n",
        "class Lens { int size; Lens(int s) { size = s; } }\nLens lens = new Lens(8);\nint x = [0 9];\n"
        "x.specify(lens.size);\n",
    ),
    RulePage(
        NO_OBJECT,
        "A token is asked for, and there is no object yet that it could be on.",
        "Tokens choose among the objects that exist when they are made. " + _STOPS,
        _ROOM + "Room r = new Room();\ngoal(r.Lit g);\ng.activate();\n",
        _ROOM + "Room r = new Room();\nLamp a = new Lamp();\nclose();\ngoal(r.Lit g);\ng.activate();\n",
    ),
    RulePage(
        WRONG_STATE,
        "A token is told to do what its state, or what is demanded of its state, does not allow.",
        "An inactive token can be activated, merged or rejected; whatever else it is must be cancelled first.",
        _TWO + "goal(a.On g);\ngoal(a.On h);\nh.activate();\ng.state != MERGED;\ng.merge(h);\n",
        _TWO + "goal(a.On g);\ngoal(a.On h);\nh.activate();\ng.merge(h);\n",
    ),
    RulePage(
        OTHER_PREDICATE,
        "A token is merged with one of another predicate.",
        "Merged tokens are one and the same, so they have the same variables.",
        _TWO + "goal(a.On g);\ngoal(a.Off h);\nh.activate();\ng.merge(h);\n",
        _TWO + "goal(a.On g);\ngoal(a.On h);\nh.activate();\ng.merge(h);\n",
    ),
    RulePage(
        NOT_REJECTABLE,
        "A goal or a fact is rejected.",
        "Only what was asked for by `rejectable` may be given up.",
        _TWO + "goal(a.On g);\ng.reject();\n",
        _TWO + "rejectable(a.On g);\ng.reject();\n",
    ),
    RulePage(
        CLOSED_CLASS,
        "An object is made of a class that was closed.",
        "`close()` promises that all objects are there: variables that range over them have been decided since.",
        _BOX + "Lid.close();\nBox box = new Box();\n",
        _BOX + "Box box = new Box();\nLid.close();\n",
    ),
    RulePage(
        CLOSED_ALREADY,
        "A class or variable is closed a second time.",
        "One of the two is too much, or closes something else than was meant.",
        "enum Mode { slow, fast }\nMode mode;\nmode.close();\n",
        "enum Mode { slow, fast }\nMode mode;\n",
    ),
    RulePage(
        NOT_ONE_OBJECT,
        "A method is called on a variable that may still be one of several objects.",
        "What is done must be done to one object; specify the variable first.",
        _TWO + "Lamp one;\ngoal(a.On g);\ng.activate();\none.constrain(g);\n",
        _TWO + "Lamp one;\none.specify(a);\ngoal(a.On g);\ng.activate();\none.constrain(g);\n",
    ),
    RulePage(
        SEVERAL_VALUES,
        "`specify` is given a variable that has several values left.",
        "To specify is to decide for one value.",
        "int x = [0 9];\nint y = [0 9];\nx.specify(y);\n",
        "int x = [0 9];\nint y = 4;\nx.specify(y);\n",
    ),
    RulePage(
        WRONG_OBJECT,
        "A token is put on an object that it cannot be on.",
        "`constrain` orders tokens on the timeline that they belong to.",
        _TWO + "goal(a.On g);\ng.activate();\nb.constrain(g);\n",
        _TWO + "goal(a.On g);\ng.activate();\na.constrain(g);\n",
    ),
    RulePage(
        ENDLESS_OBJECT,
        "A constructor makes an object of its own class, or of one whose constructor leads back to it.",
        "Making one object would never come to an end.",
        "class Box { Box inner; Box() { inner = new Box(); } }\nBox box = new Box();\n",
        _BOX + "Box box = new Box();\n",
    ),
    RulePage(
        NOT_ORDERED,
        "`free` takes back an order of two tokens that was never given.",
        "Only what `constrain` ordered can be freed, in the same order.",
        _TWO + "goal(a.On g);\ngoal(a.On h);\ng.activate();\nh.activate();\na.constrain(g, h);\na.free(h, g);\n",
        _TWO + "goal(a.On g);\ngoal(a.On h);\ng.activate();\nh.activate();\na.constrain(g, h);\na.free(g, h);\n",
    ),
    RulePage(
        LOOSE_ITEM,
        "A set names a variable that may still have several values.",
        "A set is a list of values. The name of a variable stands for its value, which is to be known by then.",
        "int n = [1 3];\nint a = {n, 9};\n",
        "int n = 3;\nint a = {n, 9};\n",
    ),
)
