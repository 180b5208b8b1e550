from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:  # type: ignore[misc]
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(5)
        else:
            now.publish("src", "B")
        yield 1
