"""Pictures of gaps and how they change: a bar over a plank, a ladder and a corner."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Polygon, Rectangle

from course.arrays import Array, ArrayLike
from course.dynamics import Bodies
from course.scenes import Scene, bar_and_plank_outlines
from course.study import GapRate
from course.workbook.plots.figure import (
    LINES,
    PALETTE,
    arrow,
    axes,
    centre_mark,
    describe,
    legend_beside,
    style,
)


def turning_pair(
    pair: Scene, times: Sequence[float] = (0.0,), *, ax: Axes | None = None
) -> Axes:
    """Bar over plank at the first time, and in outline at later ones; crosses mark the axles, which never move."""
    centres = pair.bodies.position[:, 1:]
    rate_a, rate_b = pair.bodies.angular_velocity[:, 0]
    with style():
        ax = axes(ax, size=(7.4, 3.4))
        for i, time in enumerate(times):
            outlines = bar_and_plank_outlines(pair.at(time))
            for outline, colour in zip(outlines, ("blue", "orange"), strict=True):
                filled: dict[str, Any] = {
                    "fc": PALETTE[colour],
                    "ec": "black",
                    "lw": 0.8,
                    "alpha": 0.75,
                }
                empty: dict[str, Any] = {
                    "fc": "none",
                    "ec": PALETTE[colour],
                    "lw": 1.4,
                    "ls": LINES[min(i, 3)],
                }
                ax.add_patch(Polygon(outline, **(empty if i else filled)))
        for place, name in zip(centres, ("A, the bar", "B, the plank"), strict=True):
            centre_mark(ax, place, ms=11, zorder=5)
            ax.text(place[0], place[1] - 0.17, name, ha="center", va="top")
        _written_gaps(ax, pair, times)
        _turn(ax, centres[0, 0] + 0.25, 0.75, f"{rate_a:g} rad/s", rate_a)
        _turn(ax, -0.65, 0.42, f"{rate_b:g} rad/s", rate_b)
        ax.set(
            xlim=(-1.6, 2.8),
            ylim=(-0.5, 1.15),
            aspect="equal",
            xlabel="y [m]",
            ylabel="z [m]",
        )
        if len(times) > 1:
            ax.set_title(
                f"filled: at {times[0]:g} s; in outline: at "
                + ", ".join(f"{t:g}" for t in times[1:])
                + " s"
            )
    gaps = ", ".join(f"{pair.gap(t):.3f} m at {t:g} s" for t in times)
    describe(
        ax,
        "Seen from the side: a bar A on an axle, its left end above the right half of a plank B on an axle. Both turn "
        f"against the clock, the bar at {rate_a:g} and the plank at {rate_b:g} rad/s. The gap between the "
        f"bar's lower corner and the plank is {gaps}.",
    )
    return ax


def marked_point(pair: Scene, place: float = -0.4, *, ax: Axes | None = None) -> Axes:
    """Bar over plank, level: the plank's point opposite the corner, and another point marked on the same face.

    Args:
        pair: bar and plank.
        place: y of the marked point [m].
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
            ax.text(
                point[0] + shift[0], point[1] + shift[1], name, ha=side, va="center"
            )
        foot = np.array([-1.1, opposite[1]])
        tip = foot + [0.0, 0.45]
        arrow(ax, foot, tip, "blue", label="$N$")
        arrow(ax, tip, tip - [0.3, 0.0], "blue", label=r"$\dot N$")
        _turn(ax, 0.0, 0.3, "B turns", pair.bodies.angular_velocity[1, 0])
        ax.set(
            xlim=(-1.7, 2.8),
            ylim=(-0.35, 0.85),
            aspect="equal",
            xlabel="y [m]",
            ylabel="z [m]",
        )
    describe(
        ax,
        "A bar A over a plank B, level. Two arrows run to the lower corner of A, p_A: one straight up along N from the "
        "opposite point of B's face, one slanting from another point marked on the same face. B turns against the "
        "clock, so N_dot points to the left, across N: along the slanting arrow it has a part, along the other none.",
    )
    return ax


def ladder_picture(
    y: float, z: float, angle: float, *, length: float = 4.0, ax: Axes | None = None
) -> Axes:
    """A ladder before a wall, wherever it is: its gaps to floor and wall, and the two normals."""
    half = 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
    centre = np.array([y, z])
    foot, top = centre - half, centre + half
    foot_gap, top_gap = foot[1], -top[0]
    with style():
        ax = axes(ax, size=(5.6, 4.6))
        left, high = foot[0] - 0.9, top[1] + 0.7
        ax.add_patch(Rectangle((left, -0.3), 0.3 - left, 0.3, fc="0.85", ec="none"))
        ax.add_patch(Rectangle((0, -0.3), 0.3, high + 0.3, fc="0.85", ec="none"))
        ax.plot([left, 0, 0], [0, 0, high], color="0.3", lw=1.5, ls="-", marker="")
        ax.plot(
            *np.stack([foot, top]).T,
            color=PALETTE["blue"],
            lw=6,
            ls="-",
            marker="",
            solid_capstyle="butt",
        )
        centre_mark(ax, centre)
        ax.text(
            centre[0] - 0.12, centre[1] + 0.12, "centre (y, z)", ha="right", va="bottom"
        )
        _measure(
            ax, foot, (foot[0], 0.0), f"$d_1$ = {foot_gap:.2f} m", (0.08, 0.0), "left"
        )
        _measure(
            ax,
            top,
            (0.0, top[1]),
            f"$d_2$ = {top_gap:.2f} m",
            (0.5 * top_gap - 0.04, 0.16),
            "right",
        )
        arrow(ax, (foot[0] - 0.45, 0.0), (foot[0] - 0.45, 0.55), label="$N_1$")
        arrow(ax, (0.0, 0.55 * high), (-0.55, 0.55 * high), label="$N_2$")
        ax.add_patch(Arc(tuple(foot), 1.3, 1.3, theta2=np.degrees(angle), lw=1.2))
        ax.plot(
            [foot[0], foot[0] + 0.9],
            [foot[1]] * 2,
            color="0.5",
            lw=0.8,
            ls=":",
            marker="",
        )
        ax.text(foot[0] + 0.75, foot[1] + 0.25, r"$\theta$")
        ax.set(
            xlim=(left, 0.35),
            ylim=(-0.35, high),
            aspect="equal",
            xlabel="y [m]",
            ylabel="z [m]",
        )
        ax.grid(False)
    describe(
        ax,
        f"A ladder of {length:g} m before a floor and a wall on its right, at {np.degrees(angle):.0f} degrees to the "
        f"floor. The gap from its foot down to the floor is {foot_gap:.2f} m, from its top across to the wall "
        f"{top_gap:.2f} m; N_1 points up out of the floor, N_2 to the left out of the wall.",
    )
    return ax


def contact_velocities(result: GapRate, *, ax: Axes | None = None) -> Axes:
    """Bar over plank, level: how fast the two points of the contact move, and what each motion adds to d_dot.

    With ``ax`` only the picture is drawn.
    """
    parts, total = result.parts, result.total
    with style():
        bars = None
        if ax is None:
            _, (ax, bars) = plt.subplots(1, 2, figsize=(9.6, 3.6), width_ratios=(3, 2))
        _bar_and_plank(ax, result.bodies)
        _point_velocities(ax, result.point, result.velocity)
        ax.set(
            xlim=(-1.6, 3.0),
            ylim=(-1.0, 1.4),
            aspect="equal",
            xlabel="y [m]",
            ylabel="z [m]",
        )
        word = (
            "neither"
            if abs(total) < 1e-9
            else "the gap closes"
            if total < 0
            else "the gap opens"
        )
        ax.set_title(f"$\\dot d$ = {total + 0.0:+.2f} m/s: {word}")
        ax.legend(loc="lower right")
        if bars is not None:
            _contributions(bars, parts, total)
    spoken = ", ".join(f"{name} {value + 0.0:+.2f}" for name, value in parts.items())
    describe(
        ax,
        f"A bar A over a plank B, level. What each motion adds to d_dot, in m/s: {spoken}; "
        f"in all {total + 0.0:+.2f}, {word}.",
    )
    return ax


def passing_a_corner(
    heights: Sequence[float] = (0.3, 0.03),
    *,
    speed: float = 1.0,
    step: float = 0.1,
    ax: Axes | None = None,
) -> Axes:
    """A point passes over the corner of a box at two heights: the nearest-point normal
    at equal times.
    """
    with style():
        ax = axes(ax, size=(7.2, 3.4))
        ax.add_patch(Rectangle((-1.0, -0.5), 1.0, 0.5, fc="0.85", ec="0.3"))
        for height, colour, line in zip(
            heights, ("blue", "vermillion", "green"), ("-", "--", "-."), strict=False
        ):
            y = speed * step * np.arange(-4, 7)
            ax.plot(
                y,
                np.full(y.shape, height),
                color=PALETTE[colour],
                lw=1.0,
                ls=line,
                marker="o",
                ms=4,
                label=f"passes at {height:g} m",
            )
            for place in y:
                nearest = np.minimum(np.array([place, height]), 0.0)
                normal = np.array([place, height]) - nearest
                reach = 0.85 * speed * step * normal / np.linalg.norm(normal)
                arrow(ax, (place, height), (place, height) + reach, colour, lw=1.3)
        ax.set(
            xlim=(-0.55, 0.75),
            ylim=(-0.15, 0.45),
            aspect="equal",
            xlabel="y [m]",
            ylabel="z [m]",
        )
        legend_beside(ax)
    describe(
        ax,
        "A point passes from left to right over the corner of a box, at "
        + " and at ".join(f"{h:g} m" for h in heights)
        + ". Over the box the normal points up. Past the corner it leans to the right: little by little at the greater "
        "height, all at once at the smaller.",
    )
    return ax


def _bar_and_plank(ax: Axes, bodies: Bodies) -> None:
    """Both as they lie, with the axles in their middles."""
    outlines = bar_and_plank_outlines(bodies)
    for outline, colour in zip(outlines, ("blue", "orange"), strict=True):
        ax.add_patch(
            Polygon(outline, fc=PALETTE[colour], ec="black", lw=0.8, alpha=0.5)
        )
    centre_mark(ax, bodies.position[:, 1:].T)


def _written_gaps(ax: Axes, pair: Scene, times: Sequence[float]) -> None:
    """One gap as a double arrow with its length; several as a list that points at the last one."""
    contact = pair.touching(pair.at(times[-1]))
    (_, y, z_a), (_, _, z_b) = contact.point_a[0], contact.point_b[0]
    if len(times) == 1:
        arrow(ax, (y, z_b), (y, z_a), lw=1.3, style="<->")
        ax.text(
            y - 0.05,
            0.5 * (z_a + z_b),
            f"d = {contact.separation[0]:.2f} m",
            ha="right",
            va="center",
        )
        return
    said = "\n".join(f"d = {pair.gap(t):.3f} m at {t:g} s" for t in times)
    ax.annotate(said, (y, 0.5 * (z_a + z_b)), (y - 0.6, z_a + 0.62), ha="center", va="center",
                arrowprops={"arrowstyle": "->", "lw": 1.1, "shrinkA": 2, "shrinkB": 3})  # fmt: skip


def _point_velocities(ax: Axes, points: Array, speeds: Array) -> None:
    """The points of A and B that meet, (2, 3), each with the arrow of its velocity.

    The longest has 0.75 m at most.
    """
    scale = 0.75 / max(2.0, *np.linalg.norm(speeds, axis=-1).tolist())
    for point, speed, colour, mark, name in zip(
        points, speeds, ("blue", "vermillion"), "os", "AB", strict=True
    ):
        arrow(ax, point[1:], point[1:] + scale * speed[1:], colour, lw=2.4)
        ax.plot(*point[1:], marker=mark, color=PALETTE[colour], ls="none",
                label=f"point of {name}, {speed[2]:+.2f} m/s along N")  # fmt: skip


def _contributions(ax: Axes, parts: Mapping[str, float], total: float) -> None:
    names, values = [*parts, "d_dot"], [*parts.values(), total]
    hatches = ("", "//", "", "//", "..")
    colours = ("blue", "blue", "vermillion", "vermillion", "grey")
    for i, (value, colour, hatch) in enumerate(
        zip(values, colours, hatches, strict=True)
    ):
        ax.bar(i, value, color=PALETTE[colour], hatch=hatch, ec="white")
    ax.axhline(0, color="0.3", lw=0.8)
    ax.set_xticks(
        range(len(names)),
        ["A\nrises", "A\nturns", "B\nrises", "B\nturns", "sum,\n$\\dot d$"],
    )
    reach = max(1.0, float(np.abs(values).max()))
    ax.set(
        ylabel="adds to the rate of the gap [m/s]", ylim=(-1.15 * reach, 1.15 * reach)
    )
    ax.grid(axis="x", visible=False)


def _measure(
    ax: Axes, start: ArrayLike, end: ArrayLike, label: str, shift: ArrayLike, side: str
) -> None:
    """A double arrow with its length beside it."""
    first, last = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    arrow(ax, first, last, "vermillion", lw=1.2, style="<->")
    y, z = 0.5 * (first + last) + np.asarray(shift)
    ax.text(y, z, label, color=PALETTE["vermillion"], ha=side, va="center")


def _turn(ax: Axes, y: float, z: float, label: str, rate: float) -> None:
    """A bent arrow in the sense of the rate, and the rate beside it."""
    ends = ((y + 0.18, z - 0.1), (y - 0.18, z - 0.1))
    start, end = ends if rate >= 0 else ends[::-1]
    bend = "arc3,rad=0.7" if rate >= 0 else "arc3,rad=-0.7"
    arrow(ax, start, end, lw=1.6, connectionstyle=bend)
    ax.text(y, z + 0.13, label, ha="center", va="bottom")
