"""A plank on two feet, and the plane of its two forces: the solution, and sweeps toward it."""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.study import PlankForces, plank_forces, two_forces
from course.workbook.stage import (
    Arrows,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Path,
    Preset,
    ball,
    box,
    labelled,
    standing,
)

SWEEPS, PAUSE = 8, 0.5  # each sweep is two steps, one a foot [s]
FORCE, ACCELERATION = 0.0028, 0.07  # metres for 1 N, 1 m/s^2
#: What the plane of the forces shows, whatever the knob says [N].
LOW, HIGH = -160.0, 460.0
WINDOW = (-1.75, -0.78, 1.75, 1.1)
KNOBS = (Knob("load_at", "place of the load", 0.3, -1.5, 1.5, 0.05, "m"),)
PRESETS = (
    Preset("between the feet", {"load_at": 0.3}),
    Preset("it just stays", {"load_at": 0.75}),
    Preset("the left foot lifts", {"load_at": 1.2}),
    Preset("in the middle", {"load_at": 0.0}),
)


def plank() -> Exhibit:
    """The load of 20 kg is dragged along the plank."""
    return Exhibit(
        film,
        KNOBS,
        [Hand({"load_at": (0.0, 1.0, 0.0)}, body=1)],
        PRESETS,
        question="The plank weighs 10 kg, the load 20 kg, the feet are 1 m apart. "
        "How far from the middle may the load stand before a foot lifts?",
        answer="0.75 m: there the common centre of mass is over a foot, and the crossing of the two lines "
        "d̈ = 0 leaves the quadrant f ≥ 0.",
    )  # fmt: skip


def film(load_at: float) -> Film:
    """Sweeps from f = 0 with the load at y [m]; a step changes one force."""
    found = plank_forces(load_at)
    forces = found.forces
    path = two_forces(forces.matrix, forces.bias, sweeps=SWEEPS).sweeps
    times = PAUSE * np.arange(len(path), dtype=float)
    rest = path @ forces.matrix.T + forces.bias
    return Film(
        [_pane(found, path, rest)],
        times,
        Flat("yz", WINDOW),
        title="A plank on two feet",
        caption="Drag the load. Each step sets one foot's d̈ to 0 by its own force, or the force to 0: "
        "projected Gauss-Seidel, from f = 0.",
        ending=_ending(found),
        charts=[_plane(found, path)],
        counters={"step": np.arange(len(path), dtype=float)},
        numbers=_numbers(found),
        events=tuple(times),
    )  # fmt: skip


def _pane(found: PlankForces, path: Array, rest: Array) -> Pane:
    count = len(path)
    place = [
        [0, 0, 0.05], [0, found.load_at, 0.24], [0, found.centre, 0.05],
        [0, found.feet[0], -0.3], [0, found.feet[1], -0.3], [0, 0, -1.6],
    ]  # fmt: skip
    solids = [
        box((0.1, 1.5, 0.05), color="orange"),
        labelled(ball(0.14, color="blue"), "20"),
        labelled(ball(0.035, color="black"), "centre of mass"),
        labelled(standing(box((0.1, 0.06, 0.3))), "1"),
        labelled(standing(box((0.1, 0.06, 0.3))), "2"),
        standing(box((0.1, 30.0, 1.0)), endless=True),
    ]
    at = np.zeros((2, 3))
    at[:, 1] = found.feet
    up = np.array([0.0, 0.0, 1.0])
    weight = [[0.0, 0.0, -9.81 * 30.0]]
    return Pane(
        solids,
        place,
        arrows=[
            Arrows("force f", path[:, :, None] * up, "N", at=at - [0, 0.12, 0], scale=FORCE, color="green",
                   numbers=True),
            Arrows("d̈", rest[:, :, None] * up, "m/s²", at=at + [0, 0.12, 0.12], scale=ACCELERATION,
                   color="vermillion", numbers=True),
            Arrows("weight", np.broadcast_to(weight, (count, 1, 3)), "N", at=[place[2]], scale=0.0028, color="black",
                   shown=False),
        ],
    )  # fmt: skip


def _plane(found: PlankForces, path: Array) -> Path:
    """The forces, and where each foot's acceleration is 0, within LOW and HIGH."""
    a, b = found.forces.matrix, found.forces.bias
    lines = {f"d̈{'₁₂'[k]} = 0": _within(a[k], b[k]) for k in (0, 1)}
    axes = [[LOW, 0], [HIGH, 0], [0, 0], [0, HIGH], [0, LOW]]
    return Path("the two forces", "f₁ [N]", "f₂ [N]", path[:, 0], path[:, 1],
                guides={**lines, "f = 0": np.array(axes, dtype=float)})  # fmt: skip


def _within(row: Array, bias: float) -> Array:
    """The line row.f + bias = 0 where both forces are from LOW to HIGH, (2, 2) [N]."""
    normal = row / np.linalg.norm(row)
    near = -bias * row / float(row @ row)
    along = np.linspace(-1500, 1500, 6001)[:, None] * [-normal[1], normal[0]] + near
    inside = along[np.all((along >= LOW) & (along <= HIGH), axis=1)]
    return inside[[0, -1]]


def _numbers(found: PlankForces) -> list[Number]:
    f, w, forced = found.forces.force, found.forces.acceleration, found.forces.forced
    said = [
        ("f₁", f[0], "N"), ("f₂", f[1], "N"),
        ("d̈₁", w[0], "m/s²"), ("d̈₂", w[1], "m/s²"),
        ("f₁ if both d̈ = 0", forced[0], "N"), ("f₂ if both d̈ = 0", forced[1], "N"),
    ]  # fmt: skip
    return [Number(name, (round(float(v), 9),), unit) for name, v, unit in said]


def _ending(found: PlankForces) -> str:
    f, w = found.forces.force, found.forces.acceleration
    lifted = int(np.argmax(w))
    if w[lifted] < 1e-9:
        return f"Both feet stay: f₁ = {f[0]:.0f} N, f₂ = {f[1]:.0f} N, the law of the lever"
    name = ("left", "right")[lifted]
    return f"The {name} foot lifts with d̈ = {w[lifted]:.2f} m/s²; the other carries {f[1 - lifted]:.0f} N"
