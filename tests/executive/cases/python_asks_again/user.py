from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 4:
            now.ask("arm", "Act", start=4, n=1)
        elif now.refused:
            now.ask("arm", "Act", start=(now.tick + 3, now.tick + 9), n=2)
        elif now.tick < 4:
            now.wake(4)
