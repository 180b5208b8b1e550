"""Slips in models of newcomers: a power line, a hospital, a rover on the moon and a brewery.

What each must be told was written before any was tried.
"""

from tests.cli.habits import Mistake

LINE, SPANS, AIR, CABLE = (
    "powerline/line.nddl",
    "powerline/planner.nddl",
    "powerline/air.nddl",
    "powerline/mission.toml",
)
WARDS, JOBS, BUILDING, MORNING = (
    "hospital/hospital.nddl",
    "hospital/dispatcher.nddl",
    "hospital/building.nddl",
    "hospital/mission.toml",
)
ROVER, POWER, DIG, SEND, MOON = (
    "lunar/rover.nddl",
    "lunar/executive.nddl",
    "lunar/vehicle.nddl",
    "lunar/science.nddl",
    "lunar/mission.toml",
)
BREW, PLANT, BATCHES = "brewery/brewer.nddl", "brewery/plant.nddl", "brewery/mission.toml"

SLIPS_OF_NEWCOMERS = (
    # Power line.
    Mistake(LINE, "class WaterSpan extends Span {", "class WaterSpan extends Spam {", "`Span`"),
    Mistake(LINE, "super(a, l, h); extra = e;", "super(a, l); extra = e;", "Span(float"),
    Mistake(LINE, "away = a; length = l; height = h;", "away = a; length = l; height == h;", "`height = h;`"),
    Mistake(LINE, "enum Optics { visual, thermal, ultraviolet }", "enum Optics { visual thermal, ultraviolet }", "`,`"),
    Mistake(
        LINE,
        "predicate Follow { float metres; float height; Optics how; }",
        "predicate Follow { float metres, float height; Optics how; }",
        "`;`",
    ),
    Mistake(LINE, "predicate Test { int level; level <= 3; }", "predicate Test { int level; levle <= 3; }", "`level`"),
    Mistake(
        SPANS,
        "contains(Drone.Follow along);\n    along.metres == span.length;\n    along.how == how;",
        "contains(Drone.Folow along);\n    along.metres == span.length;\n    along.how == how;",
        "`Follow`",
        "Folow",
    ),
    Mistake(
        SPANS, "film.start + THERMAL_WARM <= along.start;", "film.start + THERMAL_WARM <= allong.start;", "`along`"
    ),
    Mistake(SPANS, "film contains along;", "film contians along;", "`contains`"),
    Mistake(SPANS, "if (how == Optics.thermal) {", "if (how == Optics.termal) {", "`thermal`"),
    Mistake(SPANS, "if (how == Optics.ultraviolet) {", "if (how = Optics.ultraviolet) {", "`==`"),
    Mistake(SPANS, "foreach (p in part) {", "foreach (p : part) {", "`in`"),
    Mistake(SPANS, "foreach (p in part) {", "foreach (p in parts) {", "`part`"),
    Mistake(SPANS, "charge.duration <= CHARGE_MAX;", "charge.duration =< CHARGE_MAX;", "`<=`"),
    Mistake(
        SPANS, "Span second = new Span(450.0, 400.0, 15.0);", "Span second = new Span(450.0, 400.0);", "Span(float"
    ),
    Mistake(SPANS, "Window noon = new Window(520, 1000);", "Window noon = new Window(520.5, 1000);", "int"),
    Mistake(
        SPANS,
        "predicate Inspect { Span span; Optics how; int number; }",
        "predicate Inspect { Span span; Optic how; int number; }",
        "`Optics`",
    ),
    Mistake(AIR, "starts_during(Wind.Calm calm);", "starts_during(Wind.Clam calm);", "`Calm`"),
    Mistake(AIR, "speed == CRUISE - head;", "speed == CRUISE - haed;", "`head`"),
    Mistake(AIR, "current == sampledParameter(CURRENT);", "current = sampledParameter(CURRENT);", "`==`"),
    Mistake(AIR, "Part gimbal = new Part(Internal);", "Part gimbal = new Part(Internal)", "`;`"),
    Mistake(CABLE, 'internal = ["task"]', 'internal = ["tasks"]', "`task`"),
    Mistake(CABLE, 'span = "second"', 'span = "secnd"', "`second`"),
    Mistake(CABLE, 'how = "thermal"', 'how = "termal"', "`thermal`"),
    Mistake(CABLE, 'distribution = "truncated_normal"', 'distribution = "truncatednormal"', "`truncated_normal`"),
    Mistake(CABLE, "level = [25, 100]", "level = 25", "[25"),
    # Hospital.
    Mistake(
        WARDS,
        "predicate Drive { float metres; bool careful; }",
        "predicate Drive { float metres; boolean careful; }",
        "`bool`",
    ),
    Mistake(WARDS, 'Lift(Mode m) { super(m, "Waits"); }', 'Lift(Mode m) { super(m, "Wait"); }', "`Waits`"),
    Mistake(WARDS, "class Ward {", "Class Ward {", "`class`"),
    Mistake(JOBS, "contains(object.robot.Load load);", "contains(robot.Load load);", "object.robot"),
    Mistake(JOBS, "contains(object.robot.Ride ride);", "contains(object.robots.Ride ride);", "`robot`"),
    Mistake(JOBS, "ride starts carry;", "ride start carry;", "`starts`"),
    Mistake(JOBS, "if (floors != 0) {", "if (floors <> 0) {", "`!=`"),
    Mistake(JOBS, "floors == target.floor - source.floor;", "floors == target.level - source.floor;", "floor"),
    Mistake(
        JOBS,
        "Jobs annas = new Jobs(Internal, anna, cellA, south, north);",
        "Jobs annas = new Jobs(Internal, anna, south, north);",
        "Jobs(Mode",
    ),
    Mistake(
        JOBS, 'kilos <= PAYLOAD : "the robot carries no more";', "kilos <= PAYLOAD : the robot carries no more;", '"'
    ),
    Mistake(JOBS, "drain.time == end;", "drain.tiem == end;", "`time`"),
    Mistake(
        BUILDING,
        "much == abs(floors);\n    duration == ceil(per * much) + wait + DOORS;\n}\n\nLift",
        "much == absolute(floors);\n    duration == ceil(per * much) + wait + DOORS;\n}\n\nLift",
        "abs(x)",
        "absolute",
    ),
    Mistake(BUILDING, "wipe.duration == 20;", "wipe.duration == 20 ticks;", "ticks"),
    Mistake(BUILDING, "time == metres / (pace * CAREFUL);", "time == metres / (pace * CAREFUL;", ")"),
    Mistake(MORNING, "[property.then]", "[property.than]", "`then`"),
    Mistake(MORNING, "weights = [0.3, 0.3, 0.3, 0.1]", "weights = [0.3, 0.3, 0.4]", "4"),
    Mistake(MORNING, "update = 30", "update = 0", "1"),
    Mistake(MORNING, 'kind = "within"', 'kind = "witin"', "`within`"),
    # Moon.
    Mistake(ROVER, "metres >= 0.0; metres <= 400.0; }", "metres >= 0.0; metres <= -400.0; }", "0"),
    Mistake(ROVER, "super(a, crater, d);", "super(a, craterr, d);", "`crater`"),
    Mistake(
        POWER,
        "any(battery.consume use);\n    use.time == end;\n    use.quantity == PER_METRE * site.away;",
        "any(batery.consume use);\n    use.time == end;\n    use.quantity == PER_METRE * site.away;",
        "`battery`",
        "batery",
    ),
    Mistake(POWER, "heat.start + lead <= bore.start;", "heat.begin + lead <= bore.start;", "start"),
    Mistake(POWER, "Sun sun = new Sun(Observe);", "Sun sun = new Sun(Observed);", "`Observe`"),
    Mistake(DIG, "duration == hatch + BAKING;", "duration == hatch + BAKEING;", "`BAKING`"),
    Mistake(DIG, "slip == sampledParameter(SLIP);", "slip == sampledParameter(slip);", "`SLIP`"),
    Mistake(SEND, "home.megabits == FRAME * frames;", "home.megabits == FRAME x frames;", "*"),
    Mistake(SEND, "nap.end <= night.dawn + 30;", "nap.end <= night.down + 30;", "`dawn`"),
    Mistake(MOON, 'code = "geologist.py:Geologist"', 'code = "geologist.py:Geolog"', "`Geologist`"),
    Mistake(MOON, 'reactor = "executive"\nlevel', 'reactor = "executiv"\nlevel', "`executive`", "executiv"),
    Mistake(MOON, 'night = "firstNight"', 'knight = "firstNight"', "`night`"),
    # Brewery.
    Mistake(BREW, "again.round == round + 1;", "again.round = round + 1;", "`==`"),
    Mistake(BREW, "contains(Kettle.Mash mash);", "contain(Kettle.Mash mash);", "`contains`"),
    Mistake(PLANT, "mulEq(time, gas, BOIL_BASE);", "mulEq(time, gas);", "3"),
    Mistake(PLANT, "slow == (yeast > LAZY);", "slow == yeast > LAZY;", "slow == (yeast > LAZY)"),
    Mistake(BATCHES, "lookahead = 1\n", "lookahed = 1\n", "`lookahead`"),
    # Of a twelfth newcomer, on these models.
    Mistake(
        "bakery/mission.toml",
        'where = "trays > 12"',
        'where = "trays > 12 && trays =< 90"',
        "trays > 12 and trays <= 90",
    ),
    Mistake("brewery/plant.nddl", "bool slow;", "bool slow; bool slow;", "leave out the second one"),
    Mistake(
        "brewery/plant.nddl",
        "Vat vat = new Vat(Internal);\nclose();",
        "close();\nVat vat = new Vat(Internal);",
        "`close();` stands behind the last object that is made",
        "new Vat(Internal)",
    ),
    Mistake("brewery/plant.nddl", "bool slow;", "bool slow; return ceil(time);", "a rule gives nothing back"),
    # Whole lines that are missing, or stand for others.
    Mistake(
        SPANS,
        "Pad pad = new Pad(External);\nclose();",
        "Pad pad = new Pad(External);",
        "write `close();` after the last object is made",
        "new Pad(External)",
    ),
    Mistake(CABLE, '"gimbal", "wind"]', '"gimball", "wind"]', "did you mean `gimbal`"),
    Mistake(CABLE, ', "gimbal", "wind"]', ', "wind"]', "list it under `internal` of"),
)
