"""The weather: fair until a gale is reported, whose force and tick the settings give; after it probes are wanted."""

from runtime.user.reactor import Now, Reactor


class Weather(Reactor):
    """Publishes a gale at each of some ticks, and fair weather after it."""

    def tick(self, now: Now) -> None:
        """Report, and wake for the next report."""
        gales = [int(word) for word in str(self.settings["gales"]).split()]
        forces = [float(word) for word in str(self.settings["forces"]).split()]
        if now.tick == 0:
            now.publish("sky", "Fair", wanted=0)
        for at, force in zip(gales, forces, strict=True):
            if now.tick == at:
                now.publish("sky", "Gale", force=force)
            if now.tick == at + 120:
                now.publish("sky", "Fair", wanted=2)
        later = [tick for at in gales for tick in (at, at + 120) if tick > now.tick]
        if later:
            now.wake(min(later))
