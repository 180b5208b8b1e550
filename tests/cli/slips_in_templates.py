"""Slips of who changes a template or an example: what was typed, where it is told, and what helps."""

from tests.cli.habits import Mistake

TIMES = "templates/deadline/planner.nddl"
WINDOW = "templates/window/planner.nddl"
BATTERY = "templates/battery/planner.nddl"
FLIGHT = "templates/battery/mission.toml"
TRIPS = "templates/constraint/mission.toml"
WHALES = "templates/lookout/mission.toml"

SLIPS_IN_TEMPLATES = (
    # Keywords and brackets.
    Mistake(TIMES, "class Lab extends", "clas Lab extends", "`class`"),
    Mistake(TIMES, "class Lab extends AgentTimeline", "class Lab extnds AgentTimeline", "`extends`"),
    Mistake(TIMES, "predicate Analyse { }", "predicat Analyse { }", "`predicate`"),
    Mistake(TIMES, "predicate Analyse { }", "predicate Analyse { ", "}"),
    Mistake(TIMES, "contains(Oven.Bake bake);", "contains(Oven.Bake bake));", ")"),
    Mistake(TIMES, 'super(m, "Waiting")', 'super(m, "Waiting)', '"'),
    Mistake(TIMES, "new Lab(Internal);", "new Lab(Internal;", ")"),
    Mistake(TIMES, "ANALYSIS_MAX = 90;", "ANALYSIS_MAX = 90", "`;`"),
    Mistake(TIMES, '#include "lander.nddl"', '#include "lander"', "`lander.nddl`"),
    Mistake(TIMES, '#include "lander.nddl"', '#inclde "lander.nddl"', "`#include`"),
    Mistake(TIMES, "Oven oven = new Oven(External);", "Oven oven = nwe Oven(External);", "`new`"),
    Mistake(TIMES, "close();", "clsoe();", "`close`"),
    Mistake(TIMES, "Lab(Mode m) { super", "Lab(Mode m) { supr", "`super`"),
    Mistake(WINDOW, "Pass pass;\n", "Pass pass\n", "`;`"),
    # Classes, members, predicates.
    Mistake(TIMES, "contains(Oven.Bake bake);", "contains(Lab.Bake bake);", "Oven"),
    Mistake(TIMES, "contains(Oven.Bake bake);", "contains(object.Bake bake);", "Oven"),
    Mistake(TIMES, "contains(Oven.Bake bake);", "contains(oven.Bake bake);", "is used above its declaration"),
    Mistake(TIMES, "contains(Oven.Bake bake);", "contains(OVEN.Bake bake);", "`Oven`"),
    Mistake(TIMES, "Lab::Analyse {", "Lab::Bake {", "Oven"),
    Mistake(TIMES, "Lab::Analyse {", "Oven::Analyse {", "Lab"),
    Mistake(WINDOW, "pass.rise <= send.start;", "pass.rises <= send.start;", "`rise`"),
    Mistake(WINDOW, "pass.rise <= send.start;", "Pass.rise <= send.start;", "`pass`"),
    Mistake(WINDOW, "new Pass(100, 140)", "new Pass(140)", "Pass(int"),
    Mistake(WINDOW, "new Pass(100, 140)", "new Pass(100, evening)", "is used above its declaration"),
    Mistake(WINDOW, "    int rise;\n", "", "rise", "rise = r;"),
    Mistake(WINDOW, "send.size == size;", "send.size = size;", "`==`"),
    Mistake(WINDOW, "Talk talk = new Talk(Internal);", "Talk talk = new Talk(internal);", "`Internal`"),
    Mistake(WINDOW, "Talk talk = new Talk(Internal);", "Talk talk = new Talk();", "Mode"),
    Mistake(WINDOW, "Talk talk = new Talk(Internal);", "talk Talk = new Talk(Internal);", "`Talk talk`"),
    Mistake(BATTERY, "any(Reservoir.consume use);", "any(Reservoir.consumes use);", "`consume`"),
    Mistake(BATTERY, "use.time == end;", "use.tiem == end;", "`time`"),
    Mistake(BATTERY, "use.quantity == energy;", "use.quantity == Energy;", "`energy`"),
    Mistake(BATTERY, "gain.quantity == 40.0;", "gain.quantity == 40,0;", "40.0"),
    Mistake("templates/retry/planner.nddl", "first.attempt == 1;", "first.attempt == one;", "one"),
    Mistake("templates/retry/planner.nddl", 'attempt < ATTEMPTS : "no', 'attempt < ATTEMPTS "no', "`:`"),
    Mistake("templates/retry/planner.nddl", "first before held;", "first bevore held;", "`before`"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "if (fails)", "{"),
    Mistake("templates/retry/simulator.nddl", "if (fails) {", "If (fails) {", "`if`"),
    Mistake("templates/retry/simulator.nddl", "} else {", "} esle {", "`else`"),
    Mistake("templates/retry/simulator.nddl", "} else {", "} else", "{"),
    Mistake("templates/retry/simulator.nddl", "    } else {", "    else {", "}", "if (fails) {"),
    Mistake("templates/noise/simulator.nddl", "sampledParameter(TRIM)", "sampleParameter(TRIM)", "`sampledParameter`"),
    Mistake("templates/noise/simulator.nddl", "time == distance / speed;", "time == distnace / speed;", "`distance`"),
    Mistake("templates/constraint/planner.nddl", "high_water(sail.start);", "highwater(sail.start);", "`high_water`"),
    # The mission file.
    Mistake(FLIGHT, 'solver = "planner.toml"', 'solver = "planer.toml"', "`planner.toml`"),
    Mistake(FLIGHT, "energy = 50.0", "energy = true", "number"),
    Mistake(FLIGHT, 'predicate = "Load"', 'predicate = "Unload"', "`Load`"),
    Mistake(FLIGHT, 'predicate = "Load"', 'predicate = "load"', "`Load`"),
    Mistake(
        FLIGHT, 'timeline = "work"\npredicate = "Load"', 'timeline = "drone"\npredicate = "Load"', "work", '"Load"'
    ),
    Mistake(FLIGHT, "missions = 20", "missions = -20", "1"),
    Mistake(FLIGHT, "missions = 20", "misions = 20", "`missions`"),
    Mistake(FLIGHT, "final_tick = 400", "final_tick = -400", "0"),
    Mistake(FLIGHT, '[[reactor]]\nname = "simulator"', '[reactor]\nname = "simulator"', "[[reactor]]"),
    Mistake(FLIGHT, 'predicate = "Load"\nmandatory = true', 'predicate = "Load"\nmandatory = yes', "true", "= yes"),
    Mistake(
        FLIGHT, 'predicate = "Load"\nmandatory = true', 'predicate = "Load"\nmandatory = "true"', "true", '= "true"'
    ),
    Mistake(FLIGHT, "[mission]", "[mission", "]"),
    Mistake(FLIGHT, "[check]", "[mission]", "once"),
    Mistake(FLIGHT, 'name = "battery"', 'name = "battery', '"'),
    Mistake(TRIPS, 'modules = ["tide.py"]', 'modules = ["tides.py"]', "`tide.py`"),
    Mistake(TRIPS, "number = 2", "number = 2.5", "whole"),
    Mistake(TRIPS, "number = 2", "numbr = 2", "`number`"),
    Mistake(TRIPS, "start = [300, 1000]", "start = [300, 1000", "]"),
    Mistake(TRIPS, "start = [300, 1000]", "start = [300, 1000, 1100]", "[300, 1100]"),
    Mistake(TRIPS, "start = [300, 1000]", "start = [300]", "[300, 300]"),
    Mistake(TRIPS, "tick = 1.0", "tick = 0.0", "0"),
    Mistake(TRIPS, "latency = 1", "latency = 1.5", "whole"),
    Mistake(WHALES, 'code = "lookout.py:Lookout"', 'code = "lookout.py:Lokout"', "`Lookout`"),
    Mistake(WHALES, 'code = "lookout.py:Lookout"', 'code = "lookot.py:Lookout"', "`lookout.py`"),
    Mistake(WHALES, 'code = "lookout.py:Lookout"', 'code = "lookout.py"', "lookout.py:Lookout"),
    Mistake(WHALES, 'kind = "within"', 'kind = "whithin"', "`within`"),
    Mistake(WHALES, 'timeline = "whales"', 'timeline = "wales"', "`whales`"),
    Mistake(WHALES, 'predicate = "Slow"', 'predicate = "Slwo"', "`Slow`"),
    Mistake(WHALES, 'internal = ["ship"]', 'internals = ["ship"]', "`internal`"),
    Mistake("templates/deadline/mission.toml", "end = [0, 200]", "end = [310, 400]", "300"),
    Mistake("templates/deadline/mission.toml", 'kind = "reached"', 'kind = "reach"', "`reached`"),
    Mistake("templates/deadline/mission.toml", "by = 180", "by = 1800", "300"),
    Mistake("templates/deadline/mission.toml", "by = 180", "within = 180", "by"),
    Mistake("templates/noise/mission.toml", "[parameters.TRIM]", "[parameters.TRIMM]", "`TRIM`"),
)
