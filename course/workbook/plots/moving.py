"""Pictures of lesson 06: two moving spheres as a point and one sphere."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    describe,
    legend_beside,
    line,
    style,
)


def point_and_sphere(
    offset: ArrayLike, velocity: ArrayLike, reach: float, *, ax: Axes | None = None
) -> Axes:
    """A point that flies at a sphere about 0, where it enters and leaves, and how near it comes.

    Args:
        offset: m, from B to A, (2,) [m].
        velocity: v, of A as seen from B, (2,) [m/s].
        reach: r, both radii together [m].
    """
    m, v = np.asarray(offset, dtype=float), np.asarray(velocity, dtype=float)
    a, b, c = v @ v, m @ v, m @ m - reach**2
    roots = (-b + np.array([-1.0, 1.0]) * np.sqrt(max(b * b - a * c, 0.0))) / a
    nearest = m - b / a * v
    end = m + (roots[1] + 0.6) * v
    with style():
        ax = axes(ax, size=(6.8, 2.9))
        around = _circle(reach)
        ax.fill(*around.T, facecolor=PALETTE["orange"], alpha=0.2)
        line(ax, around, "orange", lw=2.0, label="r = r_A + r_B about B")
        line(ax, [m, end], "blue", ls="--", label="m + v t")
        arrow(ax, m, m + 0.35 * v, "blue", label="v", beyond=0.25)
        line(ax, [[0, 0], nearest], "0.4", ls=":", label=f"nearest, q = {np.linalg.norm(nearest):.2g} m")  # fmt: skip
        for t, marker, word in zip(roots, "os", ("touch", "part"), strict=True):
            there = m + t * v
            ax.plot(*there, marker, color=PALETTE["vermillion"], ms=8, ls="none",
                    label=f"they {word}, t = {t:.3g} s")  # fmt: skip
        ax.plot(*m, "o", color=PALETTE["blue"], ms=7, ls="none", label="A at t = 0")
        ax.plot(0, 0, "k+", ms=12, mew=2, ls="none", label="B")
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="As seen from B")
        ax.margins(0.06)
        legend_beside(ax)
    describe(
        ax,
        f"A sphere of radius {reach:g} m about B, and the straight way of a point that starts at "
        f"({m[0]:g}, {m[1]:g}) m with velocity ({v[0]:g}, {v[1]:g}) m/s. It enters the sphere at "
        f"{roots[0]:.3g} s, is nearest to B at {np.linalg.norm(nearest):.2g} m, and leaves it at {roots[1]:.3g} s.",
    )
    return ax


def _circle(radius: float) -> Array:
    angle = np.linspace(0.0, 2 * np.pi, 121)
    return np.asarray(radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
