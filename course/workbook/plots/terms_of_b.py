"""A picture of the terms of b: what each adds to the acceleration of a gap."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.workbook.plots.figure import (
    PALETTE,
    axes,
    describe,
    legend_beside,
    style,
)

#: The terms of b that a contact of a face can have where the bodies touch.
TERMS = {
    "force": "force",
    "torque": "torque",
    "gyroscopic": "L x omega",
    "centripetal": "centripetal",
    "normal": "turning normal",
}


def bias_terms(
    terms: Mapping[str, ArrayLike],
    labels: Sequence[str],
    *,
    unit: str = "m/s²",
    ax: Axes | None = None,
) -> Axes:
    """The terms of b of up to four contacts side by side, and their sum.

    Args:
        terms: of ``course.contact.separation_acceleration_terms``, (c,) each.
        labels: of the contacts.
        unit: of the terms.
    """
    values = {
        word: np.asarray(terms[name], dtype=float) for name, word in TERMS.items()
    }
    total = np.sum([np.asarray(v, dtype=float) for v in terms.values()], axis=0)
    with style():
        ax = axes(ax, size=(8.4, 5.4))
        _bars(ax, labels, np.stack([*values.values(), total]))
        ax.axvline(0, color="0.3", lw=0.8)
        ax.margins(x=0.1)  # room for the numbers at the bars
        ax.set_yticks(np.arange(len(values) + 1), [*values, "sum: b"])
        ax.invert_yaxis()  # the sum below its terms
        ax.set(xlabel=unit)
        ax.grid(axis="y", visible=False)
        legend_beside(ax)
    spoken = []
    for row, name in enumerate(labels):
        parts = ", ".join(f"{word} {v[row] + 0.0:.2f}" for word, v in values.items())
        spoken.append(f"{name}: {parts}, in all {total[row] + 0.0:.2f}")
    describe(ax, f"The terms of b in {unit}. {'; '.join(spoken)}.")
    return ax


def _bars(ax: Axes, labels: Sequence[str], values: Array) -> None:
    """A group for each row of the values, a bar in it for each contact."""
    places, width = np.arange(len(values)), 0.84 / len(labels)
    looks = zip(("blue", "vermillion", "green", "purple"), ("", "//", "..", "xx"),
                strict=True)  # fmt: skip
    for row, (name, (colour, hatch)) in enumerate(zip(labels, looks, strict=False)):
        lengths = values[:, row]
        shift = (row - 0.5 * (len(labels) - 1)) * width
        look: dict[str, Any] = {"color": PALETTE[colour], "hatch": hatch, "ec": "white"}
        bars = ax.barh(places + shift, lengths, width, label=name, **look)
        numbers = [f"{length + 0.0:.2f}" for length in lengths]
        ax.bar_label(bars, numbers, fontsize=9, padding=2)
