"""The two reactors of front tracking that are written in Python: the profiler on board, and the people on shore."""

from runtime.user.reactor import Now, Reactor

CELL = 5.0  # metres of depth


class Profiler(Reactor):
    """Sorts what the vehicle meets on its way through the water column into cells of 5 m. Owns `thermo`."""

    cell = -1

    def tick(self, now: Now) -> None:
        """Tell when another cell of the water column is reached; near the surface there is no profile."""
        here = now.seen["vehicle"].arguments
        x, y, z = here["x"], here["y"], here["z"]
        assert isinstance(x, float) and isinstance(y, float) and isinstance(z, float)
        cell = int(z / CELL)
        if cell == self.cell:
            return
        self.cell = cell
        if cell == 0:
            now.publish("thermo", "Flat")
        else:
            now.publish("thermo", "Profile", bin=cell, x=x, y=y)


class Shore(Reactor):
    """Asks for a first track, and, once the front is known to have moved, takes it back and asks for another."""

    first = 0

    def tick(self, now: Now) -> None:
        """Post the first track at once, the second at `moves_at`."""
        moves_at = int(self.settings["moves_at"])
        if now.tick == 0:
            self.first = self.track(now, float(self.settings["x"]), float(self.settings["y"]))
        if now.tick < moves_at:
            now.wake(moves_at)
        elif now.tick == moves_at:
            now.recall(self.first)
            self.track(now, float(self.settings["new_x"]), float(self.settings["new_y"]))

    def track(self, now: Now, x: float, y: float) -> int:
        """Ask for a track across the front, from (x, y) eastwards."""
        return now.ask(
            "front",
            "Track",
            start=(now.tick + 1, now.tick + int(self.settings["patience"])),
            passes=int(self.settings["passes"]),
            xa=x,
            ya=y,
            xb=x + float(self.settings["length"]),
            yb=y,
            half=float(self.settings["half"]),
            top=5.0,
            bottom=40.0,
        )
