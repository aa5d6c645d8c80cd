"""Pictures of contact solvers side by side: what they answer, and what they cost."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from course.arrays import ArrayLike
from course.study import SolverGrowth
from course.workbook.plots.figure import (
    COLOURS,
    HATCHES,
    LINES,
    MARKERS,
    PALETTE,
    axes,
    describe,
    legend_beside,
    side_by_side,
    style,
)


def leg_forces(forces: Mapping[str, ArrayLike], *, ax: Axes | None = None) -> Axes:
    """The forces at each leg side by side, as several solvers answer them.

    ``forces`` are (c,) each, [N].
    """
    values = {name: np.asarray(f, dtype=float) for name, f in forces.items()}
    count = len(next(iter(values.values())))
    with style():
        ax = axes(ax, size=(8.4, 3.4))
        width = 0.8 / len(values)
        for k, ((name, f), colour, hatch) in enumerate(
            zip(values.items(), COLOURS, HATCHES, strict=False)
        ):
            place = np.arange(count) + (k - 0.5 * (len(values) - 1)) * width
            look: dict[str, Any] = {"color": PALETTE[colour], "hatch": hatch}
            ax.bar(place, f, width, ec="white", label=name, **look)
        ax.set_xticks(range(count), [f"leg {i + 1}" for i in range(count)])
        ax.set(ylabel="force [N]")
        ax.grid(axis="x", visible=False)
        legend_beside(ax)
    spoken = "; ".join(
        f"{name}: {', '.join(f'{x:.2f}' for x in f + 0.0)}"
        for name, f in values.items()
    )
    told = f"Forces at {count} legs in newtons, one bar a solver and leg"
    describe(ax, f"{told}. {spoken}.")
    return ax


def solver_growth(result: SolverGrowth, *, ax: Axes | None = None) -> Axes:
    """Time and counted steps of contact solvers over the number of contacts.

    Both axes are logarithmic. With ``ax`` only the time is drawn.
    """
    panels: list[tuple[Axes, Any, str]] = []
    if ax is None:
        _, (ax, right) = side_by_side(2, size=(9.6, 4.2))
        panels.append((right, result.steps, "sweeps, pivots or Newton systems"))
    panels.insert(0, (ax, result.seconds, "time [s]"))
    with style():
        for panel, rows, label in panels:
            for k, name in enumerate(result.method):
                look: dict[str, Any] = {"marker": MARKERS[k], "ls": LINES[k % 4]}
                look["color"] = PALETTE[COLOURS[k]]
                panel.loglog(result.contacts, rows[k], label=name, **look)
            panel.set(xlabel="contacts", ylabel=label)
        panels[-1][0].legend(loc="upper left", ncols=1, labelspacing=0.3)
        low, high = panels[-1][0].get_ylim()
        panels[-1][0].set_ylim(low, high * (high / low) ** 0.75)  # room for the legend
    told = [_cost_told(result, k) for k in range(len(result.method))]
    describe(
        ax,
        f"Time and counted steps over {result.contacts[0]:.0f} to "
        f"{result.contacts[-1]:.0f} contacts, both axes logarithmic. {' '.join(told)}",
    )
    return ax


def _cost_told(result: SolverGrowth, k: int) -> str:
    """What a method costs for the fewest and the most contacts that it was asked."""
    first, last = np.flatnonzero(np.isfinite(result.seconds[k]))[[0, -1]]
    each = [
        f"{result.steps[k, i]:.0f} steps and {result.seconds[k, i]:.2g} s at "
        f"{result.contacts[i]:.0f}"
        for i in dict.fromkeys((first, last))
    ]
    return f"{result.method[k]}: {', '.join(each)}."
