from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.number = now.ask("task", "Do", start=5, n=1)
            now.wake(6)
        elif now.tick == 6:
            now.recall(self.number)
            now.ask("task", "Do", start=(7, 20), n=2)
