from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick < 10:
            now.wake(10)
        if now.tick == 0:
            self.number = now.ask("task", "Do", start=(5, 5), n=1)
        if now.tick == 10:
            now.recall(self.number)
