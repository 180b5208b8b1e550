"""The bridge, which calls for the pilot when the cargo is on board, and the launch that brings him."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Bridge(Reactor):
    """Counts what was loaded; asks to leave when `loads` loads are on board, but not in fog."""

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("bridge", "Quiet")
            self.done = 0
            self.boxes = 0
            self.under_way = None
            self.number = None
            self.again = None
            self.gone = False
        if "cargo" in now.news:
            cargo = now.seen["cargo"]
            if self.under_way is not None:
                self.done += 1
                self.boxes += self.under_way
                self.under_way = None
            if cargo.predicate == "Load":
                self.under_way = cargo.arguments["boxes"]
        if self.number is not None and self.number in now.refused:
            self.number = None
        leaving = "departure" in now.seen and now.seen["departure"].predicate == "Leave"
        self.gone = self.gone or leaving
        foggy = now.seen["sight"].predicate == "Fog"
        if foggy and self.number is not None and not self.gone and self.again is None:
            now.recall(self.number)
            self.again = True
        if self.done >= int(self.settings["loads"]) and not foggy and not self.gone and (self.number is None or self.again):
            self.again = None
            now.publish("bridge", "Ready", boxes=self.boxes)
            self.number = now.ask(
                "departure", "Leave", start=(now.tick + 10, now.tick + int(self.settings["patience"])), boxes=self.boxes
            )


class Launch(Reactor):
    """Brings the pilot: `far` ticks, and up to `swell` more."""

    until = None

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            now.publish("launch", "Moored")
        for command in now.commands:
            if command.arguments["boxes"] < 1:
                now.decline(command.number, "an empty ship needs no pilot")
            elif self.until is None and command.start[0] <= now.tick:
                self.until = now.tick + int(self.settings["far"]) + self.chance.randint(0, int(self.settings["swell"]))
                now.publish("launch", "Carry", boxes=command.arguments["boxes"])
                now.wake(self.until)
        if self.until is not None and now.tick >= self.until:
            self.until = None
            now.publish("launch", "Moored")
