from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("bell", "Off")
            now.wake(4)
        if now.tick == 4:
            now.ask("arm", "Act", start=(5, 9), n=1)
        if now.refused:
            now.publish("bell", "Ring", k=len(now.refused))
