"""Posts one strip after the other while the sky is dry, and takes back what has not begun when a front is announced."""

from runtime.user.reactor import Now, Reactor


class Dispatcher(Reactor):
    """Uses `field` and `sky`; posts strips."""

    def tick(self, now: Now) -> None:
        s = self.settings
        if now.tick == 0:
            self.posted, self.open, self.dry = 0, {}, True
        if "sky" in now.news and now.seen["sky"].predicate != "Dry":
            self.dry = False
            for number in list(self.open.values()):
                now.recall(number)
            self.open.clear()
        if "field" in now.news and now.seen["field"].predicate == "Strip":
            self.open.pop(now.seen["field"].arguments["number"], None)
        if self.dry and now.tick % s["every"] == 5 and self.posted < s["strips"]:
            self.posted += 1
            self.open[self.posted] = now.ask(
                "field",
                "Strip",
                start=(now.tick + 1, now.tick + s["patience"]),
                cart=("near", "far")[self.posted % 2],
                number=self.posted,
                length=s["length"],
                tonnes=s["tonnes"],
            )
        now.wake(now.tick + 1 if now.tick % s["every"] < 5 else now.tick - now.tick % s["every"] + s["every"] + 5)
