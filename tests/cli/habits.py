"""Mistakes of who comes from C, Java, Python, PDDL or YAML: what was typed, where it is told, and what helps."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    """`right`, once in a file, is typed as `wrong`; the message is in the line with `told`, and says `help`."""

    file: str
    right: str
    wrong: str
    help: str
    told: str = ""  # the line of the message, where it is another than the one that was changed


HABITS = (
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration++;", "=="),
    Mistake("gps/rules.nddl", "run.distance == distance;", "run.distance += distance;", "=="),
    Mistake("gps/rules.nddl", "run.distance == distance;", "run.distance := distance;", "`==`"),
    Mistake("gps/psim.nddl", "mulEq(span, ground, distance);", "mulEq(span; ground; distance);", "`,`"),
    Mistake(
        "gps/rules.nddl", "duration <= GO_WORST;", "for (int i = 0; i < 3; i++) { duration <= GO_WORST; }", "`foreach"
    ),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "for (int i : distance) { duration <= GO_WORST; }", "`foreach"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= distance > 100.0 ? 200 : GO_WORST;", "if ("),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration % 2 == 0;", "%"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= 2 ^ 8;", "`pow(a, b)`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= 2 ** 8;", "`pow(a, b)`"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "return duration <= GO_WORST;", "return"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= null;", "null"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= GO_WORST & duration >= 5;", "`&&`"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails):", "{"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails) do {", "do"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "switch (fails) {", "if ("),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "when (fails) {", "`if`"),
    Mistake("templates/retry/simulator.nddl", "} else {", "} otherwise {", "`else`"),
    Mistake("templates/retry/simulator.nddl", "} else {", "} else if (fails == false) then {", "then"),
    Mistake("gps/rules.nddl", "contains(Helm.Run run);", "Helm.Run run;", "any(Helm.Run run)"),
    Mistake("gps/rules.nddl", "contains(Helm.Run run);", "run = contains(Helm.Run);", "contains(Helm.Run run)"),
    Mistake("gps/rules.nddl", "contains(Helm.Run run);", "contains(new Helm.Run run);", "new"),
    Mistake("gps/rules.nddl", "contains(Helm.Ascend up);", "contains(Helm::Ascend up);", "."),
    Mistake("gps/rules.nddl", "contains(Helm.Ascend up);", "subgoal(Helm.Ascend up);", "object.p"),
    Mistake("gps/vehicle.nddl", "class Helm extends", "public class Helm extends", "public"),
    Mistake("gps/vehicle.nddl", "class Helm extends", "abstract class Helm extends", "abstract"),
    Mistake(
        "gps/vehicle.nddl", "class Helm extends AgentTimeline {", "class Helm(AgentTimeline):", "extends AgentTimeline"
    ),
    Mistake(
        "gps/vehicle.nddl", "predicate Run { float distance; }", "predicate Run { distance: float; }", "float distance"
    ),
    Mistake(
        "gps/vehicle.nddl",
        "predicate Run { float distance; }",
        "predicate Run { ?distance - float; }",
        "float distance",
    ),
    Mistake("gps/vehicle.nddl", "predicate Run { float distance; }", "void Run(float distance);", "predicate Run"),
    Mistake(
        "gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', 'Gps(Mode m) : super(m, "Inactive") { }', "{ super"
    ),
    Mistake(
        "gps/vehicle.nddl",
        'Gps(Mode m) { super(m, "Inactive"); }',
        'Gps(Mode m) { super().__init__(m, "Inactive"); }',
        "super(",
    ),
    Mistake(
        "gps/vehicle.nddl",
        'Gps(Mode m) { super(m, "Inactive"); }',
        'void Gps(Mode m) { super(m, "Inactive"); }',
        "void",
    ),
    Mistake(
        "gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', 'Gps(m) { super(m, "Inactive"); }', "have types"
    ),
    Mistake(
        "gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', "Gps(Mode m) { super(m, Inactive); }", '"Inactive"'
    ),
    Mistake(
        "gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', 'Gps(Mode m) { super(m, "Inactiv"); }', "Inactive"
    ),
    Mistake("classic/rover.nddl", "battery = _battery;", "self.battery = _battery;", "this"),
    Mistake(
        "classic/rover.nddl", "new Battery(20.0, 0.0, 20.0)", "new Battery(charge=20.0, least=0.0, most=20.0)", "order"
    ),
    Mistake(
        "classic/rover.nddl",
        "Battery battery = new Battery(20.0, 0.0, 20.0);",
        "battery = new Battery(20.0, 0.0, 20.0);",
        "Battery battery",
    ),
    Mistake("classic/rover.nddl", "Place hill = new Place(6);", "Place hill(6);", "new Place"),
    Mistake("classic/rover.nddl", "Place hill = new Place(6);", "Place* hill = new Place(6);", "*"),
    Mistake("classic/rover.nddl", "Place hill = new Place(6);", "Place hill = Place.new(6);", "new Place(6)"),
    Mistake("classic/rover.nddl", "Place hill = new Place(6);", "Place hill = new Place(6, 2);", "Place(int"),
    Mistake("gps/vehicle.nddl", '#include "TREX.nddl"', "from TREX import *", '#include "TREX.nddl"'),
    Mistake("gps/rules.nddl", "GO_WORST = 260;", "#define GO_WORST 260", "GO_WORST = 260"),
    Mistake("gps/rules.nddl", "int GO_WORST;", "int GO_WORST[3];", "array"),
    Mistake("gps/psim.nddl", "= [-0.3 0.3];", "= (-0.3, 0.3);", "[-0.3 0.3]"),
    Mistake("gps/psim.nddl", "= [-0.3 0.3];", "= [-0.3 to 0.3];", "[-0.3 0.3]"),
    Mistake("gps/psim.nddl", "= [-0.3 0.3];", "= -0.3 .. 0.3;", "[-0.3 0.3]"),
    Mistake("gps/psim.nddl", "= [-0.3 0.3];", "= range(-0.3, 0.3);", "`[1 5]`"),
    Mistake("gps/psim.nddl", "float CRUISE;", "enum Colour = { red, green }\nfloat CRUISE;", "="),
    Mistake("gps/psim.nddl", "float CRUISE;", "enum Colour { red = 1, green = 2 }\nfloat CRUISE;", "names"),
    Mistake(
        "gps/psim.nddl", "float CRUISE;", "typedef Percent int [0 100];\nfloat CRUISE;", "typedef int [0 100] Percent"
    ),
    Mistake(
        "classic/rover.nddl",
        "class Place {",
        "(:objects lander hill - Place)\nclass Place {",
        "Class name = new Class()",
    ),
    Mistake("classic/rover.nddl", "    origin != target;", "    (not (= origin target));", "!="),
    Mistake("classic/rover.nddl", "    origin != target;", "    not (origin == target);", "turn the comparison round"),
    Mistake("classic/rover.nddl", "    duration == 3;", "    (= ?duration 3);", "duration == 3"),
    Mistake("classic/rover.nddl", "    duration == 3;", "    length == 3;", "`duration`"),
    Mistake("classic/rover.nddl", "landed.start == 0;", "landed.begin == 0;", "`start`"),
    Mistake("classic/rover.nddl", "second.end <= 80;", "second.finish <= 80;", "`end`"),
    Mistake("classic/rover.nddl", "first.start <= 40;", "at_end first.start <= 40;", "at_end"),
    Mistake("classic/rover.nddl", "// Where it stands", "; Where it stands", "//"),
    Mistake(
        "classic/rover.nddl", "goal(Arm.Sampling first);", "goal(Arm.Sampling(first));", "goal(Arm.Sampling first)"
    ),
    Mistake("classic/rover.nddl", "goal(Arm.Sampling first);", "goal(Arm.Sampling first, start = 20);", "first.start"),
    Mistake("classic/rover.nddl", "goal(Arm.Sampling first);", "Goal(Arm.Sampling first);", "`goal`"),
    Mistake("classic/rover.nddl", "goal(Arm.Sampling first);", "new goal(Arm.Sampling first);", "new"),
    Mistake("classic/rover.nddl", "first.rock == hill;", 'first.rock == "hill";', "hill"),
    Mistake("classic/rover.nddl", "first.start <= 40;", "first.start <= 40s;", "40"),
    Mistake("classic/rover.nddl", "first.start <= 40;", "first.start <= 1:40;", "number of ticks"),
    Mistake("classic/rover.nddl", "first before second;", "first < second;", "before"),
    Mistake("classic/rover.nddl", "first before second;", "before(first, second);", "first before second"),
    Mistake("classic/rover.nddl", "first before second;", "first before second by 5;", "[5"),
    Mistake("classic/rover.nddl", "first before second;", "first before [1 inf second;", "]"),
    Mistake(
        "classic/rover.nddl",
        "    contained_by(object.rover.At there);",
        "    within(object.rover.At there);",
        "contained_by",
    ),
    Mistake("classic/rover.nddl", "    ticks == abs(far);", "    ticks == |far|;", "abs(far)"),
    Mistake("gps/psim.nddl", "ticks == ceil(span);", "ticks == (int) span;", "ceil"),
    Mistake("gps/psim.nddl", "ticks == ceil(span);", "ticks == int(span);", "ceil"),
    Mistake("gps/psim.nddl", "ticks == ceil(span);", "ticks == round(span);", "ceil"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration ≤ GO_WORST;", "`<=`"),
    Mistake("gps/vehicle.nddl", 'Gps(Mode m) { super(m, "Inactive"); }', "Gps(Mode m) { super(m, “Inactive”); }", '"'),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration <= GO_WORST；", ";"),
    Mistake("gps/rules.nddl", "duration <= GO_WORST;", "duration\xa0<= GO_WORST;", "blank"),
    Mistake("gps/vehicle.nddl", "/// What the vehicle is told to do.", '"""What the vehicle is told to do."""', "///"),
    Mistake("gps/vehicle.nddl", "/// What the vehicle is told to do.", "@timeline", "@"),
    Mistake("gps/psim.nddl", "close();", "close;", "close()"),
    Mistake("gps/psim.nddl", "new Gps(Internal)", 'new Gps("Internal")', "Internal"),
    Mistake("gps/psim.nddl", "new Gps(Internal)", "new Gps(Mode::Internal)", "."),
    Mistake("gps/rules.nddl", "Nav::Transit {", "Nav::Transit: {", ":"),
    Mistake("gps/rules.nddl", "Nav::Transit {", "on Nav::Transit {", "on"),
    Mistake("gps/rules.nddl", "Nav::Transit {", "Nav::Transit => {", "=>"),
    Mistake("gps/psim.nddl", "float CRUISE;", "float: CRUISE;", ":"),
    Mistake("gps/mission.toml", "final_tick = 900", "final_tick = 15m", "number"),
    Mistake("gps/mission.toml", "final_tick = 900", "final_tick: 900", "`=`"),
    Mistake("gps/mission.toml", "latency = 2", "latency = -2", "0"),
    Mistake("gps/mission.toml", '[[reactor]]\nname = "navigator"', '[reactor]\nname = "navigator"', "[[reactor]]"),
    Mistake(
        "gps/mission.toml",
        "start = [5, 60]\n[goal.parameters]\ndistance",
        "start = [5, 60]\ndistance",
        "[goal.parameters]",
        "start = [5, 60]\nd",
    ),
    Mistake("gps/mission.toml", "start = [5, 60]", 'start = "5..60"', "[5, 60]"),
    Mistake("gps/mission.toml", "start = [5, 60]", "begin = [5, 60]", "`start`"),
    Mistake("gps/mission.toml", '["helm", "gps"]', '["helm" "gps"]', ","),
    Mistake("gps/mission.toml", '["helm", "gps"]', '["Helm", "gps"]', "`helm`"),
    Mistake("gps/mission.toml", "max_failure_rate = 0.01", "max_failure_rate = 1%", "0.01"),
    Mistake("gps/mission.toml", "missions = 200", "missions = 2e2", "whole"),
    Mistake(
        "gps/mission.toml",
        "range = [0.1, 4.0]",
        'range = [0.1, 4.0]\ndistribution = "gaussian"',
        "`normal`",
        "range = [0.1, 4.0]\nd",
    ),
    Mistake("gps/mission.toml", "range = [0.1, 4.0]", 'distribution = "normal"\nstd = 4.0', "`sigma`", '"normal"\ns'),
    Mistake("gps/mission.toml", "[parameters.CURRENT]", "[[parameters.CURRENT]]", "[parameters.CURRENT]"),
    Mistake("gps/mission.toml", "[parameters.CURRENT]", "[parameter.CURRENT]", "`parameters`"),
    Mistake("gps/mission.toml", "tick = 1.0", "tick = 1.0\ntick = 2.0", "once", "tick = 1.0\nt"),
    Mistake("gps/mission.toml", "tick = 1.0", 'tick = 1.0\non_failure = "abort"', "`abort_agent`", "tick = 1.0\no"),
    Mistake("gps/mission.toml", "tick = 1.0", "tick = 1.0 // seconds", "#"),
    Mistake("gps/mission.toml", "seed = 7234", "seed = random", "digits"),
    Mistake("gps/mission.toml", 'name = "gps"', "name = “gps”", '"'),
)
