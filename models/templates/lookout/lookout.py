"""A lookout: now and then it sees a whale, and asks the ship to go slow."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Lookout(Reactor):
    """Owns `whales`, uses `ship`; `every` and `share` are its settings, `seed` is the mission's."""

    def tick(self, now: Now) -> None:
        """Look out every so many ticks. It is called in between as well, when the ship does something else."""
        every = int(self.settings["every"])
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
        if now.tick % every == 0:
            self.look_out(now)
        now.wake(now.tick - now.tick % every + every)

    def look_out(self, now: Now) -> None:
        """Say what is seen, and ask for what it demands."""
        if self.chance.random() < float(self.settings["share"]):
            now.publish("whales", "Seen", distance=self.chance.randint(100, 900))
            now.ask("ship", "Slow", start=(now.tick + 1, now.tick + 20))
        else:
            now.publish("whales", "Nothing")
