"""The users: they add samples to the queue while the run goes on, and take some back."""

from random import Random

from runtime.user.reactor import Now, Reactor

SLOTS = ("first", "second", "third", "fourth")
PROTOCOLS = ("crystal", "scatter", "powder")


class Users(Reactor):
    """Uses `queue` and `ring`; settings `every`, `most`. A sample that waits when the beam is dumped is taken back."""

    wakes_on = ("ring",)

    def tick(self, now: Now) -> None:
        every = int(self.settings["every"])
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.number = 100
            self.waiting = []
        if now.tick and now.tick % every == 0 and self.number < 100 + int(self.settings["most"]):
            self.number += 1
            self.waiting.append(
                now.ask(
                    "queue",
                    "Sample",
                    start=(now.tick + 10, now.tick + 900),
                    number=self.number,
                    slot=self.chance.choice(SLOTS),
                    protocol=self.chance.choice(PROTOCOLS),
                    urgency="SPARE",
                )
            )
        if now.seen["ring"].predicate == "Dumped" and "ring" in now.news and len(self.waiting) > 1:
            now.recall(self.waiting.pop())
        if now.tick < 3000:
            now.wake(now.tick - now.tick % every + every)
