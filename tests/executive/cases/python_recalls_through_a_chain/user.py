from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.wake(4)
        elif now.tick == 4:
            self.number = now.ask("job", "Make", start=20, n=3)
            now.wake(12)
        elif now.tick == 12:
            now.recall(self.number)
