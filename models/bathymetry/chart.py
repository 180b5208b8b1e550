"""A sea chart as a constraint: how deep the water is at a place, between soundings that stand in chart.csv."""

import csv
from bisect import bisect_right
from pathlib import Path

from runtime.user.constraint import Constraint, View

SOUNDINGS = "chart.csv"


class Chart:
    """Soundings on a grid: columns are metres east, rows metres north, numbers metres of water."""

    def __init__(self, path: Path) -> None:
        with path.open(newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        self.east = [float(cell) for cell in head[1:]]
        self.north = [float(row[0]) for row in rows]
        self.depths = [[float(cell) for cell in row[1:]] for row in rows]

    def depth(self, x: float, y: float) -> float:
        """The depth at a place on the chart, linear between the four soundings around it."""
        i, j = cell(self.east, x), cell(self.north, y)
        u = (x - self.east[i]) / (self.east[i + 1] - self.east[i])
        v = (y - self.north[j]) / (self.north[j + 1] - self.north[j])
        south = self.depths[j][i] * (1 - u) + self.depths[j][i + 1] * u
        north = self.depths[j + 1][i] * (1 - u) + self.depths[j + 1][i + 1] * u
        return south * (1 - v) + north * v

    def range(self, x: tuple[float, float], y: tuple[float, float]) -> tuple[float, float]:
        """The least and the greatest sounding of all cells that a box touches: no depth in the box is beyond them."""
        columns = range(cell(self.east, x[0]), cell(self.east, x[1]) + 2)
        rows = range(cell(self.north, y[0]), cell(self.north, y[1]) + 2)
        found = [self.depths[j][i] for j in rows for i in columns]
        return min(found), max(found)


def cell(lines: list[float], at: float) -> int:
    """The number of the cell between two grid lines that a coordinate lies in."""
    return min(max(bisect_right(lines, at) - 1, 0), len(lines) - 2)


class ChartDepth(Constraint):
    """`chart_depth(depth, x, y)`, or `depth == chart_depth(x, y)`."""

    name = "chart_depth"
    signature = "depth:number x:number y:number"
    meaning = "depth is that of the sea chart at x metres east and y metres north; there is none beyond its edges"
    result = 0
    gives = "float"
    files = (SOUNDINGS,)

    def __init__(self, chart: Chart) -> None:
        self.chart = chart

    def propagate(self, view: View) -> bool:
        """Stay on the chart; bound the depth by the cells that are still possible, and be exact at a single place."""
        east, north = self.chart.east, self.chart.north
        if not (view.raise_to(1, east[0]) and view.reduce_to(1, east[-1])):
            return False
        if not (view.raise_to(2, north[0]) and view.reduce_to(2, north[-1])):
            return False
        if view.is_single(1) and view.is_single(2):
            return view.fix(0, self.chart.depth(float(view.value(1)), float(view.value(2))))
        low, high = self.chart.range((view.lower(1), view.upper(1)), (view.lower(2), view.upper(2)))
        return view.raise_to(0, low) and view.reduce_to(0, high)


CONSTRAINTS = [ChartDepth(Chart(Path(__file__).with_name(SOUNDINGS)))]
