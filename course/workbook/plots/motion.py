"""Pictures of motion: energies over time, and L as a turning body sees it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from course.arrays import Array, ArrayLike
from course.dynamics import BodyView, EnergyLines
from course.workbook.plots.figure import (
    LINES,
    axes,
    describe,
    legend_beside,
    line,
    style,
)

AXIS_NAMES = ("crossbar", "stem", "third axis")
RUNS = r"where $\mathbf{l}$ runs"
_LOOKS = tuple(zip(("blue", "orange", "green", "purple"), LINES, strict=True))


def energies(
    times: ArrayLike,
    parts: Mapping[str, ArrayLike],
    *,
    title: str = "",
    now: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Parts of an energy [J] over time [s], a line each, and their sum.

    ``now`` marks a moment [s]: that of a film beside the chart.
    """
    t = np.asarray(times)
    several = {
        name: np.broadcast_to(np.asarray(values, dtype=float), t.shape)
        for name, values in parts.items()
    }
    total = np.sum(list(several.values()), axis=0)
    with style():
        ax = axes(ax)
        for (name, values), (colour, dashes) in zip(
            several.items(), _LOOKS, strict=False
        ):
            line(ax, np.stack([t, values], axis=-1), colour, ls=dashes, label=name)
        look: dict[str, Any] = {"lw": 5, "alpha": 0.3, "zorder": 1}
        line(ax, np.stack([t, total], axis=-1), "black", label="their sum", **look)
        if now is not None:
            ax.axvline(now, color="0.25", lw=1, ls=":", label=f"the film: {now:.2f} s")
        ax.set(xlabel="time [s]", ylabel="energy [J]", title=title)
        legend_beside(ax)
    what = f"{title or 'Energy'} over {t[0]:g} to {t[-1]:g} s"
    told = _runs_in_words(several)
    describe(ax, f"{what}: {told}. Their sum changes by {np.ptp(total):.2g} J.")
    if now is not None:
        describe(ax, f"A dotted line marks {now:.2f} s, where the film stands.")
    return ax


def _runs_in_words(parts: Mapping[str, Array]) -> str:
    """From where to where each part runs; what is nothing beside the largest is 0."""
    least = 1e-6 * max(float(np.abs(v).max()) for v in parts.values())
    told = []
    for name, values in parts.items():
        ends = (values.min(), values.max())
        low, high = (0.0 if abs(e) < least else e for e in ends)
        told.append(f"{name} runs from {low:.3g} to {high:.3g} J")
    return "; ".join(told)


def seen_from_body(view: BodyView, *, ax: Axes | None = None) -> Axes:
    """The parts of L along a body's own three axes, over |L|, in time.

    Each turning over is marked.
    """
    with style():
        ax = axes(ax, size=(7.6, 3.6))
        for part, name, (colour, dashes) in zip(
            view.direction.T, AXIS_NAMES, _LOOKS, strict=False
        ):
            curve = np.stack([view.times, part], axis=-1)
            line(ax, curve, colour, ls=dashes, label=name)
        label = "on its side"
        for when in view.turnovers:
            ax.axvline(when, color="0.5", lw=1, ls=":", label=label)
            label = "_"
        ax.set(xlabel="time [s]", ylabel="part of L along the axis / |L|")
        ax.set_ylim(-1.1, 1.1)
        legend_beside(ax)
    moments = ", ".join(f"{m:.2f}" for m in view.turnovers)
    crosses = f"crosses zero at {moments} s" if moments else "does not cross zero"
    describe(
        ax,
        "The parts of the angular momentum along three axes of the body over "
        f"{view.times[0]:g} to {view.times[-1]:g} s: {_ranges(view.direction)}. The "
        f"part along the stem {crosses}.",
    )
    return ax


def energy_contours(lines: EnergyLines) -> Axes:
    """The sphere |l| = |L| seen along each principal axis, and where l runs on it.

    ``l = R'L`` is L as the body sees it; thin lines are those of equal energy. Returns
    the last of three Axes.
    """
    with style():
        figure, three = plt.subplots(1, 3, figsize=(9.6, 3.7))
        for toward, panel in enumerate(three):
            _sphere_along(panel, lines, toward)
        handles, labels = three[1].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    describe(
        three[-1],
        "A sphere seen along the crossbar, the stem and the third axis, with lines of "
        "equal energy. Seen along the crossbar and along the third axis the lines are "
        "closed rings around the middle; seen along the stem they are branches that "
        "come near the middle and lead away from it. The handle's own line follows "
        f"them: {_ranges(lines.direction)}.",
    )
    return three[-1]


def _sphere_along(panel: Axes, lines: EnergyLines, toward: int) -> None:
    """The sphere with one axis toward the reader.

    Right-handed: the next axis points to the right, the one after it up.
    """
    right, up = (toward + 1) % 3, (toward + 2) % 3
    look: dict[str, Any] = {"colors": "0.62", "linewidths": 0.9, "linestyles": "-"}
    grid, energy = lines.grid, lines.energy[toward]
    panel.contour(grid, grid, energy, levels=lines.levels, **look)
    turn = np.linspace(0, 2 * np.pi, 200)
    line(panel, np.stack([np.cos(turn), np.sin(turn)], axis=-1), lw=1.2)
    # Near and far side in one line: the orbit is symmetric, and its two sides cover
    # each other.
    line(panel, lines.direction[:, [right, up]], "vermillion", lw=2, label=RUNS)
    start = lines.direction[0]
    if start[toward] >= 0:
        look = {"color": "black", "ms": 5, "ls": "none", "label": "start"}
        panel.plot(start[right], start[up], marker="o", **look)
    ticks = [-1, 0, 1]
    panel.set(aspect="equal", xticks=ticks, yticks=ticks)
    panel.set(xlim=(-1.08, 1.08), ylim=(-1.08, 1.08))
    panel.set_xlabel(f"along {AXIS_NAMES[right]}")
    panel.set_ylabel(f"along {AXIS_NAMES[up]}")
    panel.set_title(f"seen along: {AXIS_NAMES[toward]}", fontsize=10.5)
    panel.grid(False)


def _ranges(parts: Array) -> str:
    """From where to where each part of l/|l| runs, in words."""
    told = zip(AXIS_NAMES, parts.min(axis=0), parts.max(axis=0), strict=True)
    return ", ".join(
        f"{name} {low + 0.0:.2f} to {high + 0.0:.2f}" for name, low, high in told
    )
