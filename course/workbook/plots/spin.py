"""Pictures of impacts that make bodies turn: a rod on a peg or on the floor, a box on its four corners."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

from course.contact import resolve_collisions
from course.dynamics.bodies import Bodies
from course.dynamics.energy import total_energy
from course.dynamics.impulse import effective_mass, point_velocity
from course.study.spinning_impacts import OrderOutcomes, falling_rods
from course.workbook.plots.figure import PALETTE, axes, describe, style

ARROW = 0.22  # metres of picture for a speed of 1 m/s
LABELS = {  # where a speed is written: right and up of the point, and its alignment
    -1.0: (-0.08, 0.05, "right", "bottom"),
    0.0: (0.09, 0.05, "left", "bottom"),
    1.0: (0.09, -0.04, "left", "top"),
}
COLOURS = ("blue", "vermillion", "green", "purple", "orange")
HATCHES = ("", "//", "..", "xx", "\\\\")
PIN = 0.45  # how far the lower end stands above the floor


def rod_on_pegs(*, ax: Axes | None = None) -> Axes:
    """The scene of the question: a rod that falls flat on a peg under its middle, and on one under its end."""
    with style():
        ax = axes(ax, size=(8.4, 2.9))
        for middle, peg, impulse, words in (
            (-0.85, 0.0, "2", "middle"),
            (0.85, 0.5, "0.5", "end"),
        ):
            ax.plot([middle - 0.5, middle + 0.5], [0.04, 0.04], color=PALETTE["blue"], lw=7, ls="-", marker="",
                    solid_capstyle="butt")  # fmt: skip
            for x in (-0.4, 0.0, 0.4):
                _arrow(ax, (middle + x, 0.42), (middle + x, 0.42 - ARROW), "blue")
            x = middle + peg
            ax.add_patch(
                Polygon(
                    [(x - 0.07, -0.34), (x + 0.07, -0.34), (x, 0.0)],
                    fc="0.75",
                    ec="0.3",
                )
            )
            ax.text(
                x, -0.4, f"peg under its {words}: {impulse} N s", ha="center", va="top"
            )
        ax.text(-0.05, 0.28, "1 m/s", ha="center", va="center")
        ax.plot([-1.6, 1.95], [-0.34, -0.34], color="0.3", lw=1.2, marker="", ls="-")
        ax.set(xlim=(-1.65, 2.0), ylim=(-0.6, 0.5), aspect="equal")
        _bare(ax)
    describe(
        ax,
        "Two equal rods fall flat at 1 m/s, the left one on a fixed peg under its middle, which gives it 2 N s, the "
        "right one on a fixed peg under its end, which gives it 0.5 N s.",
    )
    return ax


def rod_impact(
    angle: float, restitution: float, place: float, *, ax: Axes | None = None
) -> Axes:
    """A rod of 1 kg and 1 m that falls at 1 m/s, before and after the floor hits it at one point.

    Args:
        angle: of the rod, from the horizontal [degrees]; the lower end is on the right.
        restitution: e.
        place: 1 the lower end, 0 the middle, -1 the upper end; there a light pin stands down to the floor.
    """
    before, contact = falling_rods(np.radians(angle), place=place)
    after = resolve_collisions(before, contact, restitution)
    axis = before.rotation[0, :, 0]
    push = float(after.momentum[0, 2] - before.momentum[0, 2])
    felt, kept = (
        float(effective_mass(before, contact)[0]),
        total_energy(after) / total_energy(before),
    )
    floor = 0.5 * axis[2] - PIN
    with style():
        ax = axes(ax, size=(8.8, 4.5))
        ax.add_patch(
            Rectangle(
                (-2.2, floor - 0.08), 4.5, 0.08, fc="0.88", ec="none", hatch="///"
            )
        )
        ax.plot([-2.2, 2.3], [floor, floor], color="0.3", lw=1.2, marker="", ls="-")
        for middle, state, words in ((-1.1, before, "before"), (1.1, after, "after")):
            _rod(ax, middle, axis, place, floor, state)
            ax.text(middle, 1.12, words, ha="center", va="top", fontweight="bold")
        spin = float(after.angular_velocity[0, 1])
        way = (
            "" if abs(spin) < 5e-3 else ", anticlockwise" if spin < 0 else ", clockwise"
        )
        ax.text(1.1, 0.98, f"spin {abs(spin):.2f} rad/s{way}\nenergy kept: {100 * kept:.0f} %", ha="center", va="top",
                fontsize=9.5)  # fmt: skip
        ax.text(-1.1, 0.98, f"m = 1 kg\nmass felt at the point: {felt:.3f} kg", ha="center", va="top",
                fontsize=9.5)  # fmt: skip
        ax.set(xlim=(-2.2, 2.3), ylim=(-1.1, 1.15), aspect="equal")
        ax.set_title(
            f"impulse of the floor {push:.3f} N s; at the points: upward speeds [m/s]"
        )
        _bare(ax)
    speeds = after.velocity[0, 2]
    describe(
        ax,
        f"A rod of 1 kg, 1 m long, {angle:.3g} degrees from the horizontal, falls at 1 m/s and is hit from below at "
        f"{place:.2f} of the way from its middle to its lower end, e = {restitution:.2f}. It feels as heavy as "
        f"{felt:.3f} kg there; the impulse is {push:.3f} N s. Afterwards its middle moves at {speeds:+.2f} m/s upward "
        f"and it turns at {abs(spin):.2f} rad/s{way}; {100 * kept:.0f} percent of the energy is kept.",
    )
    return ax


def _rod(
    ax: Axes, middle: float, axis: np.ndarray, place: float, floor: float, state: Bodies
) -> None:
    """The rod in the x-z plane with the velocities of its ends and its middle, and the pin that meets the floor."""
    x, z = middle + 0.5 * axis[0] * np.array([-1, 1]), 0.5 * axis[2] * np.array([-1, 1])
    ax.plot(x, z, color=PALETTE["sky"], lw=7, ls="-", marker="", solid_capstyle="butt")
    hit = 0.5 * place * axis
    ax.plot(
        [middle + hit[0]] * 2, [hit[2], floor], color="0.3", lw=1.6, ls="-", marker=""
    )
    ax.plot(middle + hit[0], floor, marker="^", ms=8, color="black", ls="none")
    for s in (-1.0, 0.0, 1.0):
        arm = 0.5 * s * axis
        v = point_velocity(state.velocity[0], state.angular_velocity[0], arm)
        start = (middle + arm[0], arm[2])
        if np.hypot(v[0], v[2]) > 5e-3:
            _arrow(
                ax,
                start,
                (start[0] + ARROW * v[0], start[1] + ARROW * v[2]),
                "vermillion",
            )
        ax.plot(*start, marker="o" if s else "s", ms=5, color="black", ls="none")
        right, up, across, along = LABELS[s]
        ax.text(
            start[0] + right,
            start[1] + up,
            _speed(v[2]),
            ha=across,
            va=along,
            fontsize=9.5,
        )


def rod_impulses(
    angle: Sequence[float],
    closed_form: Sequence[float],
    measured: Mapping[str, tuple[Sequence[float], Sequence[float]]],
    *,
    without_spin: float,
    ax: Axes | None = None,
) -> Axes:
    """The impulse on a rod dropped on its end over its angle: the closed form as a line, measurements as marks.

    Args:
        angle: of the line, from the horizontal [degrees].
        closed_form: impulse of the line [N s].
        measured: name -> (angles [degrees], impulses [N s]).
        without_spin: the impulse of a body that cannot turn [N s].
    """
    with style():
        ax = axes(ax, size=(7.6, 4.1))
        ax.axhline(
            without_spin, color="0.45", ls="--", lw=1.2, label="a body that cannot turn"
        )
        ax.axhline(
            without_spin / 4,
            color=PALETTE["blue"],
            ls=":",
            lw=1.2,
            label="a quarter of it",
        )
        ax.plot(
            angle,
            closed_form,
            color="0.2",
            ls="-",
            marker="",
            lw=1.5,
            label="your closed form",
        )
        looks = zip(("vermillion", "green", "purple"), "osD", (8, 4.5, 5), strict=True)
        for (name, (x, y)), (colour, mark, size) in zip(
            measured.items(), looks, strict=False
        ):
            filled = PALETTE[colour] if mark != "o" else "none"
            ax.plot(x, y, ls="none", marker=mark, ms=size, mfc=filled, mec=PALETTE[colour], mew=1.5,
                    label=name)  # fmt: skip
        ax.set(
            xlabel="angle from the horizontal [°]",
            ylabel="impulse [N s]",
            xticks=range(0, 91, 15),
        )
        ax.set_ylim(0, 1.12 * without_spin)
        ax.set_title("A rod dropped on its end")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    named = "; ".join(
        f"{name}: {y[0]:.3f} N s at {x[0]:g} degrees, {y[-1]:.3f} at {x[-1]:g}"
        for name, (x, y) in measured.items()
    )
    describe(
        ax,
        f"Impulse on a rod's end over its angle from the horizontal, rising from a quarter of {without_spin:g} N s for "
        f"the level rod to all of it for the upright one. {named}.",
    )
    return ax


def box_outcomes(
    box: Bodies, corners: np.ndarray, outcomes: Mapping[str, Bodies]
) -> Axes:
    """A box on its four corners before an impact, and how fast they rise after it by several laws.

    Args:
        box: before; body 0 is the box, standing with its axes along x, y, z.
        corners: (4, 3) where it touches the floor, in the order (-,-), (-,+), (+,-), (+,+),
            which the picture numbers 1 to 4 [m].
        outcomes: name -> bodies after, up to five.
    """
    with style():
        _, (ax, bars) = plt.subplots(1, 2, figsize=(10.0, 4.4), width_ratios=(1.0, 1.9))
        _box(ax, corners, 2 * box.position[0, 2], box)
        _corner_bars(bars, corners, outcomes)
    spoken = " ".join(
        f"{name}: {', '.join(map(_plain, _corner_speeds(corners, state)))} m/s, "
        f"spin {_spin(state)} rad/s."
        for name, state in ({"before": box} | dict(outcomes)).items()
    )
    describe(
        ax,
        "A box just above the floor, and the upward speeds of its corners 1 to 4, "
        f"with its spin about x and y. {spoken}",
    )
    return ax


def _box(ax: Axes, corners: np.ndarray, height: float, state: Bodies) -> None:
    """The box with the numbers and the upward speeds of its corners."""
    low = np.stack([corners[:, 0] + 0.5 * corners[:, 1], 0.45 * corners[:, 1]], axis=-1)
    high = low + [0.0, height]
    for face in (low, high):
        ax.add_patch(Polygon(face[[0, 2, 3, 1]], fc="0.9", ec="0.45", alpha=0.6))
    for a, b in zip(low, high, strict=True):
        ax.plot(*np.stack([a, b]).T, color="0.45", lw=1.0, ls="-", marker="")
    for i, (start, speed) in enumerate(
        zip(low, _corner_speeds(corners, state), strict=True)
    ):
        if abs(speed) > 5e-3:
            tip = (start[0], start[1] + ARROW * speed)
            _arrow(ax, (start[0], start[1]), tip, "vermillion")
        ax.plot(*start, marker="o", ms=4, color="black", ls="none")
        side = (
            (0.05, "left") if i % 2 else (-0.05, "right")
        )  # out of the way of the arrows beside it
        back = {"fc": "white", "ec": "none", "pad": 0.6, "alpha": 0.85}
        ax.text(
            start[0] + side[0],
            start[1] - 0.04,
            f"{i + 1}: {_speed(speed)}",
            ha=side[1],
            va="center",
            fontsize=9.5,
            bbox=back,
        )
    ax.set(xlim=(-1.0, 1.0), ylim=(-0.7, 0.6), aspect="equal")
    ax.set_title(f"before [m/s],\nspin {_spin(state)} rad/s", fontsize=10)
    _bare(ax)


def _corner_bars(ax: Axes, corners: np.ndarray, outcomes: Mapping[str, Bodies]) -> None:
    """The upward speeds of the corners after, a group a corner and a bar a law."""
    width = 0.86 / len(outcomes)
    for k, ((name, state), colour, hatch) in enumerate(
        zip(outcomes.items(), COLOURS, HATCHES, strict=False)
    ):
        place = np.arange(4) + (k - 0.5 * (len(outcomes) - 1)) * width
        speeds = _corner_speeds(corners, state)
        drawn = ax.bar(
            place,
            speeds,
            width,
            color=PALETTE[colour],
            hatch=hatch,
            ec="white",
            label=f"{name}: {_spin(state)}",
        )
        ax.bar_label(drawn, [_plain(v) for v in speeds], fontsize=8, padding=1)
    ax.axhline(0, color="0.3", lw=0.8)
    ax.margins(y=0.1)  # room for the numbers at the bars
    ax.set_xticks(range(4), [f"corner {i + 1}" for i in range(4)])
    ax.set_ylabel("upward speed after [m/s]")
    ax.grid(axis="x", visible=False)
    said = r"after, with the spin $(\omega_x, \omega_y)$ [rad/s]"
    ax.legend(loc="upper center", bbox_to_anchor=(0.45, -0.09), ncols=2, title=said)


def _corner_speeds(corners: np.ndarray, state: Bodies) -> np.ndarray:
    """How fast the corners of body 0 rise, (4,) [m/s]."""
    arms = corners - state.position[0]
    moves = point_velocity(state.velocity[0], state.angular_velocity[0], arms)
    speeds: np.ndarray = np.round(moves[:, 2], 9) + 0.0  # no minus zero below the axis
    return speeds


def _spin(state: Bodies) -> str:
    """The spin of body 0 about x and about y, with their signs."""
    return f"({', '.join(map(_plain, state.angular_velocity[0, :2]))})"


def spins_by_order(
    outcomes: OrderOutcomes,
    others: Mapping[str, Sequence[float]],
    *,
    ax: Axes | None = None,
) -> Axes:
    """The spin that each order of the same contacts gives the same box, as one point an outcome.

    Args:
        outcomes: of ``study.outcomes_by_order``.
        others: name -> spin (3,) of a law that does not ask for the order.
    """
    with style():
        ax = axes(ax, size=(8.2, 4.0))
        ax.plot(*outcomes.spin[:, :2].T, ls="none", marker="o", ms=6, mfc="none", mec=PALETTE["vermillion"], mew=1.5,
                label=f"one after the other,\n{len(outcomes.order)} orders")  # fmt: skip
        different, times = np.unique(
            np.round(outcomes.spin, 6), axis=0, return_counts=True
        )
        for spin, count in zip(different, times, strict=True):
            if count > 1:
                ax.annotate(
                    f"{count} orders",
                    spin[:2],
                    (7 if spin[0] > 0 else -7, 0),
                    textcoords="offset points",
                    va="center",
                    ha="left" if spin[0] > 0 else "right",
                    fontsize=9,
                )
        for (name, spin), mark in zip(others.items(), "*D^", strict=False):
            ax.plot(
                spin[0],
                spin[1],
                ls="none",
                marker=mark,
                ms=13,
                color=PALETTE["blue"],
                label=name,
            )
        ax.set(
            xlabel=r"spin about x, $\omega_x$ [rad/s]",
            ylabel=r"spin about y, $\omega_y$ [rad/s]",
            aspect="equal",
        )
        ax.margins(x=0.12)
        ax.set_title("One box, one impact")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    fastest = float(np.linalg.norm(outcomes.spin, axis=1).max())
    named = "; ".join(
        f"{name}: {np.linalg.norm(s):.2f} rad/s" for name, s in others.items()
    )
    describe(
        ax,
        f"Spins of a box after the same flat landing with its four contacts listed in {len(outcomes.order)} orders: "
        f"{len(different)} different outcomes scattered around zero, up to {fastest:.2f} rad/s. {named}.",
    )
    return ax


def spin_by_pegs(
    place: Sequence[float],
    by_order: Mapping[str, Sequence[float]],
    both: Sequence[float],
    threshold: float,
    *,
    ax: Axes | None = None,
) -> Axes:
    """The spin of a level rod after it fell on two pegs, over where they stand: by the order of the pegs, and at once.

    Args:
        place: of the pegs, left and right of the middle [m].
        by_order: name of an order -> spin about y [rad/s].
        both: spin by the law that takes both at once [rad/s].
        threshold: where the pegs do not feel each other [m].
    """
    with style():
        ax = axes(ax, size=(8.6, 4.0))
        for (name, spin), colour, mark in zip(
            by_order.items(), ("vermillion", "purple"), "os", strict=False
        ):
            ax.plot(place, spin, ls="none", marker=mark, ms=5, mfc="none", mec=PALETTE[colour], mew=1.4,
                    label=name)  # fmt: skip
        ax.plot(
            place,
            both,
            ls="--",
            marker="",
            color=PALETTE["green"],
            label="both at once",
        )
        ax.axvline(
            threshold,
            color=PALETTE["blue"],
            ls=":",
            label=f"radius of gyration\n{threshold:.3g} m",
        )
        ax.set(
            xlabel="pegs left and right of the middle at [m]",
            ylabel=r"spin about y, $\omega_y$ [rad/s]",
        )
        ax.set_title("A level rod on two pegs, e = 1")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    most = max(float(np.abs(spin).max()) for spin in by_order.values())
    describe(
        ax,
        f"Spin of a level rod after it fell on two pegs, over the distance of the pegs from its middle: opposite for "
        f"the two orders, up to {most:.2f} rad/s, and zero for both where the pegs stand at {threshold:.3f} m and "
        "under the ends. With both pegs at once there is no spin.",
    )
    return ax


def mass_over_face(
    x: np.ndarray, y: np.ndarray, ratio: np.ndarray, *, ax: Axes | None = None
) -> Axes:
    """Effective mass over mass where a box is hit on its upper face, and where leaving out spin errs by how much.

    Args:
        x, y: of the face, from its middle, (k,) and (l,) [m].
        ratio: mu/m, (l, k).
    """
    with style():
        ax = axes(ax, size=(7.4, 4.2))
        filled = ax.contourf(
            x, y, ratio, levels=np.linspace(0.0, 1.0, 11), cmap="viridis"
        )
        bar = ax.get_figure(root=True).colorbar(filled, ax=ax)  # type: ignore[union-attr]
        bar.set_label(r"mass felt / mass, $\mu/m$")
        for error, line in ((1, "-"), (10, "--"), (50, ":")):
            ax.contour(
                x,
                y,
                ratio,
                levels=[1 / (1 + error / 100)],
                colors="black",
                linewidths=1.6,
                linestyles=line,
            )
            ax.plot(
                [],
                [],
                color="black",
                lw=1.6,
                ls=line,
                marker="",
                label=f"{error} % too large",
            )
        ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.set_title("Mass felt where the top face is hit")
        said = "on this line the impulse without spin is"
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3, title=said)
        ax.grid(False)
    describe(
        ax,
        f"Effective mass over mass on the upper face of a box: 1 in the middle, {ratio[0, 0]:.2f} at the corners. "
        "Three nested ellipses show where an impulse computed without spin is too large by 1, 10 and 50 percent.",
    )
    return ax


def _arrow(
    ax: Axes, start: tuple[float, float], tip: tuple[float, float], colour: str
) -> None:
    ax.add_patch(FancyArrowPatch(start, tip, arrowstyle="-|>", mutation_scale=11, lw=1.8, color=PALETTE[colour],
                                 shrinkA=0, shrinkB=0, zorder=4))  # fmt: skip


def _speed(value: float) -> str:
    return "0" if abs(value) < 5e-3 else f"{value:+.2f}".replace("-", "\N{MINUS SIGN}")


def _plain(value: float) -> str:
    """Two decimals, and never a minus zero."""
    return f"{round(float(value), 2) + 0.0:.2f}"


def _bare(ax: Axes) -> None:
    ax.set(xticks=[], yticks=[])
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)
