from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.wake(5)
        elif now.tick == 5:
            now.ask("task", "Do", start=(9, 30), n=3)
            now.ask("task", "Do", start=(6, 30), n=1)
            now.ask("task", "Do", start=(8, 30), n=2)
