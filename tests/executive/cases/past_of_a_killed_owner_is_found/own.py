from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(6)
        if now.tick == 6:
            now.publish("src", "B", n=7)
            now.wake(8)
            now.wake(12)
        if now.tick == 8:
            now.publish("src", "C")
        if now.tick == 12:
            raise ValueError("broken")
