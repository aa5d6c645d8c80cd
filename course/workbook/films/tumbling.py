"""A handle that turns in space with no torque on it: which of its axes keeps its spin."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.dynamics import Tumble, free_tumble
from course.scenes import handle_mass_properties, spinning_handle
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS
from course.workbook.plots.motion import AXIS_NAMES
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Solid,
    Space,
    ball,
    box,
    joined,
)
from course.workbook.stage.words import shown_number

SECONDS, MOMENTS = 10.0, 301
COLORS = ("blue", "orange", "purple")
#: What is seen, whatever the knobs say, and where the shadow falls [m].
WINDOW, GROUND = ((-0.08, -0.08, -0.11), (0.08, 0.08, 0.17)), -0.11
#: Room for L and omega [m].
LONGEST = 0.17
KNOBS = (
    Knob("axis", "spins about axis", 2, 1, 3, 1),
    Knob("tilt", "tilt at the start", 1.0, 0.01, 50.0, unit="°", logarithmic=True),
    Knob("spin", "spin", 6.0, 1.0, 12.0, 0.5, "rad/s"),
)
PRESETS = tuple(
    Preset(f"{k + 1}: the {name}", {"axis": k + 1, "tilt": 1.0, "spin": 6.0})
    for k, name in enumerate(AXIS_NAMES)
)


def handle() -> Exhibit:
    """The steel T with L and omega, and its energy of turning about each axis over time."""

    def film(axis: float, tilt: float, spin: float) -> Film:
        number = round(axis) - 1
        start = spinning_handle(axis=number, tilt=np.radians(tilt), spin=spin)
        motion = free_tumble(start.bodies, np.linspace(0.0, SECONDS, MOMENTS))
        return handle_film(motion, about=number)

    return Exhibit(
        film,
        KNOBS,
        presets=PRESETS,
        question="No torque acts. About which of its three axes does the handle keep spinning?",
        answer="About the crossbar (least moment) and the third axis (largest): a small tilt stays small. "
        "About the stem, the middle one, it turns over again and again, while L stands still.",
    )  # fmt: skip


def handle_film(
    motion: Tumble, *, about: int | None = 1, arrows: bool = True, caption: str = ""
) -> Film:
    """The handle as it moves.

    Args:
        motion: of ``course.scenes.spinning_handle``, or thrown: then the camera goes along.
        about: the axis, 0 to 2, whose turning over the ending counts; None: it counts none.
        arrows: whether L and omega are there, and the chart of the energies.
        caption: what there is to see.
    """
    return Film(
        [_pane(motion, arrows)],
        motion.times,
        Space(ground=GROUND, window=WINDOW),
        title="A handle in space",
        caption=caption or "No torque acts: L and the sum of the energies stay as they are.",
        ending="" if about is None else _ending(motion, about),
        charts=[_energies(motion)] if arrows else (),
        numbers=_numbers(motion) if arrows else (),
        events=() if about is None else tuple(motion.turnover_times(about)),
    )  # fmt: skip


def handle_solid() -> Solid:
    """A blue crossbar and an orange stem, about the centre of mass."""
    center = _center()
    bar, stem = (
        box(size, center=place - center, color=color)
        for size, place, color in zip(
            HANDLE_HALF_EXTENTS, HANDLE_CENTERS, COLORS, strict=False
        )
    )
    return joined(bar, stem, what="handle")


@cache
def _center() -> Array:
    return handle_mass_properties().centre


def _pane(motion: Tumble, arrows: bool) -> Pane:
    turn = rotations.from_matrix(motion.rotation)
    tip = HANDLE_CENTERS[0] - _center()
    tip = tip + HANDLE_HALF_EXTENTS[0] * [1.0, 0.0, 0.0]
    at = motion.position - motion.position
    place = np.stack([at, at + motion.rotation @ tip], axis=1)
    momentum = np.broadcast_to(motion.angular_momentum, (len(at), 1, 3))
    omega = motion.angular_velocity[:, None]
    shown = [
        Arrows("L", momentum, "kg m²/s", at=place[:, :1], scale=_scale(momentum), color="green"),
        Arrows("ω", omega, "rad/s", at=place[:, :1], scale=_scale(omega), color="vermillion"),
    ]  # fmt: skip
    return Pane(
        [handle_solid(), replace(ball(0.007, color="black"), what="mark on its end")],
        place,
        np.stack([turn, turn], axis=1),
        arrows=shown if arrows else (),
        trails=[1],
    )


def _scale(vectors: Any) -> float:
    """Metres for one unit, 1, 2 or 5 times a power of ten, within ``LONGEST``."""
    wanted = LONGEST / float(np.linalg.norm(vectors, axis=-1).max())
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(s for s in (1, 2, 5) if s * power <= wanted))


def _energies(motion: Tumble) -> Curves:
    """In millijoules, with limits that stay while the spin changes a little."""
    energy = 1e3 * motion.turning_energy
    top = 2.0 ** np.ceil(np.log2(1.02 * energy.sum(axis=1).max()))
    parts = {f"about the {n}": e for n, e in zip(AXIS_NAMES, energy.T, strict=True)}
    return Curves("energy of turning", "mJ", parts, stacked=True, limits=(0.0, top), colors=COLORS)  # fmt: skip


def _numbers(motion: Tumble) -> list[Number]:
    size = float(np.linalg.norm(motion.angular_momentum))
    names = ("crossbar I₁", "stem I₂", "third axis I₃")
    moments = [
        Number(name, (1e3 * float(m),), "g m²")
        for name, m in zip(names, motion.moments, strict=True)
    ]
    energy = float(motion.turning_energy[0].sum())
    return [
        *moments,
        Number("|L|", (1e3 * size,), "g m²/s"),
        Number("energy of turning", (1e3 * energy,), "mJ"),
    ]


def _ending(motion: Tumble, about: int) -> str:
    name = AXIS_NAMES[about]
    over = motion.turnover_times(about)
    if len(over):
        listed = ", ".join(f"{when:.2f}" for when in over[:4])
        listed += ", ..." if len(over) > 4 else ""
        times = "once" if len(over) == 1 else f"{len(over)} times"
        return f"The {name} turns over {times}: it lies across L at {listed} s"
    l_body = motion.seen_from_body
    cosine = l_body[:, about] / np.linalg.norm(l_body, axis=1)
    widest = np.degrees(np.arccos(np.clip(cosine.min(), -1.0, 1.0)))
    return f"It goes on spinning about the {name}, which leans at most {shown_number(widest, 3)}° from L"
