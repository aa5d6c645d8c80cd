"""Pictures of accelerating gaps: a particle on a dome, what is counted twice there, and
the terms of b.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from course.arrays import ArrayLike
from course.dynamics import Dome
from course.study import OldPoint
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    describe,
    legend_beside,
    style,
)

#: The terms of b that a contact of a face can have where the bodies touch.
TERMS = {
    "force": "force",
    "torque": "torque",
    "spin": "L x omega",
    "centripetal": "centripetal",
    "normal": "turning normal",
}


def dome(scene: Dome, *, ax: Axes | None = None) -> Axes:
    """A dome, the particle on it, where it leaves and where the printed formula lets it
    leave; an inset looks closer.

    The inset shows where the path of the printed formula runs deepest inside the dome.
    """
    true, printed = scene.leaving_angle, scene.leaving_angle_as_printed
    depth, there, out = scene.dive(printed)
    with style():
        ax = axes(ax, size=(8.2, 3.6))
        near = ax.inset_axes((1.13, 0.0, 0.5, 0.74))
        for part in (ax, near):
            _dome_paths(part, scene)
        ax.set(
            xlim=(-0.35 * scene.radius, 1.25 * scene.radius),
            ylim=(0, 1.1 * scene.radius),
            aspect="equal",
        )
        (y, z), half = there, 0.11 * scene.radius
        near.set(xlim=(y - half, y + half), ylim=(z - half, z + half), aspect="equal")
        near.tick_params(labelsize=8)
        near.locator_params(nbins=4)
        ax.indicate_inset_zoom(near, edgecolor="0.4")
        ax.set(xlabel="y [m]", ylabel="z [m]")
        ax.legend(loc="upper left", bbox_to_anchor=(1.05, 1.02))
    describe(
        ax,
        f"A dome of radius {scene.radius:g} m. A particle slides down from its top on the right. In nature it leaves "
        f"{np.degrees(true):.1f} degrees from the top and flies off; by the printed formula it leaves already at "
        f"{np.degrees(printed):.1f} degrees and flies inside the dome, up to {1000 * depth:.0f} mm deep, until it "
        f"comes out at z = {out[1]:.2f} m. An inset shows this larger.",
    )
    return ax


def _dome_paths(ax: Axes, scene: Dome) -> None:
    true, printed = scene.leaving_angle, scene.leaving_angle_as_printed
    ax.add_patch(Circle((0, 0), scene.radius, fc="0.9", ec="0.3"))
    slid = scene.radius * _out(np.linspace(scene.start, true, 50))
    ax.plot(*slid.T, color=PALETTE["blue"], lw=2.4, ls="-", marker="")
    drop = np.sqrt(2 * scene.radius / scene.gravity)
    for angle, colour, line, mark, name in (
        (true, "blue", "-", "o", "nature"),
        (printed, "vermillion", "--", "s", "as printed"),
    ):
        path = scene.flight(angle, np.linspace(0, 1.2 * drop, 60))
        ax.plot(*path.T, color=PALETTE[colour], lw=1.8, ls=line, marker="")
        foot = scene.radius * _out(angle)
        label = f"{name}: leaves at {np.degrees(angle):.1f}°"
        ax.plot(*foot, color=PALETTE[colour], ls=line, marker=mark, ms=8, label=label)
        ax.plot(
            [0, foot[0]], [0, foot[1]], color=PALETTE[colour], lw=1.0, ls=":", marker=""
        )
    ax.plot([0, 0], [0, scene.radius], color="0.5", lw=1.0, ls=":", marker="")


def dome_bias(
    scene: Dome,
    angles: ArrayLike,
    measured: Mapping[str, ArrayLike],
    *,
    ax: Axes | None = None,
) -> Axes:
    """The second rate of the gap without a force over the angle: measured points, and
    up to three formulas as lines.

    ``measured`` holds the values at ``angles`` [rad] of the gap itself, then those from
    the old point, then those from the old plane, under any names.
    """
    theta = np.linspace(scene.start, np.radians(70), 200)
    formulas = (
        (scene.bias(theta), r"$v^2/R - g\,\cos\varphi$"),
        (scene.bias_as_printed(theta), r"$2\,v^2/R - g\,\cos\varphi$"),
        (-scene.gravity * np.cos(theta), r"$-g\,\cos\varphi$"),
    )
    with style():
        ax = axes(ax, size=(7.6, 4.2))
        colours = ("blue", "vermillion", "green")
        for (name, values), (height, word), mark, line, colour in zip(
            measured.items(), formulas, "os^", ("-", "--", "-."), colours, strict=False
        ):
            there = np.degrees(angles), np.asarray(values)
            ax.plot(*there, ls="none", marker=mark, color=PALETTE[colour], label=name)
            ax.plot(
                np.degrees(theta),
                height,
                color=PALETTE[colour],
                ls=line,
                marker="",
                lw=1.4,
                label=word,
            )
        ax.axhline(0, color="0.3", lw=1.0)
        for angle, colour in (
            (scene.leaving_angle, "blue"),
            (scene.leaving_angle_as_printed, "vermillion"),
        ):
            ax.axvline(np.degrees(angle), color=PALETTE[colour], lw=1.0, ls=":")
            ax.text(
                np.degrees(angle) + 0.7,
                14.0,
                f"{np.degrees(angle):.2f}°",
                color=PALETTE[colour],
                va="center",
            )
        ax.set(
            xlabel="angle from the top [degrees]",
            ylabel="second rate of the gap [m/s²]",
            ylim=(-11, 16),
        )
        legend_beside(ax)
    true, printed = (
        np.degrees(scene.leaving_angle),
        np.degrees(scene.leaving_angle_as_printed),
    )
    describe(
        ax,
        "Second rate of the gap of a particle let go on a dome, over its angle, as measured by "
        f"{', '.join(measured)}, on lines that the formulas predict. The true one crosses 0 at {true:.2f} degrees, "
        f"the one from the old point at {printed:.2f}.",
    )
    return ax


def old_point(result: OldPoint, *, ax: Axes | None = None) -> Axes:
    """A particle let go on a dome of 1 m, a moment ahead: its gap, and the gap from the point that was touched."""
    path, n, ahead, bias = result.path, result.normal, result.ahead, result.bias
    true, old, p_b, p = result.gap, result.from_old_point, path[0], path[-1]
    half = max(0.08, 0.75 * float(np.linalg.norm(p - p_b)))
    with style():
        ax = axes(ax, size=(7.8, 4.2))
        ax.add_patch(Circle((0, 0), 1.0, fc="0.9", ec="0.3"))
        ax.plot(
            *path.T,
            color="0.4",
            lw=1.2,
            ls=":",
            marker="",
            label="flight without a contact force",
        )
        _both_gaps(ax, p, p_b, n, (true, old), half)
        touched = "point of the dome touched at 0 s"
        ax.plot(
            *p_b,
            marker="s",
            ms=8,
            color=PALETTE["vermillion"],
            ls="none",
            label=touched,
        )
        place = f"particle after {ahead:.2f} s"
        ax.plot(*p, marker="o", ms=5, color="black", ls="none", zorder=5, label=place)
        from_p, to = p + 0.08 * half * n, p + 0.5 * half * n
        arrow(ax, from_p, to, label="N", beyond=0.1 * half, lw=1.4)
        y, z = 0.5 * (p + p_b)
        ax.set(
            xlim=(y - half, y + half),
            ylim=(z - half, z + half),
            aspect="equal",
            anchor="W",
        )
        ax.set(xlabel="y [m]", ylabel="z [m]")
        legend_beside(ax)
        word = "the dome lets it go" if bias > 0 else "without a force it sinks in"
        ax.set_title(f"at {result.angle:.0f}°: b = {bias:+.1f} m/s², {word}")
    describe(
        ax,
        f"A particle on a dome of 1 m is let go {result.angle:.0f} degrees from the top at {result.speed:.2f} "
        f"m/s. {ahead:.2f} s later its gap to the dome is {1000 * true:.1f} mm; measured along its new normal from the "
        f"point it touched before, {1000 * old:.1f} mm.",
    )
    return ax


def _both_gaps(
    ax: Axes,
    p: np.ndarray,
    p_b: np.ndarray,
    n: np.ndarray,
    gaps: tuple[float, float],
    half: float,
) -> None:
    """The gap of a particle at p to a dome of 1 m, and beside it that from the level of
    the old point p_b.
    """
    across, (true, old) = np.array([n[1], -n[0]]), gaps
    reach, aside = 0.34 * half * across, 0.26 * half * across
    look: dict[str, Any] = {
        "color": PALETTE["vermillion"],
        "lw": 1.0,
        "ls": ":",
        "marker": "",
    }
    level = np.stack([p_b - 0.1 * half * across, p - old * n + reach])
    ax.plot(*level.T, label="through the old point, at right angles to N", **look)
    ax.plot(
        *np.stack([p, p + reach]).T,
        label="through the particle, at right angles to N",
        **look | {"ls": "-."},
    )
    label = f"gap to the dome: {1000 * true:.1f} mm"
    ax.plot(
        *np.stack([n, p]).T,
        color=PALETTE["blue"],
        lw=3,
        ls="-",
        marker="",
        zorder=4,
        label=label,
    )
    label = f"gap from the old point: {1000 * old:.1f} mm"
    beside = np.stack([p - old * n, p]) + aside
    ax.plot(
        *beside.T, color=PALETTE["vermillion"], lw=2.4, ls="--", marker="", label=label
    )


def bias_terms(
    terms: Mapping[str, ArrayLike],
    labels: Sequence[str],
    *,
    unit: str = "m/s²",
    ax: Axes | None = None,
) -> Axes:
    """The terms of b of up to four contacts side by side, and their sum.

    ``terms`` are those of ``course.contact.separation_acceleration_terms``, (c,) each;
    ``labels`` name the contacts.
    """
    values = {
        word: np.asarray(terms[name], dtype=float) for name, word in TERMS.items()
    }
    total = np.sum([np.asarray(v, dtype=float) for v in terms.values()], axis=0)
    with style():
        ax = axes(ax, size=(8.4, 5.4))
        places, width = np.arange(len(values) + 1), 0.84 / len(labels)
        for row, (name, colour, hatch) in enumerate(
            zip(
                labels,
                ("blue", "vermillion", "green", "purple"),
                ("", "//", "..", "xx"),
                strict=False,
            )
        ):
            heights = [*(v[row] for v in values.values()), total[row]]
            shift = (row - 0.5 * (len(labels) - 1)) * width
            bars = ax.barh(
                places + shift,
                heights,
                width,
                color=PALETTE[colour],
                hatch=hatch,
                ec="white",
                label=name,
            )
            numbers = [f"{height + 0.0:.2f}" for height in heights]
            ax.bar_label(bars, numbers, fontsize=9, padding=2)
        ax.axvline(0, color="0.3", lw=0.8)
        ax.margins(x=0.1)  # room for the numbers at the bars
        ax.set_yticks(places, [*values, "sum: b"])
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


def _out(angle: float | np.ndarray) -> np.ndarray:
    return np.stack([np.sin(angle), np.cos(angle)], axis=-1)
