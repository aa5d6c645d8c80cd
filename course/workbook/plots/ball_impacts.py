"""Pictures of balls that collide: one pair, a row of them, a rack."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from course.arrays import Array
from course.study import BilliardBreak, CentralImpact
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    bare,
    describe,
    line,
    style,
)
from course.workbook.plots.numerals import signed


def impact(result: CentralImpact, *, ax: Axes | None = None) -> Axes:
    """Two balls on one line before and after a central impact.

    Beside them stands where their kinetic energy goes; with ``ax`` only the balls are
    drawn.
    """
    masses, before, after = result.mass, result.before, result.after
    p_hat, lost = result.impulse, result.lost
    with style():
        if ax is None:
            _, (ax, bars) = plt.subplots(1, 2, figsize=(8.6, 3.4), width_ratios=(3, 2))
            _energy_bars(bars, 0.5 * masses * before**2, 0.5 * masses * after**2, lost)
        scale = 1.4 / max(1.0, np.abs([*before, *after]).max())
        for row, (name, speeds) in enumerate((("before", before), ("after", after))):
            _two_balls(ax, -1.6 * row, masses, speeds, scale)
            ax.text(-3.5, -1.6 * row, name, va="center", ha="left")
        arrow(ax, (-0.55, -2.55), (0.55, -2.55), label="n", lw=1.4)
        ax.set(xlim=(-3.6, 2.8), ylim=(-2.8, 1.0), aspect="equal")
        approach = "" if p_hat > 0 else ": they do not approach"
        ax.set_title(f"$\\hat p$ = {p_hat:.3g} N s{approach}")
        bare(ax)
    describe(
        ax,
        f"Body 1 ({masses[0]:.3g} kg) and body 2 ({masses[1]:.3g} kg) along the "
        f"normal. Before: {before[0]:.3g} and {before[1]:.3g} m/s; after an impulse of "
        f"{p_hat:.3g} N s: {after[0]:.3g} and {after[1]:.3g} m/s. Kinetic energy lost: "
        f"{lost:.3g} J of {0.5 * float(masses @ before**2):.3g} J.",
    )
    return ax


def _two_balls(
    ax: Axes, height: float, masses: Array, speeds: Array, scale: float
) -> None:
    """Body 2 left of the contact, body 1 right of it.

    Their radii grow with the cube root of the mass.
    """
    radii = np.clip(0.32 * np.cbrt(masses), 0.14, 0.62)
    middle: dict[str, Any] = {"ha": "center", "va": "center"}
    for side, index, colour in ((1, 0, "blue"), (-1, 1, "vermillion")):
        centre, look = side * radii[index], {"fc": PALETTE[colour], "ec": "black"}
        ball = Circle((centre, height), radii[index], lw=0.8, alpha=0.85, **look)
        ax.add_patch(ball)
        name = str(index + 1)
        ax.text(centre, height, name, color="white", fontweight="bold", **middle)
        if abs(speeds[index]) > 1e-9:
            lift = height + radii[index] + 0.14
            _speed_arrow(ax, (centre, lift), scale * speeds[index], colour, 2.0)
        said = f"{speeds[index]:+.2f} m/s".replace("-", "\N{MINUS SIGN}")
        ax.text(side * 1.75, height, said, color=PALETTE[colour], **middle)


def _energy_bars(ax: Axes, before: Array, after: Array, lost: float) -> None:
    parts = (
        ("body 1", (before[0], after[0]), "blue", ""),
        ("body 2", (before[1], after[1]), "vermillion", "//"),
        ("lost", (0.0, lost), "grey", ".."),
    )
    foot = np.zeros(2)
    for name, heights, colour, hatch in parts:
        look: dict[str, Any] = {"color": PALETTE[colour], "hatch": hatch, "ec": "white"}
        ax.bar(["before", "after"], heights, bottom=foot, label=name, **look)
        foot = foot + np.array(heights)
    ax.set(ylabel="kinetic energy [J]", ylim=(0, max(foot.max(), 1e-9) * 1.45))
    ax.grid(axis="x", visible=False)
    ax.legend(ncols=3, loc="upper center", handlelength=1.2, columnspacing=1.0)


def ball_row(
    outcomes: Mapping[str, Sequence[float]],
    *,
    radius: float = 0.5,
    ax: Axes | None = None,
) -> Axes:
    """Balls in a row under several laws, a row of the picture for each law.

    Each ball has its velocity [m/s] as an arrow and a number.
    """
    count = len(next(iter(outcomes.values())))
    with style():
        ax = axes(ax, size=(7.6, 0.85 * len(outcomes) + 0.5))
        for row, (name, velocities) in enumerate(outcomes.items()):
            for i, velocity in enumerate(velocities):
                apart = 0.9 if row == 0 and i == 0 else 0.0
                place = (2 * radius * i - apart, -1.5 * row)
                _moving_ball(ax, place, radius, velocity, "0.93" if row else "0.8")
            ax.text(-1.8, -1.5 * row, name, ha="right", va="center")
        right, low = 2 * radius * count + 0.8, -1.5 * len(outcomes) + 0.7
        ax.set(xlim=(-4.0, right), ylim=(low, 0.8), aspect="equal")
        ax.set_title("velocities [m/s]", fontsize=10)
        bare(ax)
    spoken = "; ".join(
        f"{name}: " + ", ".join(f"{v + 0.0:.3f}" for v in values)
        for name, values in outcomes.items()
    )
    describe(ax, f"Balls in a row, velocities in m/s. {spoken}.")
    return ax


def _moving_ball(
    ax: Axes, place: tuple[float, float], radius: float, velocity: float, shade: str
) -> None:
    """A ball of a row with its velocity inside."""
    x, y = place
    ax.add_patch(Circle(place, radius, fc=shade, ec="0.3"))
    if abs(velocity) > 1e-9:
        _speed_arrow(ax, (x, y + 0.22), 0.85 * velocity, "vermillion", 1.8)
    middle: dict[str, Any] = {"ha": "center", "va": "center"}
    ax.text(x, y - 0.2, signed(velocity, 3), fontsize=8.5, **middle)


def _speed_arrow(
    ax: Axes, start: tuple[float, float], length: float, colour: str, lw: float
) -> None:
    """A level arrow whose head shrinks with it, or all short ones would look alike."""
    tip = (start[0] + length, start[1])
    arrow(ax, start, tip, colour, lw=lw, head=float(np.clip(24 * abs(length), 3, 12)))


def billiard_break(outcome: BilliardBreak, *, ax: Axes | None = None) -> Axes:
    """A break just after the impact: every ball with its velocity as an arrow."""
    position, velocity = outcome.after.position, outcome.after.velocity
    speed = np.linalg.norm(velocity, axis=-1)
    fastest = float(np.linalg.norm(outcome.before.velocity, axis=-1).max())
    moves = speed > 1e-3 * fastest
    moving = int(np.sum(moves))
    scale = 6 * outcome.radius / fastest
    with style():
        ax = axes(ax, size=(4.4, 4.0))
        for i, (x, v) in enumerate(zip(position, velocity, strict=True)):
            shade = "0.35" if i == 0 else "0.9"
            ax.add_patch(Circle((x[0], x[1]), outcome.radius, fc=shade, ec="0.3"))
            if moves[i]:
                arrow(ax, x, x + scale * v, "vermillion", lw=1.6)
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        told = f"{outcome.law}:\n{moving} of {len(velocity)} balls move"
        ax.set_title(told, fontsize=10)
        ax.set(xlim=(-0.2, 0.36), ylim=(-0.22, 0.22))
        key = scale * 0.5 * fastest
        line(ax, [(-0.18, -0.19), (-0.18 + key, -0.19)], "vermillion", lw=1.6)
        ax.text(-0.17 + key, -0.19, f"{0.5 * fastest:g} m/s", va="center", fontsize=8.5)
    describe(
        ax,
        f"A rack of {len(velocity) - 1} balls just after the cue ball hit it, law "
        f"{outcome.law}: {moving} balls move; the fastest leaves at {speed.max():.2f} "
        "m/s.",
    )
    return ax
