"""The winch: pays out and hauls in wire, slower in waves."""

from runtime.user.reactor import Now, Reactor


class Winch(Reactor):
    """Owns `winch`, uses `swell`."""

    depth = 0.0
    target = None
    state = "Stowed"

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("winch", "Stowed")
        height = now.seen["swell"].arguments["height"] if "swell" in now.seen else 1.0
        if self.state in ("Lower", "Haul"):
            self.move(now, height)
        for command in now.commands:
            if self.state in ("Lower", "Haul") or command.start[0] > now.tick:
                continue
            if command.predicate == "Lower":
                if command.arguments["depth"] > self.settings["wire"]:
                    now.decline(command.number, "not so much wire")
                    continue
                self.target = command.arguments["depth"]
                self.state = "Lower"
                now.publish("winch", "Lower", depth=self.target)
            elif command.predicate == "Haul":
                self.target = 0.0
                self.state = "Haul"
                now.publish("winch", "Haul")
        if self.state in ("Lower", "Haul"):
            now.wake(now.tick + 1)

    def move(self, now: Now, height: float) -> None:
        """One tick of wire."""
        speed = self.settings["speed"] * (1.0 - 0.12 * height)
        if self.state == "Lower":
            self.depth = min(self.target, self.depth + speed)
            if self.depth >= self.target:
                self.state = "Hangs"
                now.publish("winch", "Hangs", depth=self.depth)
        else:
            self.depth = max(0.0, self.depth - 0.8 * speed)
            if self.depth <= 0.0:
                self.state = "Stowed"
                now.publish("winch", "Stowed")
