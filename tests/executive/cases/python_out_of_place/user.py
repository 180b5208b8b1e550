from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.ask("task", "Do", start=10, n=2)
        elif now.refused:
            now.ask("task", "Do", start=(now.tick + 1, 25), n=3)
