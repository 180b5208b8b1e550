from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        now.publish("eye", "Bright", p="much" if now.tick else 0.5)
        now.wake(now.tick + 6)
