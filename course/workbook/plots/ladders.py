"""Pictures of a ladder before a wall: its gaps, and the forces while it slides down."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Rectangle

from course.arrays import Array, ArrayLike
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    centre_mark,
    describe,
    legend_beside,
    line,
    style,
)


def ladder_picture(
    y: float, z: float, angle: float, *, length: float = 4.0, ax: Axes | None = None
) -> Axes:
    """A ladder before a wall, wherever it is: its gaps to both, and the two normals."""
    half = 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
    centre = np.array([y, z])
    foot, top = centre - half, centre + half
    left, high = foot[0] - 0.9, top[1] + 0.7
    with style():
        ax = axes(ax, size=(5.6, 4.6))
        _floor_and_wall(ax, left, high)
        line(ax, [foot, top], "blue", lw=6, solid_capstyle="butt")
        centre_mark(ax, centre)
        beside = centre + [-0.12, 0.12]
        ax.text(beside[0], beside[1], "centre (y, z)", ha="right", va="bottom")
        _ladder_gaps(ax, foot, top)
        arrow(ax, (foot[0] - 0.45, 0.0), (foot[0] - 0.45, 0.55), label="$N_1$")
        arrow(ax, (0.0, 0.55 * high), (-0.55, 0.55 * high), label="$N_2$")
        ax.add_patch(Arc(tuple(foot), 1.3, 1.3, theta2=np.degrees(angle), lw=1.2))
        line(ax, [foot, foot + [0.9, 0.0]], "0.5", lw=0.8, ls=":")
        ax.text(foot[0] + 0.75, foot[1] + 0.25, r"$\theta$")
        ax.set(xlim=(left, 0.35), ylim=(-0.35, high), aspect="equal")
        ax.set(xlabel="y [m]", ylabel="z [m]")
        ax.grid(False)
    describe(
        ax,
        f"A ladder of {length:g} m before a floor and a wall on its right, at "
        f"{np.degrees(angle):.0f} degrees to the floor. The gap from its foot down to "
        f"the floor is {foot[1]:.2f} m, from its top across to the wall {-top[0]:.2f} "
        "m; N_1 points up out of the floor, N_2 to the left out of the wall.",
    )
    return ax


def _floor_and_wall(ax: Axes, left: float, high: float) -> None:
    look: dict[str, Any] = {"fc": "0.85", "ec": "none"}
    ax.add_patch(Rectangle((left, -0.3), 0.3 - left, 0.3, **look))
    ax.add_patch(Rectangle((0, -0.3), 0.3, high + 0.3, **look))
    line(ax, [(left, 0), (0, 0), (0, high)], lw=1.5)


def _ladder_gaps(ax: Axes, foot: Array, top: Array) -> None:
    """d_1 from the foot down to the floor, d_2 from the top across to the wall."""
    below, beside = foot[1], -top[0]
    said = f"$d_1$ = {below:.2f} m"
    _measure(ax, foot, (foot[0], 0.0), said, (0.08, 0.0), "left")
    said, shift = f"$d_2$ = {beside:.2f} m", (0.5 * beside - 0.04, 0.16)
    _measure(ax, top, (0.0, top[1]), said, shift, "right")


def _measure(
    ax: Axes, start: ArrayLike, end: ArrayLike, label: str, shift: ArrayLike, side: str
) -> None:
    """A double arrow with its length beside it."""
    first, last = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    arrow(ax, first, last, "vermillion", lw=1.2, style="<->")
    y, z = 0.5 * (first + last) + np.asarray(shift)
    ax.text(y, z, label, color=PALETTE["vermillion"], ha=side, va="center")


def ladder_forces(
    angles: ArrayLike,
    forces: ArrayLike,
    closed: ArrayLike,
    *,
    leaving: float,
    ax: Axes | None = None,
) -> Axes:
    """Forces of floor and wall over a ladder's angle.

    The closed form is drawn as lines, what was solved for as marks.

    Args:
        angles: (k,) [rad].
        forces, closed: (k, 2) [N], floor and wall.
        leaving: the angle at which it leaves the wall [rad].
    """
    degrees, f, exact = np.degrees(angles), np.asarray(forces), np.asarray(closed)
    left = f"{np.degrees(leaving):.1f}"
    with style():
        ax = axes(ax, size=(8.0, 4.0))
        for k, (name, colour, mark, dash) in enumerate(
            (("floor", "blue", "o", "-"), ("wall", "vermillion", "s", "--"))
        ):
            curve = np.stack([degrees, exact[:, k]], axis=-1)
            line(ax, curve, colour, ls=dash, label=f"{name}, closed form")
            look: dict[str, Any] = {"color": PALETTE[colour], "marker": mark}
            ax.plot(degrees, f[:, k], ls="none", label=f"{name}, solved", **look)
        said = f"leaves the wall: {left}°"
        ax.axvline(np.degrees(leaving), color="0.3", ls=":", label=said)
        ax.axhline(0, color="0.3", lw=0.8)
        ax.invert_xaxis()
        ax.set(xlabel="angle to the floor [degrees], falling", ylabel="force [N]")
        legend_beside(ax)
    last = int(np.argmin(degrees))
    describe(
        ax,
        "Forces of floor and wall on a ladder that slides down, over its angle. Marks "
        f"lie on the lines of the closed form until it leaves the wall at {left} "
        f"degrees. After that the closed form of the wall falls to "
        f"{exact[last, 1]:.0f} N and the solved one stays at {f[last, 1] + 0:.0f} N.",
    )
    return ax
