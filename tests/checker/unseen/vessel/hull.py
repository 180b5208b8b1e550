"""The crew vessel: speed falls with the waves, a push takes longer in a sea."""

from math import ceil
from random import Random

from runtime.user.reactor import Now, Reactor


class Vessel(Reactor):
    """Owns `hull`, sees `sea`."""

    until = None  # the tick at which what goes on is done

    def tick(self, now: Now) -> None:
        """Begin what is due, end what is done."""
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            now.publish("hull", "Lying")
        if self.until is not None and now.tick >= self.until:
            self.until = None
            now.publish("hull", "Lying")
        for command in now.commands:
            if self.until is None and command.start[0] <= now.tick and self.may(now, command):
                self.begin(now, command)
        if self.until is not None:
            now.wake(self.until)

    def may(self, now, command):
        """Whether the sea lets it begin."""
        sea = now.seen["sea"]
        return command.predicate != "Push" or (sea.predicate == "Calm" and sea.arguments["height"] <= command.arguments["waves"])

    def begin(self, now, command):
        """Publish what was asked for, and find out how long it takes."""
        waves = 1.0
        if "sea" in now.seen:
            waves = now.seen["sea"].arguments["height"]
        name = command.predicate
        if name == "Push":
            ticks = command.arguments["ticks"]
            late = self.chance.randint(0, int(self.settings["clumsy"]))
            now.publish("hull", "Push", ticks=ticks, waves=command.arguments["waves"], number=command.arguments["number"])
            self.until = now.tick + ticks + late
        else:
            miles = command.arguments["miles"]
            knots = float(self.settings["knots"]) * (1.0 - 0.12 * waves)
            now.publish("hull", name, miles=miles)
            self.until = now.tick + max(1, ceil(60.0 * miles / knots / 6.0 * 2.0))
