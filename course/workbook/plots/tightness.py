"""Pictures of lesson 01: how tight colliders are, against what one question costs."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from course.study import WorkPrecision
from course.study.precision import Cost
from course.workbook.plots.figure import MARKERS, PALETTE, axes, describe, style

#: Where a name stands beside its mark [points], and how it is aligned.
BESIDE = {"above": (0, 9, "center"), "left": (-9, -4, "right"), "right": (9, -4, "left")}  # fmt: skip
COLORS = {"sphere": "orange", "box": "vermillion", "hull": "green", "compound": "purple"}  # fmt: skip


def tightness_against_cost(
    measured: WorkPrecision, *, by: Cost = "count", ax: Axes | None = None
) -> Axes:
    """A mark for each collider: the filled share of what it calls inside, over the cost.

    Args:
        measured: of ``study.mug_costs``, whose error is the share of air.
        by: "count", comparisons a point; or "seconds", for all points.
    """
    told = []
    with style():
        ax = axes(ax, size=(6.4, 4.0) if by == "count" else (7.4, 4.6))
        ways = list(dict.fromkeys(_way(name) for name in measured.method))
        for name, error, cost in zip(
            measured.method, measured.error, measured.cost(by), strict=True
        ):
            if by == "count" and cost == 0:
                continue
            kind, way = name.split(",")[0], _way(name)
            ax.plot(
                cost, 1 - error, MARKERS[ways.index(way)], ms=9, ls="none",
                color=PALETTE[COLORS[kind]],
            )  # fmt: skip
            told.append((kind, way, float(cost), float(1 - error)))
        _names(ax, told, ways, by)
    words = ", ".join(
        f"{kind}{f' by {way}' if way else ''} {tight:.2f}"
        for kind, way, _, tight in told
    )
    unit = measured.count_unit if by == "count" else "time"
    describe(ax, f"Tightness over {unit}, from the cheapest kind to the dearest: {words}.")  # fmt: skip
    return ax


def _way(name: str) -> str:
    return name.partition(", ")[2]


def _names(
    ax: Axes, told: list[tuple[str, str, float, float]], ways: list[str], by: Cost
) -> None:
    """The kinds' names at the first marks of each, the ways in a legend, and the axes."""
    for kind in dict.fromkeys(k for k, *_ in told):
        _, _, cost, tight = max((t for t in told if t[0] == kind), key=lambda t: t[2])
        dx, dy, where = BESIDE["left" if kind == "compound" and by == "count" else "right"]  # fmt: skip
        ax.annotate(kind, (cost, tight), (dx, dy), textcoords="offset points", ha=where)
    if by == "seconds":
        for way in ways:
            label = way or "one comparison a face, in NumPy"
            ax.plot([], [], MARKERS[ways.index(way)], color="0.4", ls="none", label=label)  # fmt: skip
        ax.legend(loc="center left", bbox_to_anchor=(0.02, 0.66))
    title = "comparisons for one point" if by == "count" else "time for all points [s]"
    ax.set(xscale="log", ylim=(0, 1.08), xlabel=title, ylabel="tightness")
    ax.set_title("A mug and four colliders")
    ax.margins(x=0.18)
    ax.set_yticks(np.linspace(0, 1, 6))
