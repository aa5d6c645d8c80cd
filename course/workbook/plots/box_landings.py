"""Pictures of a box that lands on its four corners, or is hit on its upper face."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from course.arrays import Array
from course.study import BoxOutcomes, OrderOutcomes
from course.workbook.plots.figure import (
    COLOURS,
    HATCHES,
    PALETTE,
    SPEED_SCALE,
    arrow,
    axes,
    bare,
    describe,
    line,
    style,
)
from course.workbook.plots.numerals import plain, signed


def box_outcomes(result: BoxOutcomes) -> Axes:
    """A box on its four corners before an impact, and how fast they rise after it.

    The picture numbers the corners 1 to 4; beside it each of up to five laws has a bar
    at every corner.
    """
    with style():
        _, (ax, bars) = plt.subplots(1, 2, figsize=(10.0, 4.4), width_ratios=(1.0, 1.9))
        _box(ax, result)
        _corner_bars(bars, result)
    spoken = " ".join(
        f"{name}: {', '.join(map(plain, speed))} m/s, "
        f"spin {_spin(result.spin[name])} rad/s."
        for name, speed in result.speed.items()
    )
    describe(
        ax,
        "A box just above the floor, and the upward speeds of its corners 1 to 4, "
        f"with its spin about x and y. {spoken}",
    )
    return ax


def _box(ax: Axes, result: BoxOutcomes) -> None:
    """The box with the numbers and the upward speeds of its corners."""
    corners = result.corners
    low = np.stack([corners[:, 0] + 0.5 * corners[:, 1], 0.45 * corners[:, 1]], axis=-1)
    high = low + [0.0, result.height]
    for face in (low, high):
        ax.add_patch(Polygon(face[[0, 2, 3, 1]], fc="0.9", ec="0.45", alpha=0.6))
    for edge in zip(low, high, strict=True):
        line(ax, edge, "0.45", lw=1.0)
    back = {"fc": "white", "ec": "none", "pad": 0.6, "alpha": 0.85}
    for i, (start, speed) in enumerate(zip(low, result.speed["before"], strict=True)):
        if abs(speed) > 5e-3:
            tip = (start[0], start[1] + SPEED_SCALE * speed)
            arrow(ax, start, tip, "vermillion", zorder=4)
        ax.plot(*start, marker="o", ms=4, color="black", ls="none")
        # Out of the way of the arrows beside it.
        aside, side = (0.05, "left") if i % 2 else (-0.05, "right")
        ax.text(start[0] + aside, start[1] - 0.04, f"{i + 1}: {signed(speed)}",
                ha=side, va="center", fontsize=9.5, bbox=back)  # fmt: skip
    ax.set(xlim=(-1.0, 1.0), ylim=(-0.7, 0.6), aspect="equal")
    spin = _spin(result.spin["before"])
    ax.set_title(f"before [m/s],\nspin {spin} rad/s", fontsize=10)
    bare(ax)


def _corner_bars(ax: Axes, result: BoxOutcomes) -> None:
    """The upward speeds of the corners after, a group a corner and a bar a law."""
    laws = [name for name in result.speed if name != "before"]
    width = 0.86 / len(laws)
    for k, (name, colour, hatch) in enumerate(
        zip(laws, COLOURS, HATCHES, strict=False)
    ):
        place = np.arange(4) + (k - 0.5 * (len(laws) - 1)) * width
        speeds = np.round(result.speed[name], 9) + 0.0  # no minus zero below the axis
        look: dict[str, Any] = {"color": PALETTE[colour], "hatch": hatch, "ec": "white"}
        label = f"{name}: {_spin(result.spin[name])}"
        drawn = ax.bar(place, speeds, width, label=label, **look)
        ax.bar_label(drawn, [plain(v) for v in speeds], fontsize=8, padding=1)
    ax.axhline(0, color="0.3", lw=0.8)
    ax.margins(y=0.1)  # room for the numbers at the bars
    ax.set_xticks(range(4), [f"corner {i + 1}" for i in range(4)])
    ax.set_ylabel("upward speed after [m/s]")
    ax.grid(axis="x", visible=False)
    said = r"after, with the spin $(\omega_x, \omega_y)$ [rad/s]"
    ax.legend(loc="upper center", bbox_to_anchor=(0.45, -0.09), ncols=2, title=said)


def _spin(omega: Array) -> str:
    """The spin about x and about y, with their signs."""
    return f"({', '.join(map(plain, omega[:2]))})"


def spins_by_order(
    outcomes: OrderOutcomes,
    others: Mapping[str, Sequence[float]],
    *,
    ax: Axes | None = None,
) -> Axes:
    """The spin that each order of the same contacts gives the same box.

    Each order is one point; orders with the same outcome are counted beside it.

    Args:
        outcomes: of ``study.outcomes_by_order``.
        others: name -> omega (3,) by a law that does not ask for the order [rad/s].
    """
    orders = len(outcomes.order)
    with style():
        ax = axes(ax, size=(8.2, 4.0))
        look: dict[str, Any] = {"mfc": "none", "mec": PALETTE["vermillion"], "mew": 1.5}
        label = f"one after the other,\n{orders} orders"
        ax.plot(
            *outcomes.spin[:, :2].T, ls="none", marker="o", ms=6, label=label, **look
        )
        for spin, count in zip(outcomes.different, outcomes.times, strict=True):
            if count > 1:
                _counted(ax, spin[:2], count)
        for (name, omega), mark in zip(others.items(), "*D^", strict=False):
            look = {"marker": mark, "ms": 13, "color": PALETTE["blue"]}
            ax.plot(omega[0], omega[1], ls="none", label=name, **look)
        ax.set_xlabel(r"spin about x, $\omega_x$ [rad/s]")
        ax.set_ylabel(r"spin about y, $\omega_y$ [rad/s]")
        ax.set_aspect("equal")
        ax.margins(x=0.12)
        ax.set_title("One box, one impact")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    fastest = float(np.linalg.norm(outcomes.spin, axis=1).max())
    named = "; ".join(
        f"{name}: {np.linalg.norm(s):.2f} rad/s" for name, s in others.items()
    )
    describe(
        ax,
        "Spins of a box after the same flat landing with its four contacts listed in "
        f"{orders} orders: {len(outcomes.different)} different outcomes scattered "
        f"around zero, up to {fastest:.2f} rad/s. {named}.",
    )
    return ax


def _counted(ax: Axes, place: Array, count: int) -> None:
    """How many orders end at one place, written outside of it."""
    right = place[0] > 0
    aside, side = (7, "left") if right else (-7, "right")
    ax.annotate(f"{count} orders", tuple(place), (aside, 0), va="center", ha=side,
                textcoords="offset points", fontsize=9)  # fmt: skip


def mass_over_face(x: Array, y: Array, ratio: Array, *, ax: Axes | None = None) -> Axes:
    """Effective mass over mass where a box is hit on its upper face.

    Lines show where an impulse computed without spin is too large by 1, 10 and 50 %.

    Args:
        x, y: of the face, from its middle, (k,) and (l,) [m].
        ratio: mu/m, (l, k).
    """
    with style():
        ax = axes(ax, size=(7.4, 4.2))
        levels = np.linspace(0.0, 1.0, 11)
        filled = ax.contourf(x, y, ratio, levels=levels, cmap="viridis")
        bar = ax.get_figure(root=True).colorbar(filled, ax=ax)  # type: ignore[union-attr]
        bar.set_label(r"mass felt / mass, $\mu/m$")
        for error, dashes in ((1, "-"), (10, "--"), (50, ":")):
            look: dict[str, Any] = {"colors": "black", "linewidths": 1.6}
            level = [1 / (1 + error / 100)]
            ax.contour(x, y, ratio, levels=level, linestyles=dashes, **look)
            nowhere = np.empty((0, 2))
            label = f"{error} % too large"
            line(ax, nowhere, "black", lw=1.6, ls=dashes, label=label)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.set_title("Mass felt where the top face is hit")
        said = "on this line the impulse without spin is"
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3, title=said)
        ax.grid(False)
    describe(
        ax,
        "Effective mass over mass on the upper face of a box: 1 in the middle, "
        f"{ratio[0, 0]:.2f} at the corners. Three nested ellipses show where an "
        "impulse computed without spin is too large by 1, 10 and 50 percent.",
    )
    return ax
