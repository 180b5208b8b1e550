from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("mood", "High")
            now.publish("mood", "Low")
            now.wake(4)
        if now.tick == 4:
            self.late = now.ask("arm", "Act", start=4)
            now.ask("arm", "Act", start=(5, 9))
        if now.refused:
            assert now.refused == {self.late}
            now.publish("mood", "High")
