"""The thermometer of the cold box: it warms while the door is open, and asks for cooling."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Thermo(Reactor):
    """Owns `temp`; uses `door`, `cooler` and `care`."""

    def tick(self, now: Now) -> None:
        """Take the temperature every few ticks."""
        every = int(self.settings["every"])
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.degrees = 5.0
            self.warm = False
            self.asked = None
            now.publish("temp", "Fine")
        if now.tick > 0 and now.tick % every == 0:
            self.measure(now)
        now.wake(now.tick - now.tick % every + every)

    def measure(self, now: Now) -> None:
        """Warmer by the open door and by the sun, colder by the compressor."""
        every = int(self.settings["every"])
        if now.seen["door"].predicate == "Ajar":
            self.degrees += every * float(self.settings["leak"]) * self.chance.uniform(0.8, 1.2)
        if now.seen["cooler"].predicate == "Chills":
            self.degrees -= every * float(self.settings["chill"])
        if self.degrees > float(self.settings["limit"]) and not self.warm:
            self.warm = True
            now.publish("temp", "Warm", degrees=self.degrees)
            self.asked = now.ask(
                "care", "Boost", start=(now.tick + 1, now.tick + 20), degrees=int(self.settings["boost"])
            )
        elif self.degrees < float(self.settings["limit"]) and self.warm:
            self.warm = False
            now.publish("temp", "Fine")
