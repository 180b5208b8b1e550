from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("bell", "Off")
        if "eye" in now.news and now.seen["eye"].predicate == "Bright":
            now.publish("bell", "Ring", k=now.tick)
