"""Pictures of lesson 02: a turned rod in its box, and every kind of collider around one shape."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.study.collider_outlines import Outlined
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    bare,
    describe,
    line,
    style,
)


def turned_box(half_extents: ArrayLike, degrees: float, *, ax: Axes | None = None) -> Axes:  # fmt: skip
    """A turned rectangle in the box along the axes, its corners with their places along x.

    Args:
        half_extents: e_1 and e_2, (2,) [m].
        degrees: by which it is turned.
    """
    e = np.asarray(half_extents, dtype=float)
    signs = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    corners = signs * e @ [[c, s], [-s, c]]
    reach = np.abs(corners).max(axis=0)
    with style():
        ax = axes(ax, size=(5.6, 4.6))
        ax.fill(*corners.T, facecolor=PALETTE["blue"], alpha=0.25)
        line(ax, np.concatenate([corners, corners[:1]]), "blue", lw=2.2)
        box = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]]) * reach
        line(ax, box, "vermillion", ls="--", lw=1.8, label="box along the axes")
        for (x, y), sign in zip(corners, signs, strict=True):
            ax.plot(x, y, "o", color=PALETTE["blue"], ms=5)
            aside = np.isclose(abs(x), reach[0])  # outside of the box, off its sides
            ha = ("left" if x > 0 else "right") if aside else "center"
            va = "center" if aside else "bottom" if y > 0 else "top"
            off = (7 * np.sign(x), 0) if aside else (0, 5 * np.sign(y))
            said = _corner_said(e, sign, x, y)
            ax.annotate(said, (x, y), off, textcoords="offset points", ha=ha, va=va)  # fmt: skip
        for axis, name in (([c, s], "$r_1$"), ([-s, c], "$r_2$")):
            arrow(ax, (0, 0), axis, "black", label=name, beyond=0.35)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.set_xlim(-1.9 * reach[0], 1.9 * reach[0])
        ax.margins(y=0.2)
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 1.15))
    places = ", ".join(f"{x:.1f}" for x in corners[:, 0])
    high, right = corners[0, 1], corners[3, 0]
    describe(
        ax,
        f"A rectangle of {2 * e[0]:g} m by {2 * e[1]:g} m, turned by {degrees:.1f} degrees about its middle, in the "
        f"box along x and y around it. Its corners lie at x = {places} m, each on a side of the box. "
        f"Highest lies {_combined(e, signs[0])}, at y = {high:.1f} m, "
        f"and farthest right {_combined(e, signs[3])}, at x = {right:.1f} m.",
    )
    return ax


def _combined(e: Array, sign: Array) -> str:
    """A corner as the sum that it is, "3 r_1 - 2 r_2"."""
    return f"{e[0]:g} r_1 {'+' if sign[1] > 0 else '-'} {e[1]:g} r_2"


def _corner_said(e: Array, sign: Array, x: float, y: float) -> str:
    """A corner's place along x; of the two with plus r_1 also which corner it is, and how high the first is."""
    if sign[0] < 0:
        return f"x = {x:.1f}".replace("-", "\N{MINUS SIGN}")  # as along the axis
    name = f"${_combined(e, sign)}$"
    return f"{name}\nx = {x:.1f}" + (f", y = {y:.1f}" if sign[1] > 0 else "")


def collider_kinds(kinds: Sequence[Outlined], parts: Sequence[Array]) -> list[Axes]:
    """Every kind of collider around one shape, each with its volume and how many numbers it is.

    Args:
        kinds: the colliders.
        parts: outlines of the shape's parts, (k, 2) [m] each.
    """
    with style():
        _, several = plt.subplots(2, 4, figsize=(10.4, 5.4), sharex=True, sharey=True)
        for ax, kind in zip(several.flat, kinds, strict=True):
            for part in parts:
                ax.fill(*part.T, facecolor=PALETTE["blue"], alpha=0.45, lw=0)
            if np.isinf(kind.ratio):
                _half_space(ax, kind.outlines[0])
            else:
                for around in kind.outlines:
                    line(ax, np.concatenate([around, around[:1]]), "vermillion", lw=2)
            ax.set(aspect="equal", xlim=(-0.27, 0.27), ylim=(-0.27, 0.27))
            ax.set_title(f"{kind.name}\n{_said(kind)}", fontsize=10.5, loc="center")
            bare(ax)
    told = "; ".join(f"{k.name}: {_said(k)}" for k in kinds)
    describe(
        several.flat[0],
        f"A dumbbell, turned by 30 degrees, in eight kinds of collider. {told}.",
    )
    return list(several.flat)


def _said(kind: Outlined) -> str:
    size = "no end" if np.isinf(kind.ratio) else f"{kind.ratio:.2f} ×"
    return f"{size}, {kind.numbers:,} numbers"


def _half_space(ax: Axes, edge: Array) -> None:
    """The edge of a half space, with what lies below it hatched."""
    ax.fill_between(
        edge[:, 0], edge[:, 1], -1.0, facecolor="none", hatch="//", edgecolor="0.6", lw=0
    )  # fmt: skip
    line(ax, edge, "vermillion", lw=2)
