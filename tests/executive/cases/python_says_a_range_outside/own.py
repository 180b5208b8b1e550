from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(6)
        if now.tick == 6:
            now.publish("src", "B", n=(2, 4))
            now.wake(10)
        if now.tick == 10:
            now.publish("src", "C")
