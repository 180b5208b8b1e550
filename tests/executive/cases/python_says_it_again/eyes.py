from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        now.publish("eye", "Dark")
        now.wake(now.tick + 5)
