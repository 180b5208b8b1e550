"""A probe for oxygen: every so many ticks it reads, and asks for air where there is too little."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Probe(Reactor):
    """Owns `oxygen`, uses `air` and `blower`."""

    def tick(self, now: Now) -> None:
        """Read when it is time; fish that eat need more."""
        every = int(self.settings["every"])
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.level = 9.0
        if now.tick % every == 0:
            eating = now.seen["blower"].predicate == "Blow"
            self.level -= (1.6 if eating else 0.5) + 0.4 * self.chance.random()
            if now.seen["air"].predicate == "Aerate":
                self.level += 2.0
            self.level = min(10.0, max(5.2, self.level))
            low = self.level < float(self.settings["low"])
            now.publish("oxygen", "Low" if low else "Fine", milligrams=self.level)
            if low and now.seen["air"].predicate != "Aerate":
                now.ask("air", "Aerate", start=(now.tick + 1, now.tick + int(self.settings["patience"])), litres=300.0)
                self.level += 1.5
        now.wake(now.tick - now.tick % every + every)
