"""Pictures of the contact matrix: a pushed table, the pattern of A, its costs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from course.arrays import Array
from course.contact import ContactSystem
from course.study import MatrixGrowth, PushedTable
from course.workbook.plots.figure import (
    LINES,
    MARKERS,
    PALETTE,
    axes,
    centre_mark,
    describe,
    legend_beside,
    line,
    side_by_side,
    style,
)


def pushed_table(
    result: PushedTable, *, answer: bool = True, ax: Axes | None = None
) -> Axes:
    """The table of 1 kg from above, pushed up from below with 1 N at (x, y).

    Its four feet are marked by how they begin to move; the dashed line is where nothing
    moves at first. Without ``answer`` only the push is shown; with ``ax`` only the
    picture from above.
    """
    (x, y), centre, response = result.place, result.centre, result.response
    with style():
        bars = None
        if ax is None and answer:
            _, (ax, bars) = plt.subplots(1, 2, figsize=(9.6, 3.9), width_ratios=(3, 2))
        ax = axes(ax, size=(6.4, 3.9))
        _table_from_above(ax, result.feet, centre)
        if answer:
            _answer(ax, result)
        look: dict[str, Any] = {"ls": "none", "marker": "*", "ms": 15, "mec": "black"}
        ax.plot(x, y, mfc=PALETTE["orange"], label="pushed up with 1 N", **look)
        ax.set(xlim=(-0.85, 0.85), ylim=(-0.52, 0.52), aspect="equal")
        ax.set(xlabel="x [m]", ylabel="y [m]")
        place: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17)}
        ax.legend(ncols=2, labelspacing=0.8, **place)
        if bars is not None:
            _response_bars(bars, response)
    spoken = ""
    if answer:
        rates = ", ".join(f"{v + 0.0:+.2f}" for v in response)
        spoken = f" The feet are accelerated by {rates} m/s^2, 1 to 4."
    describe(
        ax,
        "A table of 1 kg on four feet, from above, its centre of mass at "
        f"({centre[0]:g}, {centre[1]:g}) m from the middle. It is pushed up with 1 N "
        f"at ({x:g}, {y:g}) m.{spoken}",
    )
    return ax


def _answer(ax: Axes, result: PushedTable) -> None:
    """The line that is not moved at first, and the feet as they begin to move."""
    if result.still is not None:
        still = "not moved at first"
        line(ax, result.still, "black", lw=1.4, ls="--", label=still)
    _moving_feet(ax, result.feet, result.response)


def matrix_pattern(system: ContactSystem, *, name: str, ax: Axes | None = None) -> Axes:
    """Where J and A of a named scene are not 0, and with which sign.

    With ``ax`` only A is drawn.
    """
    a, factors = system.A.toarray(), system.jacobian.toarray()
    with style():
        if ax is None:
            _, (left, ax) = side_by_side(2, size=(10.4, 4.4))
            _signs(left, factors, "J", "column: 6 for each body")
        _signs(ax, a, "A = J M⁻¹ J'", "contact that is pushed")
        legend_beside(ax, markerscale=2.5)
    full = np.count_nonzero(a) / a.size
    describe(
        ax,
        f"{name}: the pattern of J, {factors.shape[0]} by {factors.shape[1]}, and of "
        f"A, {len(a)} by {len(a)}, positive and negative entries. {100 * full:.0f} "
        "percent of A is not 0: only contacts that share a body that can move.",
    )
    return ax


def matrix_costs(result: MatrixGrowth) -> Axes:
    """Seconds and counted multiplications over the number of contacts.

    The counts come with their exponent; that of seconds differs from machine to
    machine, so they are given as measured.
    """
    with style():
        _, (left, right) = side_by_side(2, size=(10.4, 4.0))
        times = {name: name for name in result.contacts}
        _costs(left, result.contacts, result.seconds, times)
        counts = {name: f"{name}: c^{p:.1f}" for name, p in result.exponent.items()}
        _costs(right, result.contacts, result.multiplications, counts)
        left.set_ylabel("time [s]")
        right.set_ylabel("multiplications")
    spoken = [
        f"{name} time [s] from {y[0]:.2g} at {c[0]:g} to {y[-1]:.2g} at {c[-1]:g} "
        "contacts"
        for (name, c), y in zip(
            result.contacts.items(), result.seconds.values(), strict=True
        )
    ]
    spoken += [
        f"{name} multiplications c^{p:.1f}" for name, p in result.exponent.items()
    ]
    describe(
        left,
        "Cost of making A over the number of contacts, both axes logarithmic: "
        f"{'; '.join(spoken)}.",
    )
    return left


def _costs(
    ax: Axes,
    contacts: Mapping[str, Array],
    costs: Mapping[str, Array],
    labels: Mapping[str, str],
) -> None:
    for k, (name, c) in enumerate(contacts.items()):
        look: dict[str, Any] = {"marker": MARKERS[k], "ls": LINES[k % 4]}
        ax.loglog(c, costs[name], label=labels[name], **look)
    ax.set_xlabel("contacts c")
    ax.legend(loc="upper left")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high * 30)  # room for the legend


def _table_from_above(ax: Axes, feet: Array, centre: Array) -> None:
    """The table with its numbered feet and its centre of mass."""
    low, size = feet[:, :2].min(axis=0) - 0.08, np.ptp(feet[:, :2], axis=0) + 0.16
    ax.add_patch(Rectangle(tuple(low), *size, fc="0.93", ec="0.3"))
    ax.plot(*feet[:, :2].T, ls="none", marker="o", ms=6, mfc="white", mec="0.3")
    for k, foot in enumerate(feet):
        inward = (-16 * np.sign(foot[0]), 0)
        ax.annotate(str(k + 1), foot[:2], inward, textcoords="offset points",
                    ha="center", va="center")  # fmt: skip
    centre_mark(ax, centre, label="centre of mass")
    ax.grid(False)


def _moving_feet(ax: Axes, feet: Array, response: Array) -> None:
    """The feet that begin to rise and those that are driven down.

    One that feels nothing keeps its plain mark.
    """
    for chosen, mark, colour, word in (
        (response > 1e-9, "^", "blue", "begins to rise"),
        (response < -1e-9, "v", "vermillion", "is driven down"),
    ):
        if chosen.any():
            place = feet[chosen, :2].T
            look: dict[str, Any] = {"marker": mark, "ms": 13, "color": PALETTE[colour]}
            ax.plot(*place, ls="none", label=f"foot {word}", **look)


def _response_bars(ax: Axes, response: Array) -> None:
    for k, value in enumerate(response):
        up = value > 0
        colour, hatch = ("blue", "") if up else ("vermillion", "//")
        ax.bar(k, value, color=PALETTE[colour], hatch=hatch, ec="white")
        shift, side = (3, "bottom") if up else (-3, "top")
        ax.annotate(f"{value + 0.0:+.2f}", (k, value), (0, shift), ha="center", va=side,
                    textcoords="offset points")  # fmt: skip
    ax.axhline(0, color="0.3", lw=0.8)
    reach = max(1.0, float(np.abs(response).max()))
    ax.set_xticks(range(4), [f"foot {k + 1}" for k in range(4)])
    ax.set(ylabel="acceleration upward [m/s²]", ylim=(-1.2 * reach, 1.2 * reach))
    ax.grid(axis="x", visible=False)


def _signs(ax: Axes, matrix: Array, title: str, columns: str) -> None:
    size = max(1.2, 160 / max(matrix.shape))
    for positive, mark, colour in ((True, "s", "blue"), (False, "x", "vermillion")):
        rows, places = np.nonzero(matrix > 0 if positive else matrix < 0)
        look: dict[str, Any] = {"marker": mark, "ms": size, "color": PALETTE[colour]}
        label = "above 0" if positive else "below 0"
        ax.plot(places + 1, rows + 1, ls="none", label=label, **look)
    ax.set(xlim=(0, matrix.shape[1] + 1), ylim=(matrix.shape[0] + 1, 0))
    ax.set(xlabel=columns, ylabel="contact", title=title)
    ax.grid(False)
