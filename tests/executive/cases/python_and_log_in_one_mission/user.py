from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick < 4:
            now.wake(now.tick + 2)
        else:
            if now.tick == 4:
                now.ask("task", "Do", start=(5, 30), n=3)
