"""Pictures of the contact matrix: a table that is pushed, the pattern of A, and what A costs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from course.arrays import Array
from course.contact import contact_jacobian
from course.formulas import point_response
from course.study.resting_layouts import RestingScene
from course.study.resting_scenes import table
from course.workbook.plots.figure import PALETTE, axes, describe, side_by_side, style

MARKERS = "os^DvP"
LINES = ("-", "--", "-.", ":")
HALF_WIDTHS = (0.5, 0.3)


def pushed_table(
    x: float = 0.5,
    y: float = 0.3,
    offset_x: float = 0.1,
    offset_y: float = 0.05,
    *,
    answer: bool = True,
    ax: Axes | None = None,
) -> Axes:
    """The table of 1 kg from above, pushed up from below with 1 N at (x, y): how its four feet begin to move.

    The dashed line is where nothing moves at first. The offsets are those of the centre of mass from the middle, all
    lengths in m. Without ``answer`` only the push is shown; with ``ax`` only the picture from above.
    """
    scene = table(offset=(offset_x, offset_y), half_widths=HALF_WIDTHS)
    response, (bodies, feet) = (
        _lift(scene, np.array([x, y])),
        (scene.bodies, scene.contacts.point),
    )
    with style():
        bars = None
        if ax is None and answer:
            _, (ax, bars) = plt.subplots(1, 2, figsize=(9.6, 3.9), width_ratios=(3, 2))
        ax = axes(ax, size=(6.4, 3.9))
        _table_from_above(ax, feet, bodies.position[0, :2])
        if answer:
            _still_line(ax, scene, np.array([x, y]))
            _moving_feet(ax, feet, response)
        ax.plot(
            x,
            y,
            ls="none",
            marker="*",
            ms=15,
            mfc=PALETTE["orange"],
            mec="black",
            label="pushed up with 1 N",
        )
        ax.set(
            xlim=(-0.85, 0.85),
            ylim=(-0.52, 0.52),
            aspect="equal",
            xlabel="x [m]",
            ylabel="y [m]",
        )
        ax.legend(
            loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2, labelspacing=0.8
        )
        if bars is not None:
            _response_bars(bars, response)
    spoken = ""
    if answer:
        spoken = f" The feet are accelerated by {', '.join(f'{v + 0.0:+.2f}' for v in response)} m/s^2, 1 to 4."
    describe(
        ax,
        f"A table of 1 kg on four feet, from above, its centre of mass at ({offset_x:g}, {offset_y:g}) m from the "
        f"middle. It is pushed up with 1 N at ({x:g}, {y:g}) m.{spoken}",
    )
    return ax


def matrix_pattern(scene: RestingScene, *, ax: Axes | None = None) -> Axes:
    """Where J and A of a scene are not 0, and with which sign; with ``ax`` A alone."""
    a = scene.system().A.toarray()
    factors = contact_jacobian(scene.bodies, scene.contacts).toarray()
    with style():
        if ax is None:
            _, (left, ax) = side_by_side(2, size=(10.4, 4.4))
            _signs(left, factors, "J", "column: 6 for each body")
        _signs(ax, a, "A = J M⁻¹ J'", "contact that is pushed")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), markerscale=2.5)
    full = np.count_nonzero(a) / a.size
    describe(
        ax,
        f"{scene.name}: the pattern of J, {factors.shape[0]} by {factors.shape[1]}, and of A, {len(a)} by {len(a)}, "
        f"positive and negative entries. {100 * full:.0f} percent of A is not 0: only contacts that share a body that "
        "can move.",
    )
    return ax


def matrix_costs(
    contacts: Mapping[str, Sequence[float]],
    seconds: Mapping[str, Sequence[float]],
    counts: Mapping[str, Sequence[float]],
) -> Axes:
    """Seconds and counted multiplications over the number of contacts.

    The counts come with the exponent fitted to their end; that of seconds differs from machine
    to machine, so they are told as they were measured.
    """
    with style():
        _, panels = side_by_side(2, size=(10.4, 4.0))
        spoken = []
        for ax, values, label in zip(
            panels, (seconds, counts), ("time [s]", "multiplications"), strict=True
        ):
            for k, (name, y) in enumerate(values.items()):
                x = np.asarray(contacts[name], dtype=float)
                power = np.polyfit(np.log(x[-3:]), np.log(np.asarray(y)[-3:]), 1)[0]
                counted = values is counts
                named = f"{name}: c^{power:.1f}" if counted else name
                ax.loglog(x, y, marker=MARKERS[k], ls=LINES[k % 4], label=named)
                ends = (
                    f"from {y[0]:.2g} at {x[0]:g} to {y[-1]:.2g} at {x[-1]:g} contacts"
                )
                spoken.append(f"{name} {label} {f'c^{power:.1f}' if counted else ends}")
            ax.set(xlabel="contacts c", ylabel=label)
            ax.legend(loc="upper left")
            low, high = ax.get_ylim()
            ax.set_ylim(low, high * 30)  # room for the legend
    describe(
        panels[0],
        f"Cost of making A over the number of contacts, both axes logarithmic: {'; '.join(spoken)}.",
    )
    return panels[0]


def _lift(scene: RestingScene, place: Array) -> Array:
    """d_ddot of each foot by 1 N upward at a place of the table, (c,)."""
    bodies, up = scene.bodies, np.array([0, 0, 1.0])
    push_arm = np.array([*place, 0.0]) - bodies.position[0]
    inverse = bodies.world_inverse_inertia[0]
    arms = scene.contacts.point - bodies.position[0]
    return np.array(
        [point_response(bodies.mass[0], inverse, arm, push_arm, up)[2] for arm in arms]
    )


def _table_from_above(ax: Axes, feet: Array, centre: Array) -> None:
    """The table with its numbered feet and its centre of mass."""
    low, size = feet[:, :2].min(axis=0) - 0.08, np.ptp(feet[:, :2], axis=0) + 0.16
    ax.add_patch(Rectangle(tuple(low), *size, fc="0.93", ec="0.3"))
    ax.plot(*feet[:, :2].T, ls="none", marker="o", ms=6, mfc="white", mec="0.3")
    for k, foot in enumerate(feet):
        inward = (-16 * np.sign(foot[0]), 0)
        ax.annotate(
            str(k + 1),
            foot[:2],
            inward,
            textcoords="offset points",
            ha="center",
            va="center",
        )
    ax.plot(
        *centre,
        ls="none",
        marker="P",
        ms=10,
        mfc="white",
        mec="black",
        label="centre of mass",
    )
    ax.grid(False)


def _still_line(ax: Axes, scene: RestingScene, place: Array) -> None:
    """1/m + r_y p_y/I_x + r_x p_x/I_y = 0, where the principal axes are x and y: what it begins to turn about."""
    bodies = scene.bodies
    centre, inverse = bodies.position[0, :2], bodies.world_inverse_inertia[0]
    slope = (place - centre) * np.array([inverse[1, 1], inverse[0, 0]])
    size = float(slope @ slope)
    if size < 1e-9:
        return
    nearest, along = (
        centre - slope / (bodies.mass[0] * size),
        np.array([-slope[1], slope[0]]) / np.sqrt(size),
    )
    ends = nearest + np.array([[-3.0], [3.0]]) * along
    ax.plot(
        *ends.T, color="black", lw=1.4, ls="--", marker="", label="not moved at first"
    )


def _moving_feet(ax: Axes, feet: Array, response: Array) -> None:
    """The feet that begin to rise and those that are driven down; one that feels nothing keeps its plain mark."""
    for chosen, mark, colour, word in (
        (response > 1e-9, "^", "blue", "begins to rise"),
        (response < -1e-9, "v", "vermillion", "is driven down"),
    ):
        if chosen.any():
            place = feet[chosen, :2].T
            ax.plot(
                *place,
                ls="none",
                marker=mark,
                ms=13,
                color=PALETTE[colour],
                label=f"foot {word}",
            )


def _response_bars(ax: Axes, response: Array) -> None:
    for k, value in enumerate(response):
        up = value > 0
        ax.bar(
            k,
            value,
            color=PALETTE["blue" if up else "vermillion"],
            hatch="" if up else "//",
            ec="white",
        )
        ax.annotate(f"{value + 0.0:+.2f}", (k, value), (0, 3 if up else -3), textcoords="offset points", ha="center",
                    va="bottom" if up else "top")  # fmt: skip
    ax.axhline(0, color="0.3", lw=0.8)
    reach = max(1.0, float(np.abs(response).max()))
    ax.set_xticks(range(4), [f"foot {k + 1}" for k in range(4)])
    ax.set(ylabel="acceleration upward [m/s²]", ylim=(-1.2 * reach, 1.2 * reach))
    ax.grid(axis="x", visible=False)


def _signs(ax: Axes, matrix: Array, title: str, columns: str) -> None:
    size = max(1.2, 160 / max(matrix.shape))
    for positive, mark, colour in ((True, "s", "blue"), (False, "x", "vermillion")):
        rows, places = np.nonzero(matrix > 0 if positive else matrix < 0)
        ax.plot(
            places + 1,
            rows + 1,
            ls="none",
            marker=mark,
            ms=size,
            color=PALETTE[colour],
            label="above 0" if positive else "below 0",
        )
    ax.set(
        xlim=(0, matrix.shape[1] + 1),
        ylim=(matrix.shape[0] + 1, 0),
        xlabel=columns,
        ylabel="contact",
        title=title,
    )
    ax.grid(False)
