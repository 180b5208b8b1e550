from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.ask("task", "Do", start=30, n=1)
            now.ask("task", "Do", start=29, n=2)
