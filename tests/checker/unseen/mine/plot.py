"""The classifier: while the sonar listens on a lane it may see contacts, and asks the planner to deal with each."""

from random import Random

from runtime.user.reactor import Now, Reactor

KINDS = ("MOORED", "BOTTOM", "DRUM")


class Classifier(Reactor):
    """Owns `plot`, uses `sonar` and `hunt`; settings `share`, `most`, `patience`."""

    def tick(self, now: Now) -> None:
        if now.tick == 0:
            self.chance = Random(int(self.settings["seed"]))
            self.contacts = 0
            self.due = None
            now.publish("plot", "Clear")
        if "sonar" in now.news and now.seen["sonar"].predicate == "Listen":
            if self.contacts < int(self.settings["most"]) and self.chance.random() < float(self.settings["share"]):
                self.due = now.tick + self.chance.randint(20, 100)
                now.wake(self.due)
        if self.due == now.tick:
            self.contacts += 1
            self.due = None
            distance = float(self.chance.randint(40, 250))
            kind = KINDS[self.chance.choice((0, 0, 1, 1, 2))]
            now.publish("plot", "Contact", id=self.contacts, distance=distance, mine=kind)
            now.ask("hunt", "Prosecute", start=(now.tick + 1, now.tick + 1500), id=self.contacts, distance=distance, mine=kind)
