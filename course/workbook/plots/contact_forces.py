"""Pictures of contact forces: what solvers answer, the plane of two forces, a ladder's slide, and what solvers cost."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from course.arrays import ArrayLike
from course.contact import solve
from course.study.loaded_plank import loaded_plank
from course.study.solver_growth import SolverGrowth
from course.workbook.plots.figure import PALETTE, axes, describe, side_by_side, style

COLOURS = ("blue", "vermillion", "green", "purple", "orange", "sky")
HATCHES = ("", "//", "..", "xx", "\\\\", "--")
MARKERS = "os^DvP"
LINES = ("-", "--", "-.", ":", "-", "--")


def leg_forces(forces: Mapping[str, ArrayLike], *, ax: Axes | None = None) -> Axes:
    """The forces at each leg side by side, as several solvers answer them; ``forces`` are (c,) each, [N]."""
    values = {name: np.asarray(f, dtype=float) for name, f in forces.items()}
    count = len(next(iter(values.values())))
    with style():
        ax = axes(ax, size=(8.4, 3.4))
        width = 0.8 / len(values)
        for k, ((name, f), colour, hatch) in enumerate(
            zip(values.items(), COLOURS, HATCHES, strict=False)
        ):
            place = np.arange(count) + (k - 0.5 * (len(values) - 1)) * width
            ax.bar(
                place,
                f,
                width,
                color=PALETTE[colour],
                hatch=hatch,
                ec="white",
                label=name,
            )
        ax.set_xticks(range(count), [f"leg {i + 1}" for i in range(count)])
        ax.set(ylabel="force [N]")
        ax.grid(axis="x", visible=False)
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    spoken = [
        f"{name}: {', '.join(f'{x:.2f}' for x in f + 0.0)}"
        for name, f in values.items()
    ]
    describe(
        ax,
        f"Forces at {count} legs in newtons, one bar a solver and leg. {'; '.join(spoken)}.",
    )
    return ax


def force_plane(
    a: ArrayLike,
    b: ArrayLike,
    *,
    names: tuple[str, str] = ("1", "2"),
    ax: Axes | None = None,
) -> Axes:
    """Two contacts: level sets of f'A f/2 + b.f, the quadrant f >= 0, the lines d_ddot_i = 0, sweeps, the solution."""
    from course.contact.solvers.projected_gauss_seidel import gauss_seidel_path

    matrix, bias = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    forced, f = np.linalg.solve(matrix, -bias), _solved(matrix, bias)
    w = matrix @ f + bias
    reach = 1.25 * max(float(np.abs(forced).max()), float(f.max()))
    low, high = min(-0.25 * reach, 1.25 * float(forced.min())), reach
    with style():
        ax = axes(ax, size=(5.6, 5.6))
        _level_sets(ax, matrix, forced, f, (low, high))
        for corner, wide, tall in (
            ((low, low), -low, high - low),
            ((0.0, low), high, -low),
        ):
            ax.add_patch(
                Rectangle(
                    corner, wide, tall, fc="0.85", ec="none", alpha=0.75, zorder=2
                )
            )
        for i, (colour, line) in enumerate((("blue", "-"), ("vermillion", "--"))):
            ends = _zero_line(matrix[i], bias[i], (low, high))
            ax.plot(*ends, color=PALETTE[colour], ls=line, marker="", lw=1.8, zorder=3,
                    label=rf"$\ddot d_{i + 1} = 0$")  # fmt: skip
        path = gauss_seidel_path(matrix, bias, 3)
        ax.plot(*path.T, color=PALETTE["black"], ls="-", lw=2.4, marker="D", ms=6,
                mfc=PALETTE["orange"], zorder=4, label="three sweeps from 0")  # fmt: skip
        ax.plot(*forced, ls="none", marker="X", ms=9, color=PALETTE["black"], zorder=5,
                label="both forced to 0")  # fmt: skip
        ax.plot(*f, ls="none", marker="o", ms=11, mfc="none", mew=2.4, color=PALETTE["black"], zorder=6,
                label="least with f ≥ 0")  # fmt: skip
        if np.abs(w).max() > 1e-9 * np.abs(bias).max():
            tip = f + 0.22 * reach * w / np.linalg.norm(w)
            look = {"arrowstyle": "-|>", "lw": 2.0, "shrinkA": 6, "shrinkB": 0}
            ax.annotate("", tuple(tip), tuple(f), arrowprops=look, zorder=6)
            ax.plot([], [], ls="none", marker=r"$\rightarrow$", ms=13, color=PALETTE["black"],
                    label=r"slope of q there, $\ddot d$")  # fmt: skip
        ax.axhline(0, color="0.3", lw=1.0, zorder=2)
        ax.axvline(0, color="0.3", lw=1.0, zorder=2)
        ax.set(xlim=(low, high), ylim=(low, high), aspect="equal")
        ax.set(xlabel=f"$f_1$, {names[0]} [N]", ylabel=f"$f_2$, {names[1]} [N]")
        ax.legend(
            loc="upper center", bbox_to_anchor=(0.45, -0.16), ncols=2, fontsize=11
        )
    describe(
        ax,
        f"The plane of two contact forces in newtons, with ellipses around ({forced[0]:.0f}, {forced[1]:.0f}), where "
        f"both d_ddot are 0, and the allowed quadrant. The least value in it is at ({f[0] + 0:.0f}, {f[1] + 0:.0f}), "
        "where d_ddot is "
        f"({_plain(w[0])}, {_plain(w[1])}) m/s². Three sweeps from (0, 0), each step along one axis, lead to "
        f"({path[-1, 0]:.0f}, {path[-1, 1]:.0f}).",
    )
    return ax


def plank_and_forces(load_at: float, *, ax: Axes | None = None) -> Axes:
    """A plank on two feet with its load at ``load_at`` [m], and beside it the plane of the two forces."""
    scene = loaded_plank(load_at)
    system = scene.system()
    matrix, bias = system.A.toarray(), system.b
    f = _solved(matrix, bias)
    w, feet, centre = (
        matrix @ f + bias,
        scene.contacts.point[:, 1],
        scene.bodies.position[0, 1],
    )
    lifted = [name for name, x in zip(("left", "right"), w, strict=True) if x > 1e-9]
    word = f"the {lifted[0]} foot lifts" if lifted else "both feet stay"
    if ax is None:
        _, (ax, plane) = side_by_side(2, size=(9.6, 5.4))
        force_plane(matrix, bias, names=("left foot", "right foot"), ax=plane)
    with style():
        ax.add_patch(Rectangle((-1.5, 0), 3.0, 0.08, fc="0.8", ec="0.3"))
        ax.add_patch(
            Rectangle(
                (load_at - 0.15, 0.08),
                0.3,
                0.3,
                fc=PALETTE["orange"],
                ec="0.3",
                hatch="//",
            )
        )
        ax.axhline(-0.12, color="0.3", lw=1.0)
        ax.plot(
            [centre],
            [0.04],
            ls="none",
            marker="P",
            ms=10,
            color=PALETTE["black"],
            label="centre of mass",
        )
        for y, force, colour in zip(feet, f, ("blue", "vermillion"), strict=True):
            _foot(ax, y, force, PALETTE[colour])
        ax.set(
            xlim=(-1.7, 1.7),
            ylim=(-1.15, 0.75),
            xlabel="y [m]",
            yticks=[],
            title=f"load at {load_at:+.2f} m: {word}",
        )
        ax.grid(visible=False)
        ax.legend(loc="upper left")
    describe(
        ax,
        f"A plank on feet at -0.5 m and 0.5 m with a load at {load_at:.2f} m: the left foot carries {f[0] + 0:.0f} N, "
        f"the right one {f[1] + 0:.0f} N; {word}.",
    )
    return ax


def ladder_forces(
    angles: ArrayLike,
    forces: ArrayLike,
    closed: ArrayLike,
    *,
    leaving: float,
    ax: Axes | None = None,
) -> Axes:
    """Forces of floor and wall over a ladder's angle: the closed form as lines, what was solved for as marks.

    Args:
        angles: (k,) [rad].
        forces, closed: (k, 2) [N], floor and wall.
        leaving: the angle at which it leaves the wall [rad].
    """
    degrees, f, line = np.degrees(angles), np.asarray(forces), np.asarray(closed)
    with style():
        ax = axes(ax, size=(8.0, 4.0))
        for k, (name, colour, mark, dash) in enumerate(
            (("floor", "blue", "o", "-"), ("wall", "vermillion", "s", "--"))
        ):
            ax.plot(
                degrees,
                line[:, k],
                color=PALETTE[colour],
                ls=dash,
                marker="",
                label=f"{name}, closed form",
            )
            ax.plot(
                degrees,
                f[:, k],
                color=PALETTE[colour],
                ls="none",
                marker=mark,
                label=f"{name}, solved",
            )
        ax.axvline(
            np.degrees(leaving),
            color="0.3",
            ls=":",
            label=f"leaves the wall: {np.degrees(leaving):.1f}°",
        )
        ax.axhline(0, color="0.3", lw=0.8)
        ax.invert_xaxis()
        ax.set(xlabel="angle to the floor [degrees], falling", ylabel="force [N]")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    last = int(np.argmin(degrees))
    describe(
        ax,
        "Forces of floor and wall on a ladder that slides down, over its angle. Marks lie on the lines of the closed "
        f"form until it leaves the wall at {np.degrees(leaving):.1f} degrees. After that the closed form of the wall "
        f"falls to {line[last, 1]:.0f} N and the solved one stays at {f[last, 1] + 0:.0f} N.",
    )
    return ax


def solver_growth(result: SolverGrowth, *, ax: Axes | None = None) -> Axes:
    """Time and counted steps of contact solvers over the number of contacts, both logarithmic."""
    panels: list[tuple[Axes, Any, str]] = []
    if ax is None:
        _, (ax, right) = side_by_side(2, size=(9.6, 4.2))
        panels.append((right, result.steps, "sweeps, pivots or Newton systems"))
    panels.insert(0, (ax, result.seconds, "time [s]"))
    with style():
        for panel, rows, label in panels:
            for k, name in enumerate(result.method):
                panel.loglog(result.contacts, rows[k], marker=MARKERS[k], ls=LINES[k], color=PALETTE[COLOURS[k]],
                             label=name)  # fmt: skip
            panel.set(xlabel="contacts", ylabel=label)
        panels[-1][0].legend(loc="upper left", ncols=1, labelspacing=0.3)
        low, high = panels[-1][0].get_ylim()
        panels[-1][0].set_ylim(low, high * (high / low) ** 0.75)  # room for the legend
    told = [_cost_told(result, k) for k in range(len(result.method))]
    describe(
        ax,
        f"Time and counted steps over {result.contacts[0]:.0f} to {result.contacts[-1]:.0f} contacts, both axes "
        f"logarithmic. {' '.join(told)}",
    )
    return ax


def _cost_told(result: SolverGrowth, k: int) -> str:
    """What a method costs for the fewest and the most contacts that it was asked."""
    first, last = np.flatnonzero(np.isfinite(result.seconds[k]))[[0, -1]]
    each = [f"{result.steps[k, i]:.0f} steps and {result.seconds[k, i]:.2g} s at {result.contacts[i]:.0f}"
            for i in dict.fromkeys((first, last))]  # fmt: skip
    return f"{result.method[k]}: {', '.join(each)}."


def _level_sets(
    ax: Axes,
    matrix: np.ndarray,
    least: np.ndarray,
    through: np.ndarray,
    ends: tuple[float, float],
) -> None:
    """Ellipses of f'A f/2 + b.f around its least value, the one through a point darker."""
    grid = np.linspace(*ends, 160)
    f_1, f_2 = np.meshgrid(grid, grid)
    off = np.stack([f_1, f_2], axis=-1) - least
    level = np.sqrt(np.einsum("...i,ij,...j->...", off, matrix, off))
    ax.contour(f_1, f_2, level, levels=9, colors="0.78", linewidths=0.8)
    touching = float(np.sqrt((through - least) @ matrix @ (through - least)))
    if touching > 1e-6:
        ax.contour(
            f_1, f_2, level, levels=[touching], colors="0.4", linewidths=1.6, zorder=3
        )


def _zero_line(
    row: np.ndarray, bias: float, ends: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Where row.f + bias = 0 crosses the picture: solved for the force that the row weighs more."""
    along = np.array(ends)
    if abs(row[1]) > abs(row[0]):
        return along, -(bias + row[0] * along) / row[1]
    return -(bias + row[1] * along) / row[0], along


def _foot(ax: Axes, y: float, force: float, colour: str) -> None:
    """A foot of the plank, and the force that pushes it up as an arrow with its number."""
    ax.plot([y, y], [-0.12, 0], color="0.3", lw=3, marker="", ls="-")
    if force > 1e-9:
        look = {
            "arrowstyle": "-|>",
            "lw": 2.4,
            "color": colour,
            "shrinkA": 0,
            "shrinkB": 0,
        }
        ax.annotate("", (y, -0.15), (y, -0.15 - force / 400), arrowprops=look)
    below = -0.15 - max(force, 0) / 400 - 0.03
    ax.text(y, below, f"{force + 0:.0f} N", ha="center", va="top", color=colour)


def _solved(matrix: np.ndarray, bias: np.ndarray) -> np.ndarray:
    from course.contact import ContactSystem

    return solve(ContactSystem(matrix, bias)).force


def _plain(value: float) -> str:
    return f"{value if abs(value) > 1e-9 else 0.0:.2f}"
