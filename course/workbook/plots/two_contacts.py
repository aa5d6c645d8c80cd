"""Pictures of two contacts: the plane of their forces, and a plank that has them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from course.arrays import Array
from course.study import PlankForces, TwoForces
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    describe,
    line,
    side_by_side,
    style,
)
from course.workbook.plots.numerals import plain


def force_plane(
    result: TwoForces,
    *,
    names: tuple[str, str] = ("1", "2"),
    ax: Axes | None = None,
) -> Axes:
    """The plane of two contact forces, in which their equations are solved.

    It shows the level sets of f'A f/2 + b.f, the quadrant f >= 0, the lines
    d_ddot_i = 0, the way of the sweeps, and the solution.
    """
    forced, f, w = result.forced, result.force, result.acceleration
    reach = 1.25 * max(float(np.abs(forced).max()), float(f.max()))
    low, high = min(-0.25 * reach, 1.25 * float(forced.min())), reach
    with style():
        ax = axes(ax, size=(5.6, 5.6))
        _level_sets(ax, result, (low, high))
        _forbidden(ax, low, high)
        for i, (colour, dashes) in enumerate((("blue", "-"), ("vermillion", "--"))):
            ends = _zero_line(result.matrix[i], result.bias[i], (low, high))
            label = rf"$\ddot d_{i + 1} = 0$"
            line(ax, ends, colour, ls=dashes, lw=1.8, zorder=3, label=label)
        _way_to_the_solution(ax, result)
        if np.abs(w).max() > 1e-9 * np.abs(result.bias).max():
            tip = f + 0.22 * reach * w / np.linalg.norm(w)
            arrow(ax, f, tip, lw=2.0, shrinkA=6, zorder=6)
            look: dict[str, Any] = {"marker": r"$\rightarrow$", "ms": 13, "ls": "none"}
            label = r"slope of q there, $\ddot d$"
            ax.plot([], [], color=PALETTE["black"], label=label, **look)
        ax.axhline(0, color="0.3", lw=1.0, zorder=2)
        ax.axvline(0, color="0.3", lw=1.0, zorder=2)
        ax.set(xlim=(low, high), ylim=(low, high), aspect="equal")
        ax.set(xlabel=f"$f_1$, {names[0]} [N]", ylabel=f"$f_2$, {names[1]} [N]")
        place: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.45, -0.16)}
        ax.legend(ncols=2, fontsize=11, **place)
    describe(ax, _plane_in_words(result))
    return ax


def _level_sets(ax: Axes, result: TwoForces, ends: tuple[float, float]) -> None:
    """Ellipses of f'A f/2 + b.f around its minimum, that of the solution darker."""
    grid = np.linspace(*ends, 160)
    f_1, f_2 = np.meshgrid(grid, grid)
    level = result.distance(np.stack([f_1, f_2], axis=-1))
    ax.contour(f_1, f_2, level, levels=9, colors="0.78", linewidths=0.8)
    touching = float(result.distance(result.force))
    if touching > 1e-6:
        look: dict[str, Any] = {"colors": "0.4", "linewidths": 1.6, "zorder": 3}
        ax.contour(f_1, f_2, level, levels=[touching], **look)


def _forbidden(ax: Axes, low: float, high: float) -> None:
    """Where one of the forces would pull."""
    look: dict[str, Any] = {"fc": "0.85", "ec": "none", "alpha": 0.75, "zorder": 2}
    ax.add_patch(Rectangle((low, low), -low, high - low, **look))
    ax.add_patch(Rectangle((0.0, low), high, -low, **look))


def _way_to_the_solution(ax: Axes, result: TwoForces) -> None:
    black: dict[str, Any] = {"color": PALETTE["black"]}
    sweeps = {"marker": "D", "ms": 6, "mfc": PALETTE["orange"], "lw": 2.4, "ls": "-"}
    label = "three sweeps from 0"
    ax.plot(*result.sweeps.T, label=label, zorder=4, **black | sweeps)
    both = {"ls": "none", "marker": "X", "ms": 9}
    ax.plot(*result.forced, label="both forced to 0", zorder=5, **black | both)
    ring = {"ls": "none", "marker": "o", "ms": 11, "mfc": "none", "mew": 2.4}
    ax.plot(*result.force, label="least with f ≥ 0", zorder=6, **black | ring)


def _zero_line(row: Array, bias: float, ends: tuple[float, float]) -> Array:
    """Where row.f + bias = 0 crosses the picture, (2, 2).

    Solved for the force with the larger coefficient.
    """
    along = np.array(ends)
    if abs(row[1]) > abs(row[0]):
        return np.stack([along, -(bias + row[0] * along) / row[1]], axis=-1)
    return np.stack([-(bias + row[1] * along) / row[0], along], axis=-1)


def _plane_in_words(result: TwoForces) -> str:
    forced, f, w, end = (
        result.forced, result.force, result.acceleration, result.sweeps[-1]
    )  # fmt: skip
    return (
        "The plane of two contact forces in newtons, with ellipses around "
        f"({forced[0]:.0f}, {forced[1]:.0f}), where both d_ddot are 0, and the allowed "
        f"quadrant. The least value in it is at ({f[0] + 0:.0f}, {f[1] + 0:.0f}), "
        f"where d_ddot is ({plain(w[0])}, {plain(w[1])}) m/s². Three sweeps from "
        f"(0, 0), each step along one axis, lead to ({end[0]:.0f}, {end[1]:.0f})."
    )


def plank_and_forces(result: PlankForces, *, ax: Axes | None = None) -> Axes:
    """A plank on two feet with its load, and beside it the plane of the two forces.

    With ``ax`` only the plank is drawn.
    """
    load_at, forces = result.load_at, result.forces
    f, w = forces.force, forces.acceleration
    lifted = [name for name, x in zip(("left", "right"), w, strict=True) if x > 1e-9]
    word = f"the {lifted[0]} foot lifts" if lifted else "both feet stay"
    if ax is None:
        _, (ax, plane) = side_by_side(2, size=(9.6, 5.4))
        force_plane(forces, names=("left foot", "right foot"), ax=plane)
    with style():
        ax.add_patch(Rectangle((-1.5, 0), 3.0, 0.08, fc="0.8", ec="0.3"))
        look: dict[str, Any] = {"fc": PALETTE["orange"], "ec": "0.3", "hatch": "//"}
        ax.add_patch(Rectangle((load_at - 0.15, 0.08), 0.3, 0.3, **look))
        ax.axhline(-0.12, color="0.3", lw=1.0)
        look = {"ls": "none", "marker": "P", "ms": 10, "color": PALETTE["black"]}
        ax.plot([result.centre], [0.04], label="centre of mass", **look)
        colours = ("blue", "vermillion")
        for y, force, colour in zip(result.feet, f, colours, strict=True):
            _foot(ax, y, force, colour)
        ax.set(xlim=(-1.7, 1.7), ylim=(-1.15, 0.75), xlabel="y [m]", yticks=[])
        ax.set_title(f"load at {load_at:+.2f} m: {word}")
        ax.grid(visible=False)
        ax.legend(loc="upper left")
    describe(
        ax,
        f"A plank on feet at -0.5 m and 0.5 m with a load at {load_at:.2f} m: the left "
        f"foot carries {f[0] + 0:.0f} N, the right one {f[1] + 0:.0f} N; {word}.",
    )
    return ax


def _foot(ax: Axes, y: float, force: float, colour: str) -> None:
    """A foot of the plank, and the force on it as an arrow with its number."""
    line(ax, [(y, -0.12), (y, 0)], lw=3)
    below = -0.15 - max(force, 0) / 400
    arrow(ax, (y, below), (y, -0.15), colour, lw=2.4)
    look: dict[str, Any] = {"ha": "center", "va": "top", "color": PALETTE[colour]}
    ax.text(y, below - 0.03, f"{force + 0:.0f} N", **look)
