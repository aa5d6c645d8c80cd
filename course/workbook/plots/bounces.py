"""Pictures of a ball and a wall: the reflection, the bounces, and their energy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from course.dynamics import BallMotion
from course.study import PUBLISHED_BOUNCING, BouncingErrors, WallReflection
from course.workbook.plots.figure import (
    LINES,
    PALETTE,
    arrow,
    axes,
    describe,
    legend_beside,
    line,
    style,
)


def reflection(result: WallReflection, *, ax: Axes | None = None) -> Axes:
    """A ball meeting a wall in the plane: its velocity before and after.

    Each is split along and across the normal.
    """
    come, leave = (
        round(float(np.sum(v * result.normal)), 2) + 0.0  # no -0.00
        for v in (result.before, result.after)
    )
    told = f"{come:+.2f} m/s before, {leave:+.2f} m/s after"
    told = told if come < 0 else f"{leave:+.2f} m/s, no bounce"
    with style():
        ax = axes(ax, size=(5.6, 4.6))
        _wall(ax, result)
        _velocities(ax, result)
        ax.set(xlim=(-1.57, 1.57), ylim=(-1.3, 1.3), aspect="equal")
        ax.set(xlabel="x [m/s]", ylabel="y [m/s]")
        ax.set_title(f"Along n: {told}".replace("-", "\N{MINUS SIGN}"))
    describe(
        ax,
        f"A wall at {result.wall_angle:.0f} degrees and a ball at 1 m/s going at "
        f"{result.incoming_angle:.0f} degrees, e = {result.restitution:.2f}. Along the "
        f"normal its speed is {come:.2f} m/s before and {leave:.2f} m/s after; along "
        "the wall it does not change.",
    )
    return ax


def _wall(ax: Axes, result: WallReflection) -> None:
    ends = np.outer([-3.0, 3.0], result.along)  # beyond the frame at every angle
    line(ax, ends, "0.25", lw=3)
    solid = np.vstack([ends, ends[::-1] - 0.25 * result.normal])
    ax.fill(*solid[:, :2].T, color="0.88", lw=0, zorder=0)


def _velocities(ax: Axes, result: WallReflection) -> None:
    """Both velocities, n, and dotted the way along the wall and then along n."""
    normal, along = result.normal, result.along
    before, after, none = result.before, result.after, np.zeros(3)
    arrow(ax, -before, none, "blue", label="v before", beyond=-0.2, lw=2.4)
    arrow(ax, none, after, "vermillion", label="v after", beyond=0.2, lw=2.4)
    arrow(ax, none, 0.5 * normal, lw=1.4)
    # Beside its arrow, on the side the ball leaves to: the dotted parts of the velocity
    # before run along n on the other.
    beside = 0.12 if np.sum(after * along) >= 0 else -0.12
    x, y, _ = 0.45 * normal + beside * along
    ax.text(x, y, "n", ha="center", va="center")
    for tail, tip, colour in ((-before, none, "blue"), (none, after, "vermillion")):
        corner = tail + np.sum((tip - tail) * along) * along
        path = np.array([tail, corner, tip]) + 0.02 * normal
        line(ax, path, colour, lw=1.8, ls=":")


def heights(
    motions: Mapping[str, BallMotion],
    *,
    rest: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Height over time of one ball computed in several ways.

    ``rest`` marks the time it comes to rest.
    """
    with style():
        ax = axes(ax)
        for i, (name, motion) in enumerate(motions.items()):
            ax.plot(motion.time, motion.height, label=name, marker="", ls=LINES[i % 4])
        if rest is not None:
            said = f"at rest: {rest:.4f} s"
            ax.axvline(rest, color=PALETTE["blue"], ls=":", lw=1.2, label=said)
        ax.set(xlabel="time [s]", ylabel="height [m]")
        ax.legend(loc="upper right")
    end = f" The ball is at rest from {rest:.4f} s on." if rest is not None else ""
    describe(ax, f"Height of a bouncing ball over time: {', '.join(motions)}.{end}")
    return ax


def bouncing_errors(errors: BouncingErrors, *, ax: Axes | None = None) -> Axes:
    """The energy error of 49 balls over the step size: measured and published.

    That of the event-driven ball lies below the picture and is told.
    """
    # The event-driven ball, 20 powers of ten lower, would squeeze the rest.
    low = 1e-3 * float(min(errors.ode))
    with style():
        ax = axes(ax, size=(7.6, 4.6))
        for ours, dashes, colour, name in (
            (errors.bullet, "-", "vermillion", "gravity, then reflect"),
            (errors.ode, "--", "blue", "reflect, or else gravity"),
        ):
            look: dict[str, Any] = {"color": PALETTE[colour], "marker": ""}
            ax.loglog(errors.step, ours, ls=dashes, label=name, **look)
        _published(ax)
        least = errors.event_driven.max()
        told = (
            f"event-driven, {errors.events} events:\nat {least:.0e}, below the picture"
        )
        look = {"ls": "none", "marker": "v", "ms": 5, "color": PALETTE["black"]}
        ax.plot(errors.step, np.full(errors.step.shape, 2 * low), label=told, **look)
        ax.set_ylim(low, None)
        ax.set(xlabel="step [s]", ylabel="mean squared energy error [J²]")
        ax.set_title("49 balls, 20 s, nothing lost")
        legend_beside(ax)
    describe(
        ax,
        "Mean squared energy error of 49 bouncing balls over the step size, both "
        "logarithmic. The loop that reflects or else falls lies on the published "
        "figures of ODE, the loop that lets gravity act first on those of Bullet, "
        "hundreds of times higher; both rise with the square of the step. The "
        "event-driven ball stays at rounding level.",
    )
    return ax


def _published(ax: Axes) -> None:
    published = PUBLISHED_BOUNCING
    for values, marker, colour, name in (
        (published.bullet_error, "s", "vermillion", "Bullet"),
        (published.dart_error, "D", "purple", "DART"),
        (published.ode_error, "o", "blue", "ODE"),
        (published.raisim_error, "^", "green", "RaiSim (error reduction on)"),
    ):
        look: dict[str, Any] = {"mfc": "none", "color": PALETTE[colour], "ls": "none"}
        label = f"{name}, published"
        ax.loglog(published.step, values, marker=marker, label=label, **look)


def energy_over_time(
    series: Mapping[str, tuple[np.ndarray, np.ndarray]], *, ax: Axes | None = None
) -> Axes:
    """Energy relative to the start [-] over time [s], a line for each name."""
    with style():
        ax = axes(ax)
        for i, (name, (time, energy)) in enumerate(series.items()):
            ax.plot(time, energy, label=name, marker="", ls=LINES[i % 4])
        ax.set(xlabel="time [s]", ylabel="energy / energy at the start")
        ax.legend()
    ends = "; ".join(
        f"{name} ends at {energy[-1]:.3f}" for name, (_, energy) in series.items()
    )
    describe(ax, f"Energy of a bouncing ball over time, relative to its start. {ends}.")
    return ax
