"""Pictures of impacts: one pair, a row of balls, a rack of balls, two blocks and a
wall.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle, Wedge

from course.dynamics import TwoBlocks
from course.study import BilliardBreak, CentralImpact
from course.workbook.plots.figure import PALETTE, arrow, axes, bare, describe, style


def impact(result: CentralImpact, *, ax: Axes | None = None) -> Axes:
    """Two balls on one line before and after a central impact, and where their kinetic energy goes."""
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
        ax.set_title(
            f"$\\hat p$ = {p_hat:.3g} N s"
            + ("" if p_hat > 0 else ": they do not approach")
        )
        bare(ax)
    describe(
        ax,
        f"Body 1 ({masses[0]:.3g} kg) and body 2 ({masses[1]:.3g} kg) along the normal. Before: {before[0]:.3g} and "
        f"{before[1]:.3g} m/s; after an impulse of {p_hat:.3g} N s: {after[0]:.3g} and {after[1]:.3g} m/s. "
        f"Kinetic energy lost: {lost:.3g} J of {0.5 * float(masses @ before**2):.3g} J.",
    )
    return ax


def _two_balls(
    ax: Axes, height: float, masses: np.ndarray, speeds: np.ndarray, scale: float
) -> None:
    """Body 2 left of the contact, body 1 right of it, radius growing with the cube root
    of the mass.
    """
    radii = np.clip(0.32 * np.cbrt(masses), 0.14, 0.62)
    for side, index, colour in ((1, 0, "blue"), (-1, 1, "vermillion")):
        centre = side * radii[index]
        ax.add_patch(
            Circle(
                (centre, height),
                radii[index],
                fc=PALETTE[colour],
                ec="black",
                lw=0.8,
                alpha=0.85,
            )
        )
        ax.text(
            centre,
            height,
            str(index + 1),
            color="white",
            ha="center",
            va="center",
            fontweight="bold",
        )
        tip = scale * speeds[index]
        if abs(speeds[index]) > 1e-9:
            lift = height + radii[index] + 0.14
            _speed_arrow(ax, (centre, lift), tip, colour, 2.0)
        said = f"{speeds[index]:+.2f} m/s".replace("-", "\N{MINUS SIGN}")
        ax.text(
            side * 1.75, height, said, ha="center", va="center", color=PALETTE[colour]
        )


def _energy_bars(ax: Axes, before: np.ndarray, after: np.ndarray, lost: float) -> None:
    parts = (
        ("body 1", (before[0], after[0]), "blue", ""),
        ("body 2", (before[1], after[1]), "vermillion", "//"),
        ("lost", (0.0, lost), "grey", ".."),
    )
    foot = np.zeros(2)
    for name, heights, colour, hatch in parts:
        ax.bar(
            ["before", "after"],
            heights,
            bottom=foot,
            color=PALETTE[colour],
            hatch=hatch,
            ec="white",
            label=name,
        )
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
    """Balls in a row under several laws: one row a law, each ball with its velocity
    [m/s] as an arrow and a number.
    """
    with style():
        ax = axes(ax, size=(7.6, 0.85 * len(outcomes) + 0.5))
        for row, (name, velocities) in enumerate(outcomes.items()):
            for i, velocity in enumerate(velocities):
                centre = 2 * radius * i - (0.9 if row == 0 and i == 0 else 0.0)
                ax.add_patch(
                    Circle(
                        (centre, -1.5 * row),
                        radius,
                        fc="0.93" if row else "0.8",
                        ec="0.3",
                    )
                )
                if abs(velocity) > 1e-9:
                    lift = -1.5 * row + 0.22
                    _speed_arrow(ax, (centre, lift), 0.85 * velocity, "vermillion", 1.8)
                ax.text(
                    centre,
                    -1.5 * row - 0.2,
                    _signed(velocity),
                    ha="center",
                    va="center",
                    fontsize=8.5,
                )
            ax.text(-1.8, -1.5 * row, name, ha="right", va="center")
        count = len(next(iter(outcomes.values())))
        ax.set(
            xlim=(-4.0, 2 * radius * count + 0.8),
            ylim=(-1.5 * len(outcomes) + 0.7, 0.8),
            aspect="equal",
        )
        ax.set_title("velocities [m/s]", fontsize=10)
        bare(ax)
    spoken = "; ".join(
        f"{name}: " + ", ".join(f"{v + 0.0:.3f}" for v in values)
        for name, values in outcomes.items()
    )
    describe(ax, f"Balls in a row, velocities in m/s. {spoken}.")
    return ax


def blocks_and_wall(*, ax: Axes | None = None) -> Axes:
    """The scene of the question: a wall, a small block, and a heavy one coming in."""
    with style():
        ax = axes(ax, size=(7.2, 2.1))
        ax.add_patch(Rectangle((-0.35, 0), 0.35, 2.0, fc="0.8", ec="0.3", hatch="///"))
        ax.plot([-0.35, 9.2], [0, 0], color="0.3", lw=1.2, marker="", ls="-")
        for left, size, colour, label in (
            (2.0, 0.55, "blue", "1 kg"),
            (5.4, 1.7, "vermillion", "10,000 kg"),
        ):
            ax.add_patch(
                Rectangle(
                    (left, 0),
                    size,
                    size,
                    fc=PALETTE[colour],
                    ec="black",
                    lw=0.8,
                    alpha=0.85,
                )
            )
            ax.text(left + size / 2, size + 0.1, label, ha="center", va="bottom")
        arrow(ax, (5.3, 0.85), (4.1, 0.85), "vermillion", lw=2.4)
        ax.text(4.7, 1.0, "1 m/s", ha="center")
        ax.set(xlim=(-0.5, 9.2), ylim=(-0.1, 2.3), aspect="equal")
        bare(ax)
    describe(
        ax,
        "A wall on the left, a block of 1 kg at rest, and a block of 10,000 kg sliding toward it at 1 m/s.",
    )
    return ax


def _speed_arrow(
    ax: Axes, start: tuple[float, float], length: float, colour: str, lw: float
) -> None:
    """A level arrow whose head shrinks with it, or all short ones would look alike."""
    tip = (start[0] + length, start[1])
    arrow(ax, start, tip, colour, lw=lw, head=float(np.clip(24 * abs(length), 3, 12)))


def _signed(velocity: float) -> str:
    return (
        "0"
        if abs(velocity) < 5e-4
        else f"{velocity:+.3f}".replace("-", "\N{MINUS SIGN}")
    )


def block_paths(motion: TwoBlocks, *, ax: Axes | None = None) -> Axes:
    """Two blocks and a wall in space and time: where each block is, and every
    collision.
    """
    with style():
        ax = axes(ax, size=(7.2, 4.2))
        last = motion.time[-1]
        end = 1.2 * last
        time = np.concatenate([[0.0], motion.time, [end]])
        before = motion.position[0] - motion.velocity[0] * motion.time[0]
        place = np.vstack(
            [
                before,
                motion.position,
                motion.position[-1] + motion.velocity[-1] * (end - last),
            ]
        )
        for i, (name, colour, line) in enumerate(
            (("block 1", "blue", "-"), ("block 2", "vermillion", "--"))
        ):
            label = f"{name}, {motion.mass[i]:g} kg"
            ax.plot(
                place[:, i],
                time,
                color=PALETTE[colour],
                ls=line,
                marker="",
                label=label,
            )
        ax.plot(
            motion.position[:, 0],
            motion.time,
            ls="none",
            marker="o",
            ms=3.5,
            color="black",
            label="a collision",
        )
        ax.axvline(0.0, color="0.4", lw=3, marker="", ls="-")
        ax.set(
            xlabel="distance from the wall [m]",
            ylabel="time [s]",
            xlim=(-0.05, 2.1),
            ylim=(0, end),
        )
        ax.set_title(f"{motion.count} collisions")
        ax.legend(loc="center right")
    describe(
        ax,
        f"Paths of two blocks before a wall, mass ratio {motion.mass[1] / motion.mass[0]:g}: the light block zigzags "
        f"between the wall and the heavy one, {motion.count} collisions in all, then both leave.",
    )
    return ax


def velocity_circle(motion: TwoBlocks, *, ax: Axes | None = None) -> Axes:
    """The same collisions in the plane of sqrt(m) v: equal energy is a circle, each
    collision a chord.

    The grey wedge holds the states after which nothing meets any more: 0 <= v1 <= v2.
    """
    with style():
        ax = axes(ax, size=(7.8, 4.8))
        points = motion.scaled_velocity[:, ::-1]
        radius = float(np.linalg.norm(points[0]))
        theta = np.arctan(np.sqrt(motion.mass[0] / motion.mass[1]))
        wedge = Wedge(
            (0, 0),
            1.12 * radius,
            0,
            np.degrees(theta),
            fc="0.75",
            ec="none",
            label="nothing meets here",
        )
        ax.add_patch(wedge)
        turn = np.linspace(0, 2 * np.pi, 300)
        ax.plot(
            radius * np.cos(turn),
            radius * np.sin(turn),
            color="0.6",
            lw=1,
            ls="-",
            marker="",
        )
        for at_wall, colour, line, name in (
            (False, "blue", "-", "block hits block"),
            (True, "orange", "--", "block hits wall"),
        ):
            for k in np.flatnonzero(motion.at_wall == at_wall):
                ax.plot(
                    *points[k : k + 2].T,
                    color=PALETTE[colour],
                    lw=1.3,
                    ls=line,
                    marker="",
                    label=name,
                )
                name = "_"
        ax.plot(
            *points[0],
            marker="s",
            ms=8,
            color=PALETTE["vermillion"],
            ls="none",
            label="before",
        )
        ax.plot(
            *points[-1],
            marker="^",
            ms=8,
            color=PALETTE["green"],
            ls="none",
            label="at the end",
        )
        ax.set(
            xlabel=r"$x = \sqrt{m_2}\,v_2$ [J$^{1/2}$]",
            ylabel=r"$y = \sqrt{m_1}\,v_1$ [J$^{1/2}$]",
            aspect="equal",
        )
        ax.set_title(f"{motion.count} collisions on one circle")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    describe(
        ax,
        f"The velocities of both blocks, each times the root of its mass: {motion.count + 1} points on one circle, "
        "joined by chords, slanted for block against block and vertical for block against wall, that lead from the "
        "left side of the circle step by step to a narrow wedge on the right side, where nothing meets any more.",
    )
    return ax


def billiard_break(outcome: BilliardBreak, *, ax: Axes | None = None) -> Axes:
    """A break just after the impact: every ball with its velocity as an arrow."""
    with style():
        ax = axes(ax, size=(4.4, 4.0))
        position, velocity = outcome.after.position, outcome.after.velocity
        fastest = float(np.linalg.norm(outcome.before.velocity, axis=-1).max())
        scale = 6 * outcome.radius / fastest
        for i, (x, v) in enumerate(zip(position, velocity, strict=True)):
            ax.add_patch(
                Circle(
                    (x[0], x[1]),
                    outcome.radius,
                    fc="0.35" if i == 0 else "0.9",
                    ec="0.3",
                )
            )
            if np.linalg.norm(v) > 1e-3 * fastest:
                arrow(ax, x, x + scale * v, "vermillion", lw=1.6)
        moving = int(np.sum(np.linalg.norm(velocity, axis=-1) > 1e-3 * fastest))
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.set_title(
            f"{outcome.law}:\n{moving} of {len(velocity)} balls move", fontsize=10
        )
        ax.set(xlim=(-0.2, 0.36), ylim=(-0.22, 0.22))
        key = scale * 0.5 * fastest
        ax.plot(
            [-0.18, -0.18 + key],
            [-0.19, -0.19],
            color=PALETTE["vermillion"],
            lw=1.6,
            ls="-",
            marker="",
        )
        ax.text(-0.17 + key, -0.19, f"{0.5 * fastest:g} m/s", va="center", fontsize=8.5)
    describe(
        ax,
        f"A rack of {len(velocity) - 1} balls just after the cue ball hit it, law {outcome.law}: {moving} balls move; "
        f"the fastest leaves at {np.linalg.norm(velocity, axis=-1).max():.2f} m/s.",
    )
    return ax
