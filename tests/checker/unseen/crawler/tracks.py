"""The tracks of the crawler, and the watch over contamination."""

from runtime.user.reactor import Now, Reactor

WAY = {"hatch": 0, "cellA": 30, "cellB": 45, "drain": 60}


class Tracks(Reactor):
    """Drives: as long as the way between two places takes, at the speed of the settings."""

    where = "hatch"
    goal = None
    arrives = 0

    def tick(self, now: Now) -> None:
        """Begin what was asked for, end what is over."""
        if now.tick == 0:
            now.publish("tracks", "Stands")
        if self.goal is not None and now.tick >= self.arrives:
            self.where, self.goal = self.goal, None
            now.publish("tracks", "Stands")
        if self.goal is None:
            for command in now.commands:
                low, high = command.start
                if low <= now.tick <= high:
                    self.goal = command.arguments["to"]
                    way = abs(WAY[self.goal] - WAY[self.where])
                    self.arrives = now.tick + 1 + int(way / float(self.settings["speed"]))
                    now.publish("tracks", "Drive", to=self.goal)
                    break
        if self.goal is not None:
            now.wake(max(self.arrives, now.tick + 1))


class Watch(Reactor):
    """Reads the dosimeter: asks for a decontamination where it reads too much, takes it back where it was dust."""

    wakes_on = ("meter", "job")

    asked = None
    begun = False
    count = 0

    def tick(self, now: Now) -> None:
        """One request at a time; at most `most` per entry."""
        if self.asked in now.refused:
            self.asked = None
            now.publish("alarm", "Quiet")
        if now.tick == 0:
            now.publish("alarm", "Quiet")
        if "job" in now.news and self.asked is not None:
            if now.seen["job"].predicate == "Decontaminate":
                self.begun = True
            elif self.begun:
                self.asked, self.begun = None, False
                now.publish("alarm", "Quiet")
        if "meter" not in now.news:
            return
        rate = now.seen["meter"].arguments["rate"]
        if rate > float(self.settings["high"]) and self.asked is None and self.count < int(self.settings["most"]):
            self.count += 1
            now.publish("alarm", "Contaminated", rate=rate)
            self.asked = now.ask(
                "job", "Decontaminate", start=(now.tick + 2, now.tick + 400), at="cellB", area=1.0 + self.count * 0.5
            )
        elif rate < float(self.settings["low"]) and self.asked is not None and not self.begun:
            now.recall(self.asked)
            self.asked = None
            now.publish("alarm", "Quiet")
