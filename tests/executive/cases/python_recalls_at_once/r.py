from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.recall(now.ask("task", "Do", start=(5, 5), n=1))
