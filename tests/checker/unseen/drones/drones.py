"""Three drones, simulated: how long a row takes depends on flowers and wind, charging on what is left."""

from math import ceil
from random import Random

from runtime.user.reactor import Now, Reactor

NAMES = ("one", "two", "three")


class Swarm(Reactor):
    """Owns the three drones, uses `wind` and `bloom`; setting `gust`: no drone begins in more wind."""

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.ends = {}
            for name in NAMES:
                now.publish(name, "Docked")
        for name, end in list(self.ends.items()):
            if end <= now.tick:
                del self.ends[name]
                now.publish(name, "Docked")
        for command in now.commands:
            name = command.timeline
            if name in self.ends or command.start[0] > now.tick:
                continue
            if command.predicate == "Charge":
                now.publish(name, "Charge", **command.arguments)
                self.ends[name] = now.tick + self.chance.randint(25, 60)
            elif self.wind(now) > float(self.settings["gust"]):
                now.wake(now.tick + 5)
                continue
            else:
                now.publish(name, "Pollinate", **command.arguments)
                self.ends[name] = now.tick + self.takes(now, int(command.arguments["metres"]))
            now.wake(self.ends[name])

    def wind(self, now: Now) -> float:
        here = now.seen.get("wind")
        return float(here.arguments["speed"]) if here and here.predicate == "Blows" else 0.0

    def takes(self, now: Now, metres: int) -> int:
        here = now.seen.get("bloom")
        density = float(here.arguments["density"]) if here and here.predicate == "Open" else 2.0
        return ceil(metres * (0.2 * density + 0.05 * self.wind(now)) + self.chance.random() * 5)


class Grower(Reactor):
    """Wants rows sprayed when the air is calm, and takes it back when it has changed its mind."""

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.asked = None
            now.wake(120)
        elif now.tick == 120:
            self.asked = now.ask("rowC", "Spray", start=(now.tick + 1, now.tick + 300))
            self.second = now.ask("rowA", "Spray", start=(450, 900))
            now.wake(400)
        elif now.tick == 400:
            now.recall(self.second)
