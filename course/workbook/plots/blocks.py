"""Pictures of two blocks and a wall: the scene, the paths, the circle of velocities."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle, Wedge

from course.dynamics import TwoBlocks
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    bare,
    describe,
    line,
    style,
)


def blocks_and_wall(*, ax: Axes | None = None) -> Axes:
    """The scene of the question: a wall, a small block, and a heavy one coming in."""
    with style():
        ax = axes(ax, size=(7.2, 2.1))
        ax.add_patch(Rectangle((-0.35, 0), 0.35, 2.0, fc="0.8", ec="0.3", hatch="///"))
        line(ax, [(-0.35, 0), (9.2, 0)], lw=1.2)
        for left, size, colour, label in (
            (2.0, 0.55, "blue", "1 kg"),
            (5.4, 1.7, "vermillion", "10,000 kg"),
        ):
            look: dict[str, Any] = {"fc": PALETTE[colour], "ec": "black", "lw": 0.8}
            ax.add_patch(Rectangle((left, 0), size, size, alpha=0.85, **look))
            ax.text(left + size / 2, size + 0.1, label, ha="center", va="bottom")
        arrow(ax, (5.3, 0.85), (4.1, 0.85), "vermillion", lw=2.4)
        ax.text(4.7, 1.0, "1 m/s", ha="center")
        ax.set(xlim=(-0.5, 9.2), ylim=(-0.1, 2.3), aspect="equal")
        bare(ax)
    describe(
        ax,
        "A wall on the left, a block of 1 kg at rest, and a block of 10,000 kg sliding "
        "toward it at 1 m/s.",
    )
    return ax


def block_paths(motion: TwoBlocks, *, ax: Axes | None = None) -> Axes:
    """Two blocks and a wall in space and time: where each is, and every collision."""
    end = 1.2 * motion.time[-1]
    time, place = motion.paths(end)
    with style():
        ax = axes(ax, size=(7.2, 4.2))
        for i, (colour, dashes) in enumerate((("blue", "-"), ("vermillion", "--"))):
            label = f"block {i + 1}, {motion.mass[i]:g} kg"
            path = np.stack([place[:, i], time], axis=-1)
            line(ax, path, colour, ls=dashes, label=label)
        look: dict[str, Any] = {"ls": "none", "ms": 3.5, "color": "black"}
        met = motion.position[:, 0], motion.time
        ax.plot(*met, marker="o", label="a collision", **look)
        ax.axvline(0.0, color="0.4", lw=3, marker="", ls="-")
        ax.set(xlabel="distance from the wall [m]", ylabel="time [s]")
        ax.set(xlim=(-0.05, 2.1), ylim=(0, end))
        ax.set_title(f"{motion.count} collisions")
        ax.legend(loc="center right")
    describe(
        ax,
        "Paths of two blocks before a wall, mass ratio "
        f"{motion.mass[1] / motion.mass[0]:g}: the light block zigzags between the "
        f"wall and the heavy one, {motion.count} collisions in all, then both leave.",
    )
    return ax


def velocity_circle(motion: TwoBlocks, *, ax: Axes | None = None) -> Axes:
    """The same collisions in the plane of sqrt(m) v.

    Equal energy is a circle, each collision a chord. The grey wedge holds the states
    after which nothing meets any more: 0 <= v1 <= v2.
    """
    points = motion.scaled_velocity[:, ::-1]
    with style():
        ax = axes(ax, size=(7.8, 4.8))
        _circle_and_wedge(ax, float(np.linalg.norm(points[0])), motion.wedge_angle)
        for at_wall, colour, dashes, name in (
            (False, "blue", "-", "block hits block"),
            (True, "orange", "--", "block hits wall"),
        ):
            for k in np.flatnonzero(motion.at_wall == at_wall):
                line(ax, points[k : k + 2], colour, lw=1.3, ls=dashes, label=name)
                name = "_"
        for point, mark, colour, name in (
            (points[0], "s", "vermillion", "before"),
            (points[-1], "^", "green", "at the end"),
        ):
            look: dict[str, Any] = {"ms": 8, "color": PALETTE[colour], "ls": "none"}
            ax.plot(*point, marker=mark, label=name, **look)
        ax.set_xlabel(r"$x = \sqrt{m_2}\,v_2$ [J$^{1/2}$]")
        ax.set_ylabel(r"$y = \sqrt{m_1}\,v_1$ [J$^{1/2}$]")
        ax.set_aspect("equal")
        ax.set_title(f"{motion.count} collisions on one circle")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    describe(
        ax,
        "The velocities of both blocks, each times the root of its mass: "
        f"{motion.count + 1} points on one circle, joined by chords, slanted for block "
        "against block and vertical for block against wall, that lead from the left "
        "side of the circle step by step to a narrow wedge on the right side, where "
        "nothing meets any more.",
    )
    return ax


def _circle_and_wedge(ax: Axes, radius: float, theta: float) -> None:
    look: dict[str, Any] = {"fc": "0.75", "ec": "none"}
    label = "nothing meets here"
    wedge = Wedge((0, 0), 1.12 * radius, 0, np.degrees(theta), label=label, **look)
    ax.add_patch(wedge)
    turn = np.linspace(0, 2 * np.pi, 300)
    line(ax, radius * np.stack([np.cos(turn), np.sin(turn)], axis=-1), "0.6", lw=1)
