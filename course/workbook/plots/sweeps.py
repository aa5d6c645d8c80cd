"""The chart of a sweep: a quantity over a knob, past a threshold that was predicted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from course.workbook.numbers import show
from course.workbook.plots.decades import label_decades
from course.workbook.plots.figure import PALETTE, axes, describe, style

SWEEP_LOOKS: dict[str, dict[str, Any]] = {
    "measured": {"ls": "none", "marker": "o", "color": PALETTE["vermillion"]},
    "predicted": {"ls": "-", "marker": "", "color": "0.3", "lw": 1.4},
    "cure": {"ls": "--", "marker": "^", "ms": 4, "color": PALETTE["green"]},
    "also": {"ls": ":", "marker": "x", "ms": 5, "color": PALETTE["purple"]},
}


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
    """A quantity over a knob, past the threshold that theory predicts.

    Args:
        knob: where it was measured.
        measured, predicted, cure: what is drawn over the knob.
        threshold: where the knob is expected to matter.
        also: another measurement to compare with, named in place of the cure.
        labels: the x label, the y label (with units) and the title.
        names: of what was measured, what was predicted, and the cure.
        log: the axes that are logarithmic, "x", "y" or "xy".
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
            rounded = float(f"{threshold:.4g}")
            written = f"{rounded:,.0f}" if 1e4 <= rounded < 1e7 else f"{rounded:.4g}"
            said = f"predicted threshold {written}"
            ax.axvline(threshold, color=PALETTE["blue"], ls=":", label=said)
        for name in log:
            ax.set(**{f"{name}scale": "log"})
            label_decades(ax.xaxis if name == "x" else ax.yaxis)
        ax.set(xlabel=labels[0], ylabel=labels[1], title=labels[2])
        ax.legend()
    drawn = [(named[what], y) for what, y in series.items()]
    told = _sweep_in_words(np.asarray(knob, dtype=float), drawn, threshold)
    describe(ax, f"{labels[2] or labels[1]}: {labels[1]} over {labels[0]}.{told}")
    return ax


def _sweep_in_words(
    knob: np.ndarray, series: Sequence[tuple[str, np.ndarray]], threshold: float | None
) -> str:
    """A sweep at its ends, beside the threshold and at its extremes.

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
    """The last place below the threshold and the first above it, and that in words.

    A place that lies on it is neither.
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
    """The places, and those of the least and the largest value where these are news.

    That is: where they lie clearly outside what the places already say.
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
