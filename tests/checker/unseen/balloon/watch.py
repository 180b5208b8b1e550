"""The watch on the ground: it reads the anemometer, and has the gondola braced before it gets rough."""

from runtime.user.reactor import Now, Reactor


class Watch(Reactor):
    """Uses `sonde` and `guard`, owns `bulletin`."""

    wakes_on = ("sonde",)

    def tick(self, now: Now) -> None:
        """Tell the weather, and ask for bracing in a gust."""
        if "sonde" not in now.news:
            return
        wind = now.seen["sonde"].arguments["wind"]
        if isinstance(wind, tuple):
            return
        limit = float(self.settings["limit"])
        if wind > limit:
            now.publish("bulletin", "Gale", wind=wind)
            level = 1 if wind < limit + 1.5 else 2
            now.ask("guard", "Braced", start=(now.tick + 1, now.tick + int(self.settings["grace"])), level=level)
        else:
            now.publish("bulletin", "Fair")
