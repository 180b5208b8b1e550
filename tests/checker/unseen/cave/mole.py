"""The robot's physics: way, battery, link and drift."""

from random import Random

from runtime.user.reactor import Now, Reactor


class Mole(Reactor):
    """Owns robot, battery, link and drift; sees the water."""

    wakes_on = ("water",)

    def tick(self, now: Now) -> None:
        s = self.settings
        if now.tick == 0:
            self.at, self.goal, self.doing, self.left = 0.0, 0.0, "Idle", 0
            self.charge, self.drift, self.low, self.lost = 100.0, 0.0, False, False
            self.stream = 0.0
            self.last = 0
            self.chance = Random(int(s["seed"]))
            now.publish("robot", "Idle")
            now.publish("battery", "Good", charge=100.0)
            now.publish("link", "Up")
            now.publish("drift", "Unknown")
        if "water" in now.seen:
            self.stream = now.seen["water"].arguments["speed"]
        steps = now.tick - self.last
        self.last = now.tick
        for _ in range(steps):
            self.move(now)
        for command in now.commands:
            if self.doing == "Idle" and command.start[0] <= now.tick:
                self.begin(now, command)
        now.wake(now.tick + 1 if self.doing != "Idle" else now.tick + 10)

    def begin(self, now: Now, command) -> None:
        self.doing = command.predicate
        if self.doing == "Go":
            self.goal = command.arguments["crumb"] * 25.0
            now.publish("robot", "Go", crumb=command.arguments["crumb"])
            now.publish("drift", "Unknown")
        elif self.doing == "Fix":
            self.left = 10
            now.publish("robot", "Fix")
        else:
            self.goal = 0.0
            now.publish("robot", "Return")

    def move(self, now: Now) -> None:
        s = self.settings
        self.charge -= s["idle"]
        if self.doing == "Go":
            self.charge -= s["drive"]
            self.at += s["speed"] - self.stream
            self.drift += s["slip"] * self.chance.random()
            if self.at >= self.goal:
                self.at = self.goal
                self.stop(now)
                now.publish("drift", "Seen", crumb=int(self.goal / 25.0), metres=self.drift)
        elif self.doing == "Return":
            self.charge -= s["drive"]
            self.at -= s["speed"] + self.stream
            if self.at <= 0.0:
                self.at = 0.0
                self.stop(now)
        elif self.doing == "Fix":
            self.left -= 1
            if self.left <= 0:
                self.drift = 0.0
                self.stop(now)
        if not self.low and self.charge < s["warn"]:
            self.low = True
            now.publish("battery", "Low", charge=self.charge)
        lost = s["shadow_from"] < self.at < s["shadow_to"]
        if lost != self.lost:
            self.lost = lost
            if lost:
                now.publish("link", "Lost", metres=self.at)
            else:
                now.publish("link", "Up")

    def stop(self, now: Now) -> None:
        self.doing = "Idle"
        now.publish("robot", "Idle")
