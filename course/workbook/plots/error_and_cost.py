"""The chart of error against cost that every lesson draws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from course.arrays import Array, BoolArray
from course.study import Cost, WorkPrecision
from course.workbook.plots.decades import label_decades
from course.workbook.plots.figure import (
    LINES,
    MARKERS,
    PALETTE,
    axes,
    describe,
    legend_beside,
    style,
)

# In points: the ring fits inside the star's inner corners (0.38 of its size), and both
# shrink in the legend to what its lines are apart.
RING, STAR, IN_LEGEND = 10, 34, 12


def work_precision(
    result: WorkPrecision,
    *,
    by: Cost = "seconds",
    tolerance: float | None = None,
    exact: str = "exact to rounding",
    beside: Mapping[str, Sequence[float]] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Error against cost, both logarithmic, a curve for each method, the front ringed.

    With ``tolerance`` the cheapest run within it is marked and named. An error of
    exactly 0 has no logarithm: it is drawn at the foot of the chart and labelled
    ``exact``. ``beside`` names the knobs that are written at their markers, by method.
    """
    floor, picked = _floor(result.error), ""
    with style():
        ax = axes(ax)
        _curves(ax, result, by, floor)
        if (result.error < floor).any():
            _exact_level(ax, result.cost(by), result.error < floor, floor, exact)
        if tolerance is not None:
            picked = _mark_pick(ax, result, by, tolerance, floor)
        for name, knobs in (beside or {}).items():
            _knobs_beside(ax, result, by, name, knobs, floor)
        unit = f" [{result.problem.unit}]" if result.problem.unit else ""
        ax.set_xlabel("time [s]" if by == "seconds" else f"work [{result.count_unit}]")
        ax.set_ylabel(f"error{unit}")
        ax.set_title(result.problem.name)
        ax.margins(0.1)  # room for a star at the edge
        for axis in (ax.xaxis, ax.yaxis):
            label_decades(axis)
        legend = legend_beside(ax, labelspacing=0.7, handlelength=3)
        for handle in legend.legend_handles:
            if isinstance(handle, Line2D):
                handle.set_markersize(min(handle.get_markersize(), IN_LEGEND))
    cost = "time" if by == "seconds" else "counted work"
    methods = ", ".join(dict.fromkeys(result.method))
    describe(
        ax,
        f"{result.problem.name}: error against {cost} for {methods}; smaller and "
        f"cheaper is toward the lower left.{picked}",
    )
    return ax


def _curves(ax: Axes, result: WorkPrecision, by: Cost, floor: float) -> None:
    """The runs of each method by their cost, and rings around those on the front."""
    cost, error = result.cost(by), np.maximum(result.error, floor)
    for i, name in enumerate(dict.fromkeys(result.method)):
        own = np.array([m == name for m in result.method])
        order = np.argsort(cost[own])
        x, y = cost[own][order], error[own][order]
        ax.loglog(x, y, marker=MARKERS[i % 8], ls=LINES[i % 4], label=name)
    front = result.front(by)
    ax.loglog(cost[front], error[front], "o", ms=RING, mfc="none", mec="0.25", mew=1,
              ls="none", label="on the front")  # fmt: skip


def _knobs_beside(
    ax: Axes, result: WorkPrecision, by: Cost, name: str, knobs: Sequence[float], floor: float
) -> None:  # fmt: skip
    cost = result.cost(by)
    for i, (method, knob) in enumerate(zip(result.method, result.knob, strict=True)):
        if method == name and knob in knobs:
            at = cost[i], max(result.error[i], floor)
            ax.annotate(f"{knob:g}", at, (8, 7), textcoords="offset points",
                        weight="bold")  # fmt: skip


def _exact_level(
    ax: Axes, cost: Array, exact: BoolArray, floor: float, words: str
) -> None:
    """The level at which exact runs are drawn; its words at the end that is free of them, or between two."""
    ax.axhline(floor, color="0.6", lw=0.8, ls=":")
    left, right = np.log(cost.min()), np.log(cost.max())
    runs = np.sort(np.log(cost[exact]))
    ends = {"left": runs[0] - left, "right": right - runs[-1]}
    side = max(ends, key=lambda name: ends[name])
    at = left if side == "left" else right
    between = np.diff(runs)
    if between.size and ends[side] < 0.25 * between.max():
        widest = int(np.argmax(between))
        at, side = runs[widest : widest + 2].mean(), "center"
    ax.text(float(np.exp(at)), floor, words, va="bottom", ha=side, fontsize=8.5, color="0.35")  # fmt: skip


def _floor(error: Array) -> float:
    positive = error[error > 0]
    return (
        float(max(1e-16, positive.min() / 10))
        if (error <= 0).any() and positive.size
        else 1e-17
    )


def _mark_pick(
    ax: Axes, result: WorkPrecision, by: Cost, tolerance: float, floor: float
) -> str:
    ax.axhline(tolerance, color=PALETTE["blue"], lw=1, ls=":")
    index = result.pick(tolerance, by)
    if index is None:
        ax.text(0.99, tolerance, " none within this tolerance ", ha="right",
                transform=ax.get_yaxis_transform())  # fmt: skip
        return " No method is within the tolerance."
    cost, error = result.cost(by)[index], max(result.error[index], floor)
    ax.plot(cost, error, marker="*", ms=STAR, mfc="none", mec=PALETTE["blue"], mew=1.4,
            ls="none", label=f"pick for error ≤ {tolerance:g}")  # fmt: skip
    cheapest = result.method[index]
    return f" For an error of at most {tolerance:g} the cheapest is {cheapest}."
