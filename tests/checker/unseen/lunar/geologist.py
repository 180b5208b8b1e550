"""The geologist on shore: asks for another core where there is ice, once the night is over."""

from runtime.user.reactor import Now, Reactor


class Geologist(Reactor):
    """Uses `drill`, `sun` and `science`."""

    rich = None

    def tick(self, now: Now) -> None:
        """Remember the first rich core; ask for another one in the morning, and once for a look around."""
        if now.tick == 0:
            now.wake(self.settings["look"])
        if now.tick == self.settings["look"]:
            now.ask("science", "LookAround", start=(now.tick + 10, now.tick + 900), frames=6)
        if "drill" in now.news and now.seen["drill"].predicate == "Core":
            core = now.seen["drill"].arguments
            if self.rich is None and core["ice"] > self.settings["rich"]:
                self.rich = core["number"]
        if "sun" in now.news and now.seen["sun"].predicate == "Day" and now.tick > 0 and self.rich is not None:
            now.ask("science", "Deepen", start=(now.tick + 1, now.tick + self.settings["patience"]),
                    site="ridge", number=100 + self.rich)
