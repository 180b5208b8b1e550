from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("eye", "Dark")
            now.wake(7)
        if now.tick == 7:
            now.publish("eye", "Bright", p=0.5)
