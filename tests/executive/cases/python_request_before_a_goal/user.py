from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.wake(2)
        elif now.tick == 2:
            self.number = now.ask("task", "Do", start=10, n=1)
            now.wake(6)
        elif now.tick == 6:
            now.recall(self.number)
