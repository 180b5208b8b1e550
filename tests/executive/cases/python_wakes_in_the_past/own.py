from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(6)
        if now.tick == 6:
            now.wake(5)
