"""A picture of the normal at a corner, which turns the faster the closer one passes."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from course.study import CornerPassing
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    describe,
    legend_beside,
    style,
)


def passing_a_corner(result: CornerPassing, *, ax: Axes | None = None) -> Axes:
    """A point passes over the corner of a box: the nearest-point normal at equal times.

    Up to three heights are drawn.
    """
    reach = 0.85 * float(result.y[1] - result.y[0])  # not as far as the next place
    with style():
        ax = axes(ax, size=(7.2, 3.4))
        ax.add_patch(Rectangle((-1.0, -0.5), 1.0, 0.5, fc="0.85", ec="0.3"))
        looks = zip(("blue", "vermillion", "green"), ("-", "--", "-."), strict=True)
        for height, normals, (colour, dashes) in zip(
            result.heights, result.normal, looks, strict=False
        ):
            places = np.stack(np.broadcast_arrays(result.y, height), axis=-1)
            look: dict[str, Any] = {"color": PALETTE[colour], "lw": 1.0, "ls": dashes}
            label = f"passes at {height:g} m"
            ax.plot(*places.T, marker="o", ms=4, label=label, **look)
            for place, normal in zip(places, normals, strict=True):
                arrow(ax, place, place + reach * normal, colour, lw=1.3)
        ax.set(xlim=(-0.55, 0.75), ylim=(-0.15, 0.45), aspect="equal")
        ax.set(xlabel="y [m]", ylabel="z [m]")
        legend_beside(ax)
    heights = " and at ".join(f"{h:g} m" for h in result.heights)
    describe(
        ax,
        "A point passes from left to right over the corner of a box, at "
        f"{heights}. Over the box the normal points up. Past the corner it leans to "
        "the right: little by little at the greater height, all at once at the "
        "smaller.",
    )
    return ax
