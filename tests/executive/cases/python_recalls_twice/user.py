from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.number = now.ask("task", "Do", start=10, n=1)
            now.wake(3)
            now.wake(4)
        elif now.tick in (3, 4):
            now.recall(self.number)
            if now.tick == 4:
                now.ask("task", "Do", start=10, n=2)
