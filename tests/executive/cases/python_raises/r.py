from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick < 10:
            now.wake(10)
        if now.tick == 10:
            raise ValueError(now.tick)
