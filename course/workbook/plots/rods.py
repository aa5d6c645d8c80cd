"""Pictures of rods that fall on pegs or on the floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon, Rectangle

from course.arrays import Array
from course.study import RodLanding
from course.workbook.plots.figure import (
    PALETTE,
    SPEED_SCALE,
    arrow,
    axes,
    bare,
    describe,
    line,
    style,
)
from course.workbook.plots.numerals import signed

LABELS = {  # where a speed is written: right and up of the point, and its alignment
    -1.0: (-0.08, 0.05, "right", "bottom"),
    0.0: (0.09, 0.05, "left", "bottom"),
    1.0: (0.09, -0.04, "left", "top"),
}
PIN = 0.45  # how far the lower end stands above the floor


def rod_on_pegs(*, ax: Axes | None = None) -> Axes:
    """The scene of the question: two rods fall flat, each on one peg.

    One peg stands under the rod's middle, the other under the rod's end.
    """
    with style():
        ax = axes(ax, size=(8.4, 2.9))
        _rod_over_a_peg(ax, -0.85, 0.0, "peg under its middle: 2 N s")
        _rod_over_a_peg(ax, 0.85, 0.5, "peg under its end: 0.5 N s")
        ax.text(-0.05, 0.28, "1 m/s", ha="center", va="center")
        line(ax, [(-1.6, -0.34), (1.95, -0.34)], lw=1.2)
        ax.set(xlim=(-1.65, 2.0), ylim=(-0.6, 0.5), aspect="equal")
        bare(ax)
    describe(
        ax,
        "Two equal rods fall flat at 1 m/s, the left one on a fixed peg under its "
        "middle, which gives it 2 N s, the right one on a fixed peg under its end, "
        "which gives it 0.5 N s.",
    )
    return ax


def _rod_over_a_peg(ax: Axes, middle: float, peg: float, words: str) -> None:
    """A level rod about its middle with its speed, and a peg beside the middle."""
    ends = [(middle - 0.5, 0.04), (middle + 0.5, 0.04)]
    line(ax, ends, "blue", lw=7, solid_capstyle="butt")
    for x in (-0.4, 0.0, 0.4):
        arrow(ax, (middle + x, 0.42), (middle + x, 0.42 - SPEED_SCALE), "blue")
    x = middle + peg
    corners = [(x - 0.07, -0.34), (x + 0.07, -0.34), (x, 0.0)]
    ax.add_patch(Polygon(corners, fc="0.75", ec="0.3"))
    ax.text(x, -0.4, words, ha="center", va="top")


def rod_impact(result: RodLanding, *, ax: Axes | None = None) -> Axes:
    """A rod before and after the floor hits it at one point.

    The rod has 1 kg and 1 m and falls at 1 m/s; a light pin reaches down from the
    point to the floor.
    """
    rate = result.spin
    sense = "clockwise" if rate > 0 else "anticlockwise"
    turns = "" if abs(rate) < 5e-3 else f", {sense}"
    with style():
        ax = axes(ax, size=(8.8, 4.5))
        _floor_under_the_pin(ax, result)
        for middle, velocity, words in (
            (-1.1, result.before, "before"),
            (1.1, result.after, "after"),
        ):
            _rod(ax, middle, result, velocity)
            ax.text(middle, 1.12, words, ha="center", va="top", fontweight="bold")
        kept = f"energy kept: {100 * result.kept:.0f} %"
        small: dict[str, Any] = {"ha": "center", "va": "top", "fontsize": 9.5}
        ax.text(1.1, 0.98, f"spin {abs(rate):.2f} rad/s{turns}\n{kept}", **small)
        felt = f"m = 1 kg\nmass felt at the point: {result.felt:.3f} kg"
        ax.text(-1.1, 0.98, felt, **small)
        ax.set(xlim=(-2.2, 2.3), ylim=(-1.1, 1.15), aspect="equal")
        push = f"impulse of the floor {result.impulse:.3f} N s"
        ax.set_title(f"{push}; at the points: upward speeds [m/s]")
        bare(ax)
    describe(ax, _landing_in_words(result, turns))
    return ax


def _floor_height(result: RodLanding) -> float:
    return float(0.5 * result.axis[2] - PIN)


def _floor_under_the_pin(ax: Axes, result: RodLanding) -> None:
    floor = _floor_height(result)
    look: dict[str, Any] = {"fc": "0.88", "ec": "none", "hatch": "///"}
    ax.add_patch(Rectangle((-2.2, floor - 0.08), 4.5, 0.08, **look))
    line(ax, [(-2.2, floor), (2.3, floor)], lw=1.2)


def _rod(ax: Axes, middle: float, result: RodLanding, velocity: Array) -> None:
    """The rod in the x-z plane with three velocities, and the pin on the floor."""
    along, origin = result.axis[[0, 2]], np.array([middle, 0.0])
    ends = origin + 0.5 * np.outer([-1, 1], along)
    line(ax, ends, "sky", lw=7, solid_capstyle="butt")
    hit = origin + 0.5 * result.place * along
    foot = np.array([hit[0], _floor_height(result)])
    line(ax, np.stack([hit, foot]), lw=1.6)
    ax.plot(*foot, marker="^", ms=8, color="black", ls="none")
    for s, v in zip((-1.0, 0.0, 1.0), velocity, strict=True):
        start = origin + 0.5 * s * along
        if np.hypot(v[0], v[2]) > 5e-3:
            arrow(ax, start, start + SPEED_SCALE * v[[0, 2]], "vermillion", zorder=4)
        ax.plot(*start, marker="o" if s else "s", ms=5, color="black", ls="none")
        right, up, across, height = LABELS[s]
        x, z = start + [right, up]
        ax.text(x, z, signed(v[2]), ha=across, va=height, fontsize=9.5)


def _landing_in_words(result: RodLanding, turns: str) -> str:
    return (
        f"A rod of 1 kg, 1 m long, {result.angle:.3g} degrees from the horizontal, "
        f"falls at 1 m/s and is hit from below at {result.place:.2f} of the way from "
        f"its middle to its lower end, e = {result.restitution:.2f}. It feels as heavy "
        f"as {result.felt:.3f} kg there; the impulse is {result.impulse:.3f} N s. "
        f"Afterwards its middle moves at {result.after[1, 2]:+.2f} m/s upward and it "
        f"turns at {abs(result.spin):.2f} rad/s{turns}; "
        f"{100 * result.kept:.0f} percent of the energy is kept."
    )


def rod_impulses(
    angle: Sequence[float],
    closed_form: Sequence[float],
    measured: Mapping[str, tuple[Sequence[float], Sequence[float]]],
    *,
    without_spin: float,
    ax: Axes | None = None,
) -> Axes:
    """The impulse on a rod dropped on its end, over the angle of the rod.

    The closed form is a line, measurements are marks.

    Args:
        angle: of the line, from the horizontal [degrees].
        closed_form: impulse of the line [N s].
        measured: name -> (angles [degrees], impulses [N s]).
        without_spin: the impulse of a body that cannot turn [N s].
    """
    with style():
        ax = axes(ax, size=(7.6, 4.1))
        _levels_of_impulse(ax, without_spin)
        line(ax, np.transpose([angle, closed_form]), "0.2", lw=1.5,
             label="your closed form")  # fmt: skip
        looks = zip(("vermillion", "green", "purple"), "osD", (8, 4.5, 5), strict=True)
        for (name, (x, y)), (colour, mark, size) in zip(
            measured.items(), looks, strict=False
        ):
            edge = PALETTE[colour]
            look: dict[str, Any] = {
                "mfc": "none" if mark == "o" else edge,
                "mec": edge,
                "mew": 1.5,
            }
            ax.plot(x, y, ls="none", marker=mark, ms=size, label=name, **look)
        ax.set(xlabel="angle from the horizontal [°]", ylabel="impulse [N s]")
        ax.set(xticks=range(0, 91, 15), ylim=(0, 1.12 * without_spin))
        ax.set_title("A rod dropped on its end")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    named = "; ".join(
        f"{name}: {y[0]:.3f} N s at {x[0]:g} degrees, {y[-1]:.3f} at {x[-1]:g}"
        for name, (x, y) in measured.items()
    )
    describe(
        ax,
        "Impulse on a rod's end over its angle from the horizontal, rising from a "
        f"quarter of {without_spin:g} N s for the level rod to all of it for the "
        f"upright one. {named}.",
    )
    return ax


def _levels_of_impulse(ax: Axes, whole: float) -> None:
    """The impulse of a body that cannot turn, and a quarter of it."""
    ax.axhline(whole, color="0.45", ls="--", lw=1.2, label="a body that cannot turn")
    quarter: dict[str, Any] = {"color": PALETTE["blue"], "ls": ":", "lw": 1.2}
    ax.axhline(whole / 4, label="a quarter of it", **quarter)


def spin_by_pegs(
    place: Sequence[float],
    by_order: Mapping[str, Sequence[float]],
    both: Sequence[float],
    threshold: float,
    *,
    ax: Axes | None = None,
) -> Axes:
    """The spin of a level rod after it fell on two pegs, over where they stand.

    There is one series for each order of the pegs, and one for both at once.

    Args:
        place: of the pegs, left and right of the middle [m].
        by_order: name of an order -> spin about y [rad/s].
        both: spin by the law that takes both at once [rad/s].
        threshold: where the pegs do not feel each other [m].
    """
    with style():
        ax = axes(ax, size=(8.6, 4.0))
        for (name, rate), colour, mark in zip(
            by_order.items(), ("vermillion", "purple"), "os", strict=False
        ):
            look: dict[str, Any] = {
                "ms": 5,
                "mfc": "none",
                "mec": PALETTE[colour],
                "mew": 1.4,
            }
            ax.plot(place, rate, ls="none", marker=mark, label=name, **look)
        together = np.transpose([place, both])
        line(ax, together, "green", ls="--", label="both at once")
        said = f"radius of gyration\n{threshold:.3g} m"
        ax.axvline(threshold, color=PALETTE["blue"], ls=":", label=said)
        ax.set_xlabel("pegs left and right of the middle at [m]")
        ax.set_ylabel(r"spin about y, $\omega_y$ [rad/s]")
        ax.set_title("A level rod on two pegs, e = 1")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    most = max(float(np.abs(rate).max()) for rate in by_order.values())
    describe(
        ax,
        "Spin of a level rod after it fell on two pegs, over the distance of the pegs "
        f"from its middle: opposite for the two orders, up to {most:.2f} rad/s, and "
        f"zero for both where the pegs stand at {threshold:.3f} m and under the ends. "
        "With both pegs at once there is no spin.",
    )
    return ax
