from runtime.user.reactor import Now, Reactor


class Stalls(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("eye", "Dark")
            now.wake(6)
        while now.tick == 6:
            pass
