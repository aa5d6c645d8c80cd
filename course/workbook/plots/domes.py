"""Pictures of a particle on a dome: where it leaves, and what is counted twice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from course.arrays import ArrayLike
from course.dynamics import DomeBias, DomePaths
from course.study import OldPoint
from course.workbook.plots.figure import (
    PALETTE,
    arrow,
    axes,
    describe,
    legend_beside,
    line,
    style,
)

#: The formulas of the second rate of the gap, as legends write them.
TRUE, PRINTED = r"$v^2/R - g\,\cos\varphi$", r"$2\,v^2/R - g\,\cos\varphi$"
OVER_THE_PLANE = r"$-g\,\cos\varphi$"


def dome(paths: DomePaths, *, ax: Axes | None = None) -> Axes:
    """A dome and a particle on it: where it leaves, in nature and as printed.

    An inset looks closer where the path of the printed formula runs deepest inside the
    dome.
    """
    radius, (y, z) = paths.radius, paths.deepest
    with style():
        ax = axes(ax, size=(8.2, 3.6))
        near = ax.inset_axes((1.13, 0.0, 0.5, 0.74))
        for part in (ax, near):
            _dome_paths(part, paths)
        ax.set(xlim=(-0.35 * radius, 1.25 * radius), ylim=(0, 1.1 * radius))
        half = 0.11 * radius
        near.set(xlim=(y - half, y + half), ylim=(z - half, z + half), aspect="equal")
        near.tick_params(labelsize=8)
        near.locator_params(nbins=4)
        ax.set(aspect="equal", xlabel="y [m]", ylabel="z [m]")
        ax.indicate_inset_zoom(near, edgecolor="0.4")
        ax.legend(loc="upper left", bbox_to_anchor=(1.05, 1.02))
    describe(
        ax,
        f"A dome of radius {radius:g} m. A particle slides down from its top on the "
        f"right. In nature it leaves {np.degrees(paths.leaving):.1f} degrees from the "
        "top and flies off; by the printed formula it leaves already at "
        f"{np.degrees(paths.leaving_as_printed):.1f} degrees and flies inside the "
        f"dome, up to {1000 * paths.depth:.0f} mm deep, until it comes out at "
        f"z = {paths.out[1]:.2f} m. An inset shows this larger.",
    )
    return ax


def _dome_paths(ax: Axes, paths: DomePaths) -> None:
    """The dome, the way down it, and both flights with the radii where they begin."""
    ax.add_patch(Circle((0, 0), paths.radius, fc="0.9", ec="0.3"))
    line(ax, paths.slide, "blue", lw=2.4)
    for angle, flight, colour, dashes, mark, name in (
        (paths.leaving, paths.flight, "blue", "-", "o", "nature"),
        (paths.leaving_as_printed, paths.flight_as_printed, "vermillion", "--", "s",
         "as printed"),
    ):  # fmt: skip
        line(ax, flight, colour, lw=1.8, ls=dashes)
        look: dict[str, Any] = {"color": PALETTE[colour], "ls": dashes, "ms": 8}
        label = f"{name}: leaves at {np.degrees(angle):.1f}°"
        ax.plot(*flight[0], marker=mark, label=label, **look)
        line(ax, [(0, 0), flight[0]], colour, lw=1.0, ls=":")
    line(ax, [(0, 0), (0, paths.radius)], "0.5", lw=1.0, ls=":")


def dome_bias(
    curves: DomeBias,
    angles: ArrayLike,
    measured: Mapping[str, ArrayLike],
    *,
    ax: Axes | None = None,
) -> Axes:
    """The second rate of the gap without a force, over the angle.

    Points are measured; up to three formulas are lines.

    Args:
        curves: of the formulas.
        angles: of the points, (k,) [rad].
        measured: name -> (k,) [m/s^2], in this order: of the gap itself, from the old
            point, over the old plane.
    """
    formulas = ((curves.true, TRUE, "-"), (curves.as_printed, PRINTED, "--"),
                (curves.over_the_plane, OVER_THE_PLANE, "-."))  # fmt: skip
    points, theta = np.degrees(angles), np.degrees(curves.angle)
    with style():
        ax = axes(ax, size=(7.6, 4.2))
        for (name, values), (height, word, dashes), mark, colour in zip(
            measured.items(), formulas, "os^", ("blue", "vermillion", "green"),
            strict=False,
        ):  # fmt: skip
            look: dict[str, Any] = {"marker": mark, "color": PALETTE[colour]}
            ax.plot(points, np.asarray(values), ls="none", label=name, **look)
            curve = np.stack([theta, height], axis=-1)
            line(ax, curve, colour, ls=dashes, lw=1.4, label=word)
        ax.axhline(0, color="0.3", lw=1.0)
        left = np.degrees([curves.leaving, curves.leaving_as_printed])
        for degrees, colour in zip(left, ("blue", "vermillion"), strict=True):
            ax.axvline(degrees, color=PALETTE[colour], lw=1.0, ls=":")
            said = f"{degrees:.2f}°"
            ax.text(degrees + 0.7, 14.0, said, color=PALETTE[colour], va="center")
        ax.set(xlabel="angle from the top [degrees]", ylim=(-11, 16))
        ax.set_ylabel("second rate of the gap [m/s²]")
        legend_beside(ax)
    describe(
        ax,
        "Second rate of the gap of a particle let go on a dome, over its angle, as "
        f"measured by {', '.join(measured)}, on lines that the formulas predict. The "
        f"true one crosses 0 at {left[0]:.2f} degrees, the one from the old point at "
        f"{left[1]:.2f}.",
    )
    return ax


def old_point(result: OldPoint, *, ax: Axes | None = None) -> Axes:
    """A particle let go on a dome of 1 m, a moment ahead, with two gaps.

    One is the gap to the dome, the other is taken from the point that was touched.
    """
    path, n, bias = result.path, result.normal, result.bias
    touched, p = path[0], path[-1]
    half = max(0.08, 0.75 * float(np.linalg.norm(p - touched)))
    with style():
        ax = axes(ax, size=(7.8, 4.2))
        ax.add_patch(Circle((0, 0), 1.0, fc="0.9", ec="0.3"))
        label = "flight without a contact force"
        line(ax, path, "0.4", lw=1.2, ls=":", label=label)
        _both_gaps(ax, result, half)
        look: dict[str, Any] = {"color": PALETTE["vermillion"], "ls": "none"}
        label = "point of the dome touched at 0 s"
        ax.plot(*touched, marker="s", ms=8, label=label, **look)
        place = f"particle after {result.ahead:.2f} s"
        ax.plot(*p, marker="o", ms=5, color="black", ls="none", zorder=5, label=place)
        from_p, to = p + 0.08 * half * n, p + 0.5 * half * n
        arrow(ax, from_p, to, label="N", beyond=0.1 * half, lw=1.4)
        y, z = 0.5 * (p + touched)
        ax.set(xlim=(y - half, y + half), ylim=(z - half, z + half))
        ax.set(aspect="equal", anchor="W", xlabel="y [m]", ylabel="z [m]")
        legend_beside(ax)
        word = "the dome lets it go" if bias > 0 else "without a force it sinks in"
        ax.set_title(f"at {result.angle:.0f}°: b = {bias:+.1f} m/s², {word}")
    describe(
        ax,
        f"A particle on a dome of 1 m is let go {result.angle:.0f} degrees from the "
        f"top at {result.speed:.2f} m/s. {result.ahead:.2f} s later its gap to the dome is "
        f"{1000 * result.gap:.1f} mm; measured along its new normal from the point it "
        f"touched before, {1000 * result.from_old_point:.1f} mm.",
    )
    return ax


def _both_gaps(ax: Axes, result: OldPoint, half: float) -> None:
    """The gap to the dome, and beside it that from the level of the old point."""
    n, old = result.normal, result.from_old_point
    touched, p = result.path[0], result.path[-1]
    across = np.array([n[1], -n[0]])
    reach, aside = 0.34 * half * across, 0.26 * half * across
    foot = p - old * n  # as high as the old point
    label = "through the {}, at right angles to N"
    level = [touched - 0.1 * half * across, foot + reach]
    for ends, dashes, name in (
        (level, ":", "old point"),
        ([p, p + reach], "-.", "particle"),
    ):
        line(ax, ends, "vermillion", lw=1.0, ls=dashes, label=label.format(name))
    said = f"gap to the dome: {1000 * result.gap:.1f} mm"
    line(ax, [n, p], "blue", lw=3, zorder=4, label=said)
    said = f"gap from the old point: {1000 * old:.1f} mm"
    line(ax, [foot + aside, p + aside], "vermillion", lw=2.4, ls="--", label=said)
