"""Pictures of a bar over a plank: their gap, the points that make it, and its rate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from course.arrays import Array
from course.dynamics import Bodies
from course.scenes import Scene, bar_and_plank_outlines
from course.study import GapRate, PairStates
from course.workbook.plots.figure import (
    LINES,
    PALETTE,
    arrow,
    axes,
    centre_mark,
    describe,
    style,
)


def turning_pair(result: PairStates, *, ax: Axes | None = None) -> Axes:
    """Bar over plank at the first time, and in outline at later ones.

    Crosses mark the axles, which never move.
    """
    times, first = result.times, result.bodies[0]
    centres = first.position[:, 1:]
    rate_a, rate_b = first.angular_velocity[:, 0]
    with style():
        ax = axes(ax, size=(7.4, 3.4))
        for i, bodies in enumerate(result.bodies):
            _outlined(ax, bodies, i)
        for place, name in zip(centres, ("A, the bar", "B, the plank"), strict=True):
            centre_mark(ax, place, ms=11, zorder=5)
            ax.text(place[0], place[1] - 0.17, name, ha="center", va="top")
        _written_gaps(ax, result)
        _turn(ax, centres[0, 0] + 0.25, 0.75, f"{rate_a:g} rad/s", rate_a)
        _turn(ax, -0.65, 0.42, f"{rate_b:g} rad/s", rate_b)
        _frame(ax, (-1.6, 2.8), (-0.5, 1.15))
        if len(times) > 1:
            later = ", ".join(f"{t:g}" for t in times[1:])
            ax.set_title(f"filled: at {times[0]:g} s; in outline: at {later} s")
    gaps = ", ".join(
        f"{gap:.3f} m at {t:g} s" for gap, t in zip(result.gaps, times, strict=True)
    )
    describe(
        ax,
        "Seen from the side: a bar A on an axle, its left end above the right half of "
        "a plank B on an axle. Both turn against the clock, the bar at "
        f"{rate_a:g} and the plank at {rate_b:g} rad/s. The gap between the "
        f"bar's lower corner and the plank is {gaps}.",
    )
    return ax


def _outlined(ax: Axes, bodies: Bodies, later: int) -> None:
    """Both bodies, filled at the first time and in outline at each later one."""
    for outline, colour in zip(
        bar_and_plank_outlines(bodies), ("blue", "orange"), strict=True
    ):
        look: dict[str, Any] = {"fc": PALETTE[colour], "ec": "black", "lw": 0.8}
        look["alpha"] = 0.75
        if later:
            look = {"fc": "none", "ec": PALETTE[colour], "lw": 1.4}
            look["ls"] = LINES[min(later, 3)]
        ax.add_patch(Polygon(outline, **look))


def _written_gaps(ax: Axes, result: PairStates) -> None:
    """One gap as a double arrow with its length; several as a list beside the last."""
    (_, y, z_a), (_, _, z_b) = result.point_a, result.point_b
    middle = 0.5 * (z_a + z_b)
    if len(result.times) == 1:
        arrow(ax, (y, z_b), (y, z_a), lw=1.3, style="<->")
        said = f"d = {result.gaps[0]:.2f} m"
        ax.text(y - 0.05, middle, said, ha="right", va="center")
        return
    said = "\n".join(
        f"d = {gap:.3f} m at {t:g} s"
        for gap, t in zip(result.gaps, result.times, strict=True)
    )
    look = {"arrowstyle": "->", "lw": 1.1, "shrinkA": 2, "shrinkB": 3}
    ax.annotate(said, (y, middle), (y - 0.6, z_a + 0.62), ha="center", va="center",
                arrowprops=look)  # fmt: skip


def marked_point(pair: Scene, place: float = -0.4, *, ax: Axes | None = None) -> Axes:
    """Bar over plank, level, with two points marked on the plank's upper face.

    One lies opposite the corner, the other elsewhere.

    Args:
        pair: bar and plank.
        place: y of the other point [m].
    """
    contact = pair.contacts
    corner, opposite = contact.point_a[0, 1:], contact.point_b[0, 1:]
    marked = np.array([place, opposite[1]])
    with style():
        ax = axes(ax, size=(7.4, 2.7))
        _bar_and_plank(ax, pair.bodies)
        arrow(ax, opposite, corner)
        arrow(ax, marked, corner, "vermillion")
        for point, name, shift, side in (
            (corner, "$p_A$", (0.06, -0.1), "left"),
            (opposite, "$p_B$, opposite", (0.06, -0.2), "left"),
            (marked, "$p_B$, marked", (0.0, -0.2), "center"),
        ):
            ax.plot(*point, marker="o", ms=5, color="black", ls="none")
            y, z = point + shift
            ax.text(y, z, name, ha=side, va="center")
        foot = np.array([-1.1, opposite[1]])
        tip = foot + [0.0, 0.45]
        arrow(ax, foot, tip, "blue", label="$N$")
        arrow(ax, tip, tip - [0.3, 0.0], "blue", label=r"$\dot N$")
        _turn(ax, 0.0, 0.3, "B turns", pair.bodies.angular_velocity[1, 0])
        _frame(ax, (-1.7, 2.8), (-0.35, 0.85))
    describe(
        ax,
        "A bar A over a plank B, level. Two arrows run to the lower corner of A, p_A: "
        "one straight up along N from the opposite point of B's face, one slanting "
        "from another point marked on the same face. B turns against the clock, so "
        "N_dot points to the left, across N: along the slanting arrow it has a part, "
        "along the other none.",
    )
    return ax


def contact_velocities(result: GapRate, *, ax: Axes | None = None) -> Axes:
    """Bar over plank, level: how fast the two points of the contact move.

    Beside it stands what each motion adds to d_dot. With ``ax`` only the picture is
    drawn.
    """
    parts, total = result.parts, result.total
    word = f"the gap {'closes' if total < 0 else 'opens'}"
    word = "neither" if abs(total) < 1e-9 else word
    with style():
        bars = None
        if ax is None:
            _, (ax, bars) = plt.subplots(1, 2, figsize=(9.6, 3.6), width_ratios=(3, 2))
        _bar_and_plank(ax, result.bodies)
        _point_velocities(ax, result.point, result.velocity)
        _frame(ax, (-1.6, 3.0), (-1.0, 1.4))
        ax.set_title(f"$\\dot d$ = {total + 0.0:+.2f} m/s: {word}")
        ax.legend(loc="lower right")
        if bars is not None:
            _contributions(bars, parts, total)
    spoken = ", ".join(f"{name} {value + 0.0:+.2f}" for name, value in parts.items())
    describe(
        ax,
        "A bar A over a plank B, level. What each motion adds to d_dot, in m/s: "
        f"{spoken}; in all {total + 0.0:+.2f}, {word}.",
    )
    return ax


def _frame(ax: Axes, y: tuple[float, float], z: tuple[float, float]) -> None:
    ax.set(xlim=y, ylim=z, aspect="equal", xlabel="y [m]", ylabel="z [m]")


def _bar_and_plank(ax: Axes, bodies: Bodies) -> None:
    """Both as they lie, with the axles in their middles."""
    outlines = bar_and_plank_outlines(bodies)
    for outline, colour in zip(outlines, ("blue", "orange"), strict=True):
        look: dict[str, Any] = {"fc": PALETTE[colour], "ec": "black", "lw": 0.8}
        ax.add_patch(Polygon(outline, alpha=0.5, **look))
    centre_mark(ax, bodies.position[:, 1:].T)


def _point_velocities(ax: Axes, points: Array, speeds: Array) -> None:
    """The points of A and B that meet, (2, 3), each with the arrow of its velocity.

    The longest has 0.75 m at most.
    """
    scale = 0.75 / max(2.0, *np.linalg.norm(speeds, axis=-1).tolist())
    for point, speed, colour, mark, name in zip(
        points, speeds, ("blue", "vermillion"), "os", "AB", strict=True
    ):
        arrow(ax, point[1:], point[1:] + scale * speed[1:], colour, lw=2.4)
        label = f"point of {name}, {speed[2]:+.2f} m/s along N"
        ax.plot(*point[1:], marker=mark, color=PALETTE[colour], ls="none", label=label)


def _contributions(ax: Axes, parts: Mapping[str, float], total: float) -> None:
    names, values = [*parts, "d_dot"], [*parts.values(), total]
    hatches = ("", "//", "", "//", "..")
    colours = ("blue", "blue", "vermillion", "vermillion", "grey")
    for i, (value, colour, hatch) in enumerate(
        zip(values, colours, hatches, strict=True)
    ):
        ax.bar(i, value, color=PALETTE[colour], hatch=hatch, ec="white")
    ax.axhline(0, color="0.3", lw=0.8)
    ticks = ["A\nrises", "A\nturns", "B\nrises", "B\nturns", "sum,\n$\\dot d$"]
    ax.set_xticks(range(len(names)), ticks)
    reach = max(1.0, float(np.abs(values).max()))
    ax.set_ylabel("adds to the rate of the gap [m/s]")
    ax.set_ylim(-1.15 * reach, 1.15 * reach)
    ax.grid(axis="x", visible=False)


def _turn(ax: Axes, y: float, z: float, label: str, rate: float) -> None:
    """A bent arrow in the sense of the rate, and the rate beside it."""
    ends = ((y + 0.18, z - 0.1), (y - 0.18, z - 0.1))
    start, end = ends if rate >= 0 else ends[::-1]
    bend = "arc3,rad=0.7" if rate >= 0 else "arc3,rad=-0.7"
    arrow(ax, start, end, lw=1.6, connectionstyle=bend)
    ax.text(y, z + 0.13, label, ha="center", va="bottom")
