"""Pictures of the errors of difference quotients: over their step, and by looks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array
from course.study import DifferenceErrors, WorkPrecision
from course.workbook.plots.figure import (
    LINES,
    MARKERS,
    PALETTE,
    axes,
    describe,
    legend_beside,
    style,
)

FOOT = 1e-17  # where an error of exactly 0 is drawn


def difference_errors(
    result: DifferenceErrors,
    *,
    formula: float | None = None,
    expected: Mapping[str, Sequence[float]] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Error of difference quotients over their step: a V for each stencil.

    Both axes are logarithmic; an error of exactly 0 is drawn at 1e-17.

    Args:
        result: of ``study.difference_errors``.
        formula: the error of the closed formula, drawn as a level line.
        expected: name of a stencil -> the curve predicted for it.
    """
    colours = list(PALETTE.values())
    with style():
        ax = axes(ax, size=(7.6, 4.4))
        for i, (name, error) in enumerate(result.error.items()):
            colour = colours[i % 6]
            look: dict[str, Any] = {"marker": MARKERS[i % 6], "color": colour, "ms": 5}
            drawn = np.maximum(error, FOOT)
            ax.loglog(result.step, drawn, ls="none", label=name, **look)
            if expected is not None:
                curve = {"ls": LINES[i % 4], "marker": "", "lw": 1.2, "color": colour}
                label = f"{name}, predicted"
                ax.loglog(result.step, expected[name], label=label, **curve)
        if formula is not None:
            dashes = (0, (5, 1))
            height = max(formula, FOOT)
            ax.axhline(height, color="black", lw=1.6, ls=dashes, label="the formula")
        ax.set(xlabel="step h [s]", ylabel=f"error [{result.unit}]")
        ax.set_title("Errors of difference quotients")
        legend_beside(ax)
    describe(
        ax,
        f"Error of difference quotients ({', '.join(result.error)}) over the step h, "
        "both axes logarithmic. Each is a V: from the right it falls as the step "
        "shrinks; left of its best step it rises again by rounding."
        + (_level_line(formula, result) if formula is not None else ""),
    )
    return ax


def _level_line(formula: float, result: DifferenceErrors) -> str:
    lowest = min(float(np.min(error)) for error in result.error.values())
    where = "below them all" if formula < lowest else "among the lowest of them"
    return f" The error of the formula is a level line {where}."


def errors_by_looks(
    result: WorkPrecision, *, tolerance: float, ax: Axes | None = None
) -> Axes:
    """Errors of ways to get a rate, a column for each way and a mark for each step.

    ``result`` counts how often a way looks at the gap, which does not depend on the
    step.
    """
    names = list(dict.fromkeys(result.method))
    errors, looks = {}, {}
    for name in names:
        own = np.array([method == name for method in result.method])
        times = int(result.cost("count")[own][0])
        errors[name] = result.error[own]
        looks[name] = f"({times} look{'s' * (times > 1)})"
    with style():
        ax = axes(ax)
        for i, (error, colour, mark) in enumerate(
            zip(errors.values(), PALETTE.values(), MARKERS, strict=False)
        ):
            place, height = np.full(error.shape, i), np.maximum(error, FOOT)
            ax.semilogy(place, height, mark, ls="none", ms=7, mfc="none", mew=1.5,
                        color=colour)  # fmt: skip
        ax.axhline(tolerance, color="0.35", lw=1.2, ls=":")
        right = len(names) - 0.55
        ax.text(
            right, tolerance, f"{tolerance:g}", color="0.35", va="bottom", ha="right"
        )
        ax.set_xticks(range(len(names)), [f"{name}\n{looks[name]}" for name in names])
        ax.set(xlim=(-0.5, len(names) - 0.5), ylabel=f"error [{result.problem.unit}]")
        ax.set_title(f"{result.problem.name}, a mark for each step")
        ax.grid(axis="x", visible=False)
    spoken = "; ".join(f"{n} {looks[n]}: {_span(errors[n])}" for n in names)
    describe(
        ax,
        f"{result.problem.name}: error in {result.problem.unit} of each way, a mark "
        f"for each step; a line marks {tolerance:g}. {spoken}.",
    )
    return ax


def _span(error: Array) -> str:
    low, high = float(error.min()), float(error.max())
    return f"{low:.0e}" if len(error) == 1 else f"from {low:.0e} to {high:.0e}"
