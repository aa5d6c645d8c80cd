"""Pictures of lesson 05: two polygons and all their differences, and a square in a notch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.study import DifferenceBody
from course.workbook.plots.figure import (
    PALETTE,
    axes,
    describe,
    legend_beside,
    line,
    side_by_side,
    style,
)

COLORS = {"A": "blue", "B": "orange"}
LOOKS = {"A": "-", "B": "--"}


def difference_body(found: DifferenceBody) -> tuple[Axes, Axes]:
    """Two polygons, and beside them the polygon of all differences a - b, with 0 marked."""
    figure, (left, right) = side_by_side(2, size=(9.0, 5.3))
    both, extra = np.concatenate([found.a, found.b]), np.zeros((1, 2))
    with style():
        for name, polygon in (("A", found.a), ("B", found.b)):
            _outline(left, polygon, name)
        _edges_of_differences(right, found)
        if found.distance > 0:
            extra = np.append(extra, _longer(found), axis=0)
            line(right, _longer(found), "0.4", ls=":", label="0 is beyond this edge")
        right.plot(0, 0, "k+", ms=14, mew=2, ls="none", label="0")
        left.set(title="A and B", xlabel="x [m]", ylabel="y [m]", aspect="equal")
        right.set(
            title="all differences a - b",
            xlabel="x [m]",
            ylabel="y [m]",
            aspect="equal",
        )
        _one_scale((left, right), (both, np.concatenate([found.corners, extra])))
        figure.legend(loc="outside lower center", ncols=4)
    where = (
        "outside, so A and B are apart"
        if found.distance > 0
        else "inside, so A and B overlap"
    )
    count = len(found.owner)
    describe(
        right,
        f"Left: polygon A with {len(found.a)} corners and polygon B with {len(found.b)}. Right: the polygon of all "
        f"differences a - b. It has {count} edges, {found.owner.count('A')} of them edges of A and "
        f"{found.owner.count('B')} edges of B; the point 0 is {where}.",
    )
    return left, right


def _one_scale(several: Sequence[Axes], shown: Sequence[Array]) -> None:
    """Windows of one size, each about the middle of its points: an edge has one length in all."""
    middles = [(p.min(axis=0) + p.max(axis=0)) / 2 for p in shown]
    half = 0.56 * max(np.ptp(p, axis=0).max() for p in shown)
    for ax, (x, y) in zip(several, middles, strict=True):
        ax.set(xlim=(x - half, x + half), ylim=(y - half, y + half))


def _edges_of_differences(ax: Axes, found: DifferenceBody) -> None:
    """Each edge as the polygon's that it comes from."""
    for k, owner in enumerate(found.owner):
        ends = found.corners[[k, (k + 1) % len(found.corners)]]
        label = f"edge of {owner}" + (", turned round" if owner == "B" else "")
        first = found.owner.index(owner) == k
        line(ax, ends, COLORS[owner], ls=LOOKS[owner], lw=2.4, label=label if first else None)  # fmt: skip


def _longer(found: DifferenceBody) -> Array:
    """The edge that 0 is beyond, longer at both ends, (2, 2)."""
    start, end = found.beyond
    return np.stack([start - 0.4 * (end - start), end + 0.4 * (end - start)])


def _outline(
    ax: Axes, polygon: ArrayLike, name: str, at: tuple[float, float] | None = None
) -> None:
    """A filled polygon, its name in the middle of its corners or at a place inside."""
    corners = np.asarray(polygon)
    ax.fill(*corners.T, facecolor=PALETTE[COLORS[name]], alpha=0.25)
    line(
        ax, np.concatenate([corners, corners[:1]]), COLORS[name], ls=LOOKS[name], lw=2.4
    )
    x, y = corners.mean(axis=0) if at is None else at
    ax.text(x, y, name, ha="center", va="center", weight="bold")


def notch(outline: ArrayLike, square: ArrayLike, *, ax: Axes | None = None) -> Axes:
    """An L, its convex hull, the parts of which it can be made, and a square in its notch."""
    with style():
        ax = axes(ax, size=(6.4, 4.0))
        _outline(ax, outline, "A", (0.5, 0.5))
        x, y = np.asarray(square).mean(axis=0) + 0.25
        _outline(ax, square, "B", (x, y))
        line(ax, [[3, 1], [1, 3]], "0.4", ls="-.", label="side of its convex hull")
        line(ax, [[0, 1], [1, 1]], "0.4", ls=":", label="cut in two convex parts")
        ax.set(
            title="A square in the notch of an L",
            xlabel="x [m]",
            ylabel="y [m]",
            aspect="equal",
        )
        ax.margins(0.12)
        legend_beside(ax)
    describe(
        ax,
        "An L, 3 m long and 3 m high with arms 1 m wide, and a square with sides of 1 m in its notch, "
        "touching neither arm; one corner of it lies beyond the slanted side of the L's convex hull, toward the L. "
        "A dotted line cuts the L in two rectangles.",
    )
    return ax
