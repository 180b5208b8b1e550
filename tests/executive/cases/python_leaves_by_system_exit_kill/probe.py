from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("src", "A")
            now.wake(5)
        else:
            raise SystemExit(0)
