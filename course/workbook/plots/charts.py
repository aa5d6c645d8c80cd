"""Charts every lesson draws: error against cost, and a sweep past a predicted
threshold.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import ticker
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.lines import Line2D

from course.study import Cost, WorkPrecision
from course.workbook.numbers import show
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
SWEEP_LOOKS: dict[str, dict[str, Any]] = {
    "measured": {"ls": "none", "marker": "o", "color": PALETTE["vermillion"]},
    "predicted": {"ls": "-", "marker": "", "color": "0.3", "lw": 1.4},
    "cure": {"ls": "--", "marker": "^", "ms": 4, "color": PALETTE["green"]},
    "also": {"ls": ":", "marker": "x", "ms": 5, "color": PALETTE["purple"]},
}


def work_precision(
    result: WorkPrecision,
    *,
    by: Cost = "seconds",
    tolerance: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Error against cost, both logarithmic, the whole curve of each method, the front
    ringed.

    With ``tolerance`` the cheapest run within it is marked and named. An error of
    exactly 0 has no logarithm: it is drawn at the foot of the chart and labelled so.
    """
    with style():
        ax = axes(ax)
        cost, names = result.cost(by), list(dict.fromkeys(result.method))
        floor = _floor(result.error)
        error = np.maximum(result.error, floor)
        for i, name in enumerate(names):
            own = np.array([m == name for m in result.method])
            order = np.argsort(cost[own])
            ax.loglog(
                cost[own][order],
                error[own][order],
                marker=MARKERS[i % 8],
                ls=LINES[i % 4],
                label=name,
            )
        front = result.front(by)
        ax.loglog(
            cost[front],
            error[front],
            "o",
            ms=RING,
            mfc="none",
            mec="0.25",
            mew=1,
            ls="none",
            label="on the front",
        )
        if (result.error < floor).any():
            ax.axhline(floor, color="0.6", lw=0.8, ls=":")
            ax.text(
                cost.max(),
                floor,
                "exact to rounding",
                va="bottom",
                ha="right",
                fontsize=8.5,
                color="0.35",
            )
        picked = (
            _mark_pick(ax, result, by, tolerance, floor)
            if tolerance is not None
            else ""
        )
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
    """A quantity over a knob, past the threshold the theory predicts, with the theory
    and the cure beside it.

    ``also`` is another measurement to compare with, named in place of the cure.
    ``labels`` are the x label, the y label (with units) and the title; ``log`` holds
    the axes that are logarithmic.
    """
    given = {"measured": measured, "predicted": predicted, "cure": cure, "also": also}
    named = dict(zip(given, (*names, names[2]), strict=True))
    series = {
        what: np.asarray(values, dtype=float)
        for what, values in given.items()
        if values is not None
    }
    with style():
        ax = axes(ax)
        for what, values in series.items():
            ax.plot(knob, values, label=named[what], **SWEEP_LOOKS[what])
        if threshold is not None:
            ax.axvline(
                threshold,
                color=PALETTE["blue"],
                ls=":",
                label=f"predicted threshold {threshold:.4g}",
            )
        for name in log:
            ax.set(**{f"{name}scale": "log"})
            label_decades(ax.xaxis if name == "x" else ax.yaxis)
        ax.set(xlabel=labels[0], ylabel=labels[1], title=labels[2])
        ax.legend()
    told = _sweep_in_words(
        np.asarray(knob, dtype=float),
        [(named[what], y) for what, y in series.items()],
        threshold,
    )
    describe(ax, f"{labels[2] or labels[1]}: {labels[1]} over {labels[0]}.{told}")
    return ax


def label_decades(axis: Axis) -> None:
    """Label the powers of ten of a logarithmic axis, and 2 and 5 where it has only one.

    Left alone, matplotlib labels 2, 3, 4 and 6 of an axis under two decades, one over
    the other. An axis with not even two of 1, 2 and 5 gets a few evenly spaced labels.
    """
    low, high = np.log10(axis.get_view_interval())
    ticks: ticker.Locator = ticker.LogLocator()
    if np.floor(high) - np.ceil(low) < 1:
        marks = np.log10([1, 2, 5]) + np.arange(np.floor(low), high + 1)[:, None]
        several = np.sum((low <= marks) & (marks <= high)) > 1
        ticks = ticker.LogLocator(subs=(1, 2, 5)) if several else ticker.MaxNLocator(3)
    axis.set_major_locator(ticks)
    axis.set_major_formatter(
        ticker.LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf))
    )
    axis.set_minor_formatter(ticker.NullFormatter())


def _sweep_in_words(
    knob: np.ndarray, series: Sequence[tuple[str, np.ndarray]], threshold: float | None
) -> str:
    """The threshold between its neighbours, and each series at both ends, beside the
    threshold and at its extremes.

    The first series chooses the places; one that reads the same there is not read out
    twice.
    """
    order = np.argsort(knob)
    x, ordered = knob[order], [(name, y[order]) for name, y in series]
    beside, text = (
        _beside(x, threshold) if threshold is not None else ([len(x) // 2], "")
    )
    places = _with_extremes(ordered[0][1], sorted({0, *beside, len(x) - 1}))
    known: dict[str, str] = {}
    for name, y in ordered:
        values = [_value(y[i]) for i in places]
        read = ", ".join(
            f"{value} at {_knob(x[i])}" for value, i in zip(values, places, strict=True)
        )
        if known and len(set(values)) == 1:
            read = f"{values[0]} at each of these"
        text += (
            f" {name}: {f'the same there as {known[read]}' if read in known else read}."
        )
        known.setdefault(read, name)
    return text


def _beside(x: np.ndarray, threshold: float) -> tuple[list[int], str]:
    """The last place below the threshold and the first above it (one that lies on it is
    neither), and that in words.
    """
    near = 1e-9 * (abs(threshold) or float(np.ptp(x)))
    below, above = (
        np.flatnonzero(x < threshold - near)[-1:],
        np.flatnonzero(x > threshold + near)[:1],
    )
    if below.size and above.size:
        where = f", between {_knob(x[below[0]])} and {_knob(x[above[0]])}"
    else:
        where = ", past the last point" if below.size else ", before the first point"
    return [
        int(i) for i in (*below, *above)
    ], f" The predicted threshold is {threshold:.4g}{where}."


def _with_extremes(y: np.ndarray, places: list[int]) -> list[int]:
    """The places, and those of the least and the largest value where they lie clearly
    outside what has been said already.
    """
    finite = np.flatnonzero(np.isfinite(y))
    told = y[[i for i in places if np.isfinite(y[i])]]
    if not told.size:
        return sorted({*places, *finite[:1].tolist(), *finite[-1:].tolist()})
    clearly = 0.05 * float(np.ptp(told))
    least, most = (int(finite[i]) for i in (y[finite].argmin(), y[finite].argmax()))
    more = {
        i
        for i, out in ((least, told.min() - y[least]), (most, y[most] - told.max()))
        if out > clearly
    }
    return sorted({*places, *more})


def _value(y: float) -> str:
    return str(show(float(y), 3)) if np.isfinite(y) else "no value"


def _knob(x: float) -> str:
    return "0" if x == 0 else str(show(float(x), 4))


def _floor(error: np.ndarray) -> float:
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
        ax.text(
            0.99,
            tolerance,
            " none within this tolerance ",
            transform=ax.get_yaxis_transform(),
            ha="right",
        )
        return " No method is within the tolerance."
    cost, error = result.cost(by)[index], max(result.error[index], floor)
    label = f"pick for error ≤ {tolerance:g}"
    ax.plot(
        cost,
        error,
        marker="*",
        ms=STAR,
        mfc="none",
        mec=PALETTE["blue"],
        mew=1.4,
        ls="none",
        label=label,
    )
    return f" For an error of at most {tolerance:g} the cheapest is {result.method[index]}."
