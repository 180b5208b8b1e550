"""The two reactors of the INL mission that are written in Python: one finds the feature, one asks for a closer look."""

import csv
from collections.abc import Mapping
from pathlib import Path

from runtime.user.reactor import Now, Reactor, Value

UNDER_WAY = ("YoYo", "Straight")  # behaviours that lead through the water


class Detector(Reactor):
    """Hidden Markov model of two states, Outside and Inside, over the clusters that the water is found to belong to.

    It owns `feature` and uses `water`, and `helm`: what is met while the vehicle is not under way tells nothing new, it
    stays where it is or is at the surface. The table says of each cluster how probable Inside is where it is met; the
    estimate enters as a likelihood ratio. Two thresholds keep it from going back and forth.
    """

    wakes_on = ("water",)

    def __init__(self, settings: Mapping[str, Value]) -> None:
        super().__init__(settings)
        table = Path(__file__).with_name(str(settings["clusters"]))
        self.inside = cluster_table(table.read_text(encoding="utf-8"))
        self.stay = float(settings["stay"])
        self.enter = float(settings["enter"])
        self.leave = float(settings["leave"])
        self.belief = float(settings["prior"])
        self.is_inside = False

    def tick(self, now: Now) -> None:
        """Update the belief with each summary of the water; tell when the state changes."""
        if now.tick == 0:
            now.publish("feature", "Outside")
        if "water" not in now.news or now.seen["water"].predicate != "Holds":
            return
        if now.seen["helm"].arguments.get("kind") not in UNDER_WAY:
            return
        cluster = now.seen["water"].arguments["id"]
        if not isinstance(cluster, int):
            return
        self.belief = updated(self.belief, self.stay, self.inside[cluster])
        if not self.is_inside and self.belief > self.enter:
            self.is_inside = True
            now.publish("feature", "Inside", p=self.belief)
        elif self.is_inside and self.belief < self.leave:
            self.is_inside = False
            now.publish("feature", "Outside")


class Surveyor(Reactor):
    """Asks for a denser survey around the place where the feature was entered, as long as there are samplers for it.

    It stands between `feature` and `survey`, so that who finds the feature does not depend on who plans surveys.
    """

    wakes_on = ("feature",)

    def __init__(self, settings: Mapping[str, Value]) -> None:
        super().__init__(settings)
        self.pairs = int(settings["samplers"]) // 2
        self.asked: set[int] = set()  # numbers of the surveys that were asked for and not refused

    def tick(self, now: Now) -> None:
        """Ask for a box around the present estimate whenever the feature is entered."""
        self.asked -= now.refused
        if "feature" not in now.news or now.seen["feature"].predicate != "Inside":
            return
        if len(self.asked) >= self.pairs:
            return
        here = now.seen["vehicle"].arguments
        x, y = here["x"], here["y"]
        assert isinstance(x, float) and isinstance(y, float)
        width, spacing, lines = float(self.settings["width"]), float(self.settings["spacing"]), self.settings["lines"]
        number = now.ask(
            "survey",
            "HighRes",
            x0=x - width / 2.0,
            y0=y - spacing * (int(lines) - 1) / 2.0,
            width=width,
            spacing=spacing,
            lines=int(lines),
            linesPerFix=int(self.settings["linesPerFix"]),
            top=float(self.settings["top"]),
            bottom=float(self.settings["bottom"]),
        )
        self.asked.add(number)


def cluster_table(text: str) -> dict[int, float]:
    """How probable Inside is in each cluster; raises ValueError for what is no probability."""
    table = {int(row["cluster"]): float(row["inside"]) for row in csv.DictReader(text.splitlines())}
    for cluster, inside in table.items():
        if not 0.0 < inside < 1.0:
            raise ValueError(f"cluster {cluster}: {inside} is not between 0 and 1")
    return table


def updated(belief: float, stay: float, inside: float) -> float:
    """The belief in Inside after one more summary of the water: a step of the chain, then Bayes' rule."""
    before = belief * stay + (1.0 - belief) * (1.0 - stay)
    odds = before / (1.0 - before) * (inside / (1.0 - inside))
    return odds / (1.0 + odds)
