from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def __init__(self, settings: object) -> None:
        raise ValueError("no table")

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(6)
