"""The watch tower: reports the fire, retargets a drone by recall and a new goal."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Tower(Reactor):
    """Owns `fire`, uses `east` and `west`."""

    def tick(self, now: Now) -> None:
        """At first all is quiet; then the fire spreads, and sectors are watched elsewhere."""
        first = int(self.settings["spreads_at"])
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            now.publish("fire", "Smoulders")
            self.old = now.ask("west", "Scan", start=(first + 60, first + 250), sector="ridge", sensor="VISUAL", ticks=20, number=31)
            self.spread = first + self.chance.randint(0, 40)
            now.wake(self.spread)
        if now.tick == self.spread:
            now.publish("fire", "Spreads", row=2)
            now.recall(self.old)
            now.ask("west", "Scan", start=(now.tick + 20, now.tick + 300), sector="valley", sensor="THERMAL", ticks=25, number=32)
