"""Pictures of motion: energies over time, and the constant L as a turning body sees it.
All flat.
"""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from course.dynamics import Tumble
from course.workbook.plots.figure import (
    LINES,
    PALETTE,
    axes,
    describe,
    legend_beside,
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
    with style():
        ax = axes(ax)
        for (name, values), (color, line) in zip(parts.items(), _LOOKS, strict=False):
            ax.plot(t, values, color=PALETTE[color], ls=line, marker="", label=name)
        total = np.sum([np.broadcast_to(v, t.shape) for v in parts.values()], axis=0)
        ax.plot(
            t,
            total,
            color="black",
            lw=5,
            alpha=0.3,
            ls="-",
            marker="",
            zorder=1,
            label="their sum",
        )
        if now is not None:
            ax.axvline(now, color="0.25", lw=1, ls=":", label=f"the film: {now:.2f} s")
        ax.set(xlabel="time [s]", ylabel="energy [J]", title=title)
        legend_beside(ax)
    # What is nothing beside the largest is told as 0.
    least = 1e-6 * max(float(np.max(np.abs(v))) for v in parts.values())
    runs = {
        n: [0.0 if abs(e) < least else e for e in (np.min(v), np.max(v))]
        for n, v in parts.items()
    }
    told = "; ".join(
        f"{n} runs from {low:.3g} to {high:.3g} J" for n, (low, high) in runs.items()
    )
    what = f"{title or 'Energy'} over {t[0]:g} to {t[-1]:g} s"
    describe(ax, f"{what}: {told}. Their sum changes by {np.ptp(total):.2g} J.")
    if now is not None:
        describe(ax, f"A dotted line marks {now:.2f} s, where the film stands.")
    return ax


def seen_from_body(tumble: Tumble, *, ax: Axes | None = None) -> Axes:
    """The parts of L along a body's own three axes, over |L|, in time.

    Each turning over is marked.
    """
    with style():
        ax = axes(ax, size=(7.6, 3.6))
        share = tumble.seen_from_body / np.linalg.norm(tumble.angular_momentum)
        for values, name, (color, line) in zip(
            share.T, AXIS_NAMES, _LOOKS, strict=False
        ):
            ax.plot(
                tumble.times,
                values,
                color=PALETTE[color],
                ls=line,
                marker="",
                label=name,
            )
        moments = tumble.turnover_times()
        label = "on its side"
        for when in moments:
            ax.axvline(when, color="0.5", lw=1, ls=":", label=label)
            label = "_"
        ax.set(
            xlabel="time [s]", ylabel="part of L along the axis / |L|", ylim=(-1.1, 1.1)
        )
        legend_beside(ax)
    when = ", ".join(f"{m:.2f}" for m in moments)
    crosses = f"crosses zero at {when} s" if when else "does not cross zero"
    describe(
        ax,
        f"The parts of the angular momentum along three axes of the body over {tumble.times[0]:g} to "
        f"{tumble.times[-1]:g} s: {_ranges(share)}. The part along the stem {crosses}.",
    )
    return ax


def energy_contours(tumble: Tumble, *, ax: None = None) -> Axes:
    """The sphere |l| = |L| seen along each principal axis: lines of equal energy, and
    where l runs.

    ``l = R'L`` is L as the body sees it. Returns the last of three Axes.
    """
    moments, path = (
        tumble.moments,
        tumble.seen_from_body / np.linalg.norm(tumble.angular_momentum),
    )
    grid = np.linspace(-1, 1, 241)
    with style():
        figure, three = plt.subplots(1, 3, figsize=(9.6, 3.7))
        for toward, panel in enumerate(three):
            # Right-handed: the axis toward the reader, the next to the right, the one
            # after it up.
            right, up = (toward + 1) % 3, (toward + 2) % 3
            x, y = np.meshgrid(grid, grid)
            inside = x**2 + y**2 <= 1
            energy = (
                x**2 / moments[right]
                + y**2 / moments[up]
                + (1 - x**2 - y**2) / moments[toward]
            )
            levels = np.linspace(1 / moments[2], 1 / moments[0], 17)[1:-1]
            energy = np.where(inside, energy, np.nan)
            panel.contour(
                x,
                y,
                energy,
                levels=levels,
                colors="0.62",
                linewidths=0.9,
                linestyles="-",
            )
            turn = np.linspace(0, 2 * np.pi, 200)
            panel.plot(
                np.cos(turn), np.sin(turn), color="0.3", lw=1.2, ls="-", marker=""
            )
            # Near and far side in one line: the orbit is symmetric, and its two sides
            # cover each other.
            panel.plot(
                path[:, right],
                path[:, up],
                color=PALETTE["vermillion"],
                ls="-",
                lw=2,
                marker="",
                label=RUNS,
            )
            if path[0, toward] >= 0:
                panel.plot(
                    path[0, right],
                    path[0, up],
                    "o",
                    color="black",
                    ms=5,
                    ls="none",
                    label="start",
                )
            panel.set(
                aspect="equal",
                xticks=[-1, 0, 1],
                yticks=[-1, 0, 1],
                xlim=(-1.08, 1.08),
                ylim=(-1.08, 1.08),
            )
            panel.set_xlabel(f"along {AXIS_NAMES[right]}")
            panel.set_ylabel(f"along {AXIS_NAMES[up]}")
            panel.set_title(f"seen along: {AXIS_NAMES[toward]}", fontsize=10.5)
            panel.grid(False)
        handles, labels = three[1].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    describe(
        three[-1],
        "A sphere seen along the crossbar, the stem and the third axis, with lines of equal energy. Seen along "
        "the crossbar and along the third axis the lines are closed rings around the middle; seen along the stem they "
        "are branches that come near the middle and lead away from it. The handle's own line follows them: "
        f"{_ranges(path)}.",
    )
    return three[-1]


def _ranges(parts: np.ndarray) -> str:
    """From where to where each part of l/|l| runs, in words."""
    told = zip(AXIS_NAMES, parts.min(axis=0), parts.max(axis=0), strict=True)
    return ", ".join(
        f"{name} {low + 0.0:.2f} to {high + 0.0:.2f}" for name, low, high in told
    )
