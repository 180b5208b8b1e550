from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("mood", "Low")
            now.wake(14)
            now.wake(10)
        if now.tick == 10:
            now.publish("mood", "High")
        if now.tick == 14:
            now.publish("mood", "Low")
