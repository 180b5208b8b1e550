from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.ask("task", "Do", start=5, n=1)
            now.ask("task", "Do", start=15, n=2)
            now.wake(8)
        elif now.tick == 8:
            raise ValueError(now.tick)
