"""The devices of the laboratory, and the ward that posts urgent tubes."""

from math import ceil
from random import Random

from runtime.user.reactor import Now, Reactor

IDLE = {"centrifuge": "Rest", "slow_one": "Ready", "quick_one": "Ready", "cart": "Parked"}


class Line(Reactor):
    """Owns the devices: each does one command at a time."""

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.until = {}
            self.celsius, self.wear = 22.0, 0.2
            for timeline, predicate in IDLE.items():
                now.publish(timeline, predicate)
        if "room" in now.news and now.seen["room"].predicate == "Reading":
            self.celsius = now.seen["room"].arguments["celsius"]
            self.wear = now.seen["room"].arguments["wear"]
        for timeline, tick in list(self.until.items()):
            if tick <= now.tick:
                del self.until[timeline]
                now.publish(timeline, IDLE[timeline])
        for command in now.commands:
            if command.timeline not in self.until and command.start[0] <= now.tick:
                self.until[command.timeline] = now.tick + self.takes(command)
                now.publish(command.timeline, command.predicate, **command.arguments)
        if self.until:
            now.wake(max(now.tick + 1, min(self.until.values())))

    def takes(self, command) -> int:
        """How long it takes."""
        arguments = command.arguments
        if command.predicate == "Spin":
            return ceil(10 + 0.2 * arguments["force"] + 10 * self.wear)
        if command.predicate == "Run":
            base = {"serum": 14, "plasma": 10, "urine": 8}[arguments["tube"]]
            slow = 1.5 if command.timeline == "slow_one" else 1.0
            return ceil(base * slow + max(0.0, self.celsius - 24.0))
        if command.predicate == "Clean":
            return int(self.settings["cleaning"])
        return int(self.settings["way"])


class Ward(Reactor):
    """Posts urgent tubes, some time apart."""

    wakes_on = ("stat",)

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.number = 100
            self.next = self.chance.randint(40, 80)
        if now.tick == self.next and self.number < 102:
            self.number += 1
            now.ask("stat", "Urgent", start=(now.tick + 1, now.tick + 15), tube=self.chance.choice(["serum", "plasma"]), number=self.number)
            now.publish("bell", "Rang", number=self.number)
            self.next = now.tick + self.chance.randint(90, 120)
        elif now.tick == 0:
            now.publish("bell", "Silent")
        if self.next > now.tick:
            now.wake(self.next)
