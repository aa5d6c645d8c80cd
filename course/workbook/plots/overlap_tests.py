"""Pictures of lesson 04: the foot of a point on a line, and the steps of stored numbers."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.study import NumberSteps
from course.workbook.numbers import show
from course.workbook.plots.decades import label_decades
from course.workbook.plots.figure import (
    PALETTE,
    axes,
    describe,
    line,
    side_by_side,
    style,
)

#: How a size of number is drawn: bytes, colour, dashes.
SIZES = ((2, "orange", ":"), (4, "vermillion", "-"), (8, "blue", "--"))


def foot_of_point(point: ArrayLike, end: ArrayLike) -> tuple[Axes, Axes]:
    """A point beside the way from 0 to an end, and its squared distance from each share of the way.

    Args:
        point, end: p and b in the plane, (2,) each [m].
    """
    p, b = np.asarray(point, dtype=float), np.asarray(end, dtype=float)
    s = np.linspace(-0.6, 1.6, 111)
    squared = np.sum((p - s[:, None] * b) ** 2, axis=-1)
    least = float(p @ b / (b @ b))
    _, (left, right) = side_by_side(2, size=(9.6, 3.8))
    with style():
        _point_and_segment(left, p, b, s, least)
        line(right, np.stack([s, squared], axis=-1), "0.3")
        on = "on the segment, 0 ≤ s ≤ 1"
        right.axvspan(0, 1, color=PALETTE["blue"], alpha=0.15, label=on)
        lowest = np.sum((p - least * b) ** 2)
        right.plot(least, lowest, "o", color=PALETTE["green"], label="least")
        right.set_title("Squared distance of p and s b")
        right.set(xlabel="share s of the way", ylabel="[m²]")
        right.legend(loc="upper center")
    describe(
        right,
        f"Left: the point p at {tuple(p.tolist())} beside the segment from 0 to b at {tuple(b.tolist())}, and the "
        f"shortest way from p to the line, with its foot. Right: the squared distance of p and s b over s, a parabola; "
        f"it is least at s = {show(least, 3)}. The strip from 0 to 1 is the segment.",
    )  # fmt: skip
    return left, right


def _point_and_segment(ax: Axes, p: Array, b: Array, s: Array, least: float) -> None:
    """p, the segment from 0 to b with the line through it, and the shortest way to that line."""
    line(ax, s[[0, -1], None] * b, "0.6", ls=":", label="line through 0 and b")
    line(ax, [0 * b, b], "blue", lw=3, label="segment")
    line(ax, [p, least * b], "green", ls="--", label="shortest way to the line")
    for name, at, shift in (("0", 0 * b, (-9, -14)), ("b", b, (6, -12)), ("p", p, (5, 5))):  # fmt: skip
        ax.plot(*at, "o", color="black", ms=5)
        ax.annotate(name, tuple(at), shift, textcoords="offset points", weight="bold")
    ax.plot(*(least * b), "o", color=PALETTE["green"], label="foot", zorder=3)
    ax.set_title("A point and a segment")
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    ax.margins(0.1)
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, -0.32), ncols=2)


def number_steps(steps: NumberSteps, *, ax: Axes | None = None) -> Axes:
    """The step to the next number over the place, for 2, 4 and 8 bytes (``study.steps_of_numbers``)."""
    with style():
        ax = axes(ax, size=(6.6, 4.2))
        told = []
        for size, color, dashes in SIZES:
            label = f"{size} bytes"
            line(
                ax,
                steps.curves[size],
                color,
                ls=dashes,
                lw=2,
                label=label,
            )
            told.append(f"{label}: {show(steps.curves[size][0, 1], 3)} m at 1 m")
        marked, step = steps.marked, steps.marked_step
        ax.plot(marked, step, "o", color="black")
        ax.annotate(
            f"{show(step, 3)} m", (marked, step), (-40, 8), textcoords="offset points"
        )
        ax.axhline(0.01, color="0.6", lw=0.8)
        ax.text(1.2, 0.013, "1 cm", color="0.35", fontsize=8.5)
        ax.set(xscale="log", yscale="log", xlabel="place [m]", ylabel="step [m]")
        ax.set_title("Step from a number to the next")
        for axis in (ax.xaxis, ax.yaxis):
            label_decades(axis)
        ax.legend()
    describe(
        ax,
        f"The step from a number to the next larger one over the place, stairs along straight lines: "
        f"{'; '.join(told)}. At {show(marked, 3)} m numbers of 4 bytes have steps of {show(step, 3)} m. Numbers of 2 "
        f"bytes end at 65,504 m.",
    )  # fmt: skip
    return ax
