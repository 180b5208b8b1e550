from runtime.user.reactor import Now, Reactor


class User(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick < 10:
            now.wake(10)
        if now.tick == 0:
            now.publish("mood", "Low")
            now.ask("task", "Do", start=(30, 30), n=1)
        if now.tick == 10:
            self.late = now.ask("task", "Do", start=(5, 5), end=(6, 9), n=2)
        if now.refused:
            assert now.refused == {self.late}
            now.publish("mood", "High")
