"""Pictures of a ball and a wall: the reflection, the bounces in time, the published
energy errors.
"""

from __future__ import annotations

from collections.abc import Mapping

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
    style,
)


def reflection(result: WallReflection, *, ax: Axes | None = None) -> Axes:
    """A ball meeting a wall in the plane: velocity before and after, each split along and across the normal."""
    normal, along = result.normal, result.along
    before, after, none = result.before, result.after, np.zeros(3)
    with style():
        ax = axes(ax, size=(5.6, 4.6))
        ends = np.outer([-3.0, 3.0], along)  # beyond the frame at every angle
        ax.plot(ends[:, 0], ends[:, 1], color="0.25", lw=3, ls="-", marker="")
        ax.fill(
            *np.vstack([ends, ends[::-1] - 0.25 * normal])[:, :2].T,
            color="0.88",
            lw=0,
            zorder=0,
        )
        arrow(ax, -before, none, "blue", label="v before", beyond=-0.2, lw=2.4)
        arrow(ax, none, after, "vermillion", label="v after", beyond=0.2, lw=2.4)
        arrow(ax, none, 0.5 * normal, lw=1.4)
        # Beside its arrow, on the side the ball leaves to: the dotted parts of the
        # velocity before run along n on the other.
        beside = 0.12 if np.sum(after * along) >= 0 else -0.12
        x, y, _ = 0.45 * normal + beside * along
        ax.text(x, y, "n", ha="center", va="center")
        for tail, tip, colour in (
            (-before, none, "blue"),
            (none, after, "vermillion"),
        ):
            corner = (
                tail + np.sum((tip - tail) * along) * along
            )  # first along the wall, then along n
            path = np.array([tail, corner, tip])[:, :2] + 0.02 * normal[:2]
            ax.plot(*path.T, color=PALETTE[colour], lw=1.8, ls=":", marker="")
        ax.set(
            xlim=(-1.57, 1.57),
            ylim=(-1.3, 1.3),
            aspect="equal",
            xlabel="x [m/s]",
            ylabel="y [m/s]",
        )
        come, leave = (
            round(float(np.sum(v * normal)), 2) + 0.0 for v in (before, after)
        )  # no -0.00
        told = (
            f"{come:+.2f} m/s before, {leave:+.2f} m/s after"
            if come < 0
            else f"{leave:+.2f} m/s, no bounce"
        )
        ax.set_title(f"Along n: {told}".replace("-", "\N{MINUS SIGN}"))
    describe(
        ax,
        f"A wall at {result.wall_angle:.0f} degrees and a ball at 1 m/s going at {result.incoming_angle:.0f} degrees, "
        f"e = {result.restitution:.2f}. Along the normal its speed is {come:.2f} m/s before and {leave:.2f} m/s after; "
        "along the wall it does not change.",
    )
    return ax


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
            ax.plot(
                motion.time,
                motion.height,
                label=name,
                marker="",
                ls=LINES[i % 4],
            )
        if rest is not None:
            ax.axvline(
                rest,
                color=PALETTE["blue"],
                ls=":",
                lw=1.2,
                label=f"at rest: {rest:.4f} s",
            )
        ax.set(xlabel="time [s]", ylabel="height [m]")
        ax.legend(loc="upper right")
    end = f" The ball is at rest from {rest:.4f} s on." if rest is not None else ""
    describe(ax, f"Height of a bouncing ball over time: {', '.join(motions)}.{end}")
    return ax


def bouncing_errors(errors: BouncingErrors, *, ax: Axes | None = None) -> Axes:
    """The 49 balls' energy error over the step size: ours, the published figures, and
    the event-driven ball's.
    """
    with style():
        ax = axes(ax, size=(7.6, 4.6))
        published = PUBLISHED_BOUNCING
        for ours, line, colour, name in (
            (errors.bullet, "-", "vermillion", "gravity, then reflect"),
            (errors.ode, "--", "blue", "reflect, or else gravity"),
        ):
            ax.loglog(
                errors.step, ours, line, color=PALETTE[colour], marker="", label=name
            )
        for values, marker, colour, name in (
            (published.bullet_error, "s", "vermillion", "Bullet, published"),
            (published.dart_error, "D", "purple", "DART, published"),
            (published.ode_error, "o", "blue", "ODE, published"),
            (
                published.raisim_error,
                "^",
                "green",
                "RaiSim (error reduction on), published",
            ),
        ):
            ax.loglog(
                published.step,
                values,
                ls="none",
                marker=marker,
                mfc="none",
                color=PALETTE[colour],
                label=name,
            )
        low = 1e-3 * float(
            min(errors.ode)
        )  # the event-driven ball, 20 powers of ten lower, would squeeze the rest
        told = f"event-driven, {errors.events} events:\nat {errors.event_driven.max():.0e}, below the picture"
        ax.plot(errors.step, np.full(errors.step.shape, 2 * low), ls="none", marker="v", ms=5, color=PALETTE["black"],
                label=told)  # fmt: skip
        ax.set_ylim(low, None)
        ax.set(
            xlabel="step [s]",
            ylabel="mean squared energy error [J²]",
            title="49 balls, 20 s, nothing lost",
        )
        legend_beside(ax)
    describe(
        ax,
        "Mean squared energy error of 49 bouncing balls over the step size, both logarithmic. The loop that reflects "
        "or else falls lies on the published figures of ODE, the loop that lets gravity act first on those of "
        "Bullet, hundreds of times higher; both rise with the square of the step. The event-driven ball stays at "
        "rounding level.",
    )
    return ax


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
