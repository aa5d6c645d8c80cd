"""Charts every lesson draws: error against cost, and a sweep past a predicted threshold."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from course.study.work_precision import Cost, WorkPrecision
from course.workbook.plots.figure import PALETTE, axes, describe, style

MARKERS = "os^DvPX*"
LINES = ("-", "--", "-.", ":")


def work_precision(
    result: WorkPrecision, *, by: Cost = "seconds", tolerance: float | None = None, ax: Axes | None = None
) -> Axes:
    """Error against cost, both logarithmic, the whole curve of each method, the front ringed.

    With ``tolerance`` the cheapest run within it is marked and named. An error of exactly 0 has no logarithm: it is
    drawn at the foot of the chart and labelled so.
    """
    with style():
        ax = axes(ax)
        cost, names = result.cost(by), list(dict.fromkeys(result.method))
        floor = _floor(result.error)
        error = np.maximum(result.error, floor)
        for i, name in enumerate(names):
            own = np.array([m == name for m in result.method])
            order = np.argsort(cost[own])
            ax.loglog(cost[own][order], error[own][order], marker=MARKERS[i % 8], ls=LINES[i % 4], label=name)
        front = result.front(by)
        ax.loglog(cost[front], error[front], "o", ms=13, mfc="none", mec="0.25", mew=1, ls="none", label="on the front")
        if (result.error < floor).any():
            ax.axhline(floor, color="0.6", lw=0.8, ls=":")
            ax.text(cost.max(), floor, "exact to rounding", va="bottom", ha="right", fontsize=8.5, color="0.35")
        picked = _mark_pick(ax, result, by, tolerance, floor) if tolerance is not None else ""
        unit = f" [{result.problem.unit}]" if result.problem.unit else ""
        ax.set_xlabel("time [s]" if by == "seconds" else f"work [{result.count_unit}]")
        ax.set_ylabel(f"error{unit}")
        ax.set_title(result.problem.name)
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), labelspacing=1.1)  # room for the ring and the star
    describe(
        ax,
        f"{result.problem.name}: error against {'time' if by == 'seconds' else 'counted work'} for "
        f"{', '.join(names)}; smaller and cheaper is toward the lower left.{picked}",
    )
    return ax


def stability_sweep(
    knob: Sequence[float],
    measured: Sequence[float],
    *,
    predicted: Sequence[float] | None = None,
    threshold: float | None = None,
    cure: Sequence[float] | None = None,
    also: Sequence[float] | None = None,
    labels: tuple[str, str, str] = ("knob", "measured", ""),
    names: tuple[str, str, str] = ("measured", "predicted", "with the cure"),
    log: str = "",
    ax: Axes | None = None,
) -> Axes:
    """A quantity over a knob, past the threshold the theory predicts, with the theory and the cure beside it.

    ``also`` is another measurement to compare with, named in place of the cure. ``labels`` are the x label,
    the y label (with units) and the title; ``log`` holds the axes that are logarithmic.
    """
    with style():
        ax = axes(ax)
        ax.plot(knob, measured, ls="none", marker="o", color=PALETTE["vermillion"], label=names[0])
        if predicted is not None:
            ax.plot(knob, predicted, ls="-", marker="", color="0.3", lw=1.4, label=names[1])
        if cure is not None:
            ax.plot(knob, cure, ls="--", marker="^", ms=4, color=PALETTE["green"], label=names[2])
        if also is not None:
            ax.plot(knob, also, ls=":", marker="x", ms=5, color=PALETTE["purple"], label=names[2])
        if threshold is not None:
            ax.axvline(threshold, color=PALETTE["blue"], ls=":", label=f"predicted threshold {threshold:.4g}")
        if "x" in log:
            ax.set_xscale("log")
        if "y" in log:
            ax.set_yscale("log")
        ax.set(xlabel=labels[0], ylabel=labels[1], title=labels[2])
        ax.legend()
    end = f" The predicted threshold is {threshold:.4g}." if threshold is not None else ""
    describe(ax, f"{labels[2] or labels[1]}: {labels[1]} over {labels[0]}.{end}")
    return ax


def _floor(error: np.ndarray) -> float:
    positive = error[error > 0]
    return float(max(1e-16, positive.min() / 10)) if (error <= 0).any() and positive.size else 1e-17


def _mark_pick(ax: Axes, result: WorkPrecision, by: Cost, tolerance: float, floor: float) -> str:
    ax.axhline(tolerance, color=PALETTE["blue"], lw=1, ls=":")
    index = result.pick(tolerance, by)
    if index is None:
        ax.text(0.99, tolerance, " none within this tolerance ", transform=ax.get_yaxis_transform(), ha="right")
        return " No method is within the tolerance."
    cost, error = result.cost(by)[index], max(result.error[index], floor)
    label = f"pick for error ≤ {tolerance:g}"
    ax.plot(cost, error, marker="*", ms=26, mfc="none", mec=PALETTE["blue"], mew=1.4, ls="none", label=label)
    return f" For an error of at most {tolerance:g} the cheapest is {result.method[index]}."
