"""The handle by a step, or by an acceleration, of one's own, beside the right one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from course.arrays import Array
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS
from course.study import stepped_handles as study
from course.study.stepped_handles import SteppedHandle
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.tumbling import handle_solid
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Space,
    ball,
)
from course.workbook.stage.words import shown_number

SECONDS, MOST = 4.0, 201  # and how many moments are played
#: What is seen, whatever the knobs say, and where the shadow falls [m].
WINDOW, GROUND = ((-0.11, -0.11, -0.12), (0.11, 0.11, 0.18)), -0.12
STEP = Knob("step", "step", 0.01, 0.005, 0.04, unit="s", logarithmic=True)
TILT = Knob("tilt", "tilt at the start", 1.0, 0.1, 50.0, unit="°", logarithmic=True)
SPRING = Knob("stiffness", "spring", 20.0, 0.0, 40.0, 1.0, "N/m")
#: What is asked, by the exercise: the motion of a function, the right formula, the printed one.
ASKED: dict[str, tuple[Callable[..., SteppedHandle], str, Any]] = {
    "symplectic_euler_step": (study.by_steps, "momenta first, then place and R", None),
    "rk4_step": (study.by_body_momentum, "RK4 of l̇ = l × ω", None),
    "world_inertia": (study.by_inertia, "ω = I⁻¹ L, I = R I_body Rᵀ", None),
    "angular_acceleration": (study.by_acceleration, "ω̇ = I⁻¹ (τ + L × ω)", (study.without_gyration, "τ = I ω̇")),
    "angular_acceleration_free": (study.by_acceleration, "ω̇ = I⁻¹ (τ + L × ω)",
                                  (study.without_cross, "ω̇ = I⁻¹ τ + I⁻¹ L")),
}  # fmt: skip


def handle_steps(
    against: Any = None, exercise: str = "symplectic_euler_step"
) -> Exhibit:
    """The handle, on a spring where the step takes forces.

    Args:
        against: plays a second one beside it: a function of your own, or "printed" for
            ``angular_acceleration``, tau = I omega_dot of the slide, and for
            ``angular_acceleration_free``, I^-1 tau + I^-1 L.
        exercise: whose arguments that function has, one of ``ASKED``.
    """
    motion, title, printed = ASKED[exercise]
    words = f"{printed[1]}, as the slide prints it" if printed else ""
    answer, attempt = asked_of(against, printed and printed[0], words)
    if exercise == "angular_acceleration_free":
        answer = study.by_free_acceleration(answer)
    knobs = [STEP, TILT] + [SPRING] * (exercise == "symplectic_euler_step")

    def film(step: float, tilt: float, **spring: float) -> Film:
        given = step, SECONDS, *spring.values()
        right = motion(*given, tilt=np.radians(tilt))
        other: Any = right
        if against is not None:
            other = attempt.motion(
                lambda: motion(*given, tilt=np.radians(tilt), function=answer)
            )
        hung = spring.get("stiffness", 0.0) > 0
        return _film(title, right, other, None if against is None else attempt, hung)

    free = Preset("steps of 5 ms", {"step": 0.005})
    large = Preset("steps of 40 ms", {"step": 0.04})
    presets = [Preset("steps of 10 ms", {"step": 0.01}), free, large]
    if len(knobs) == 3:
        presets += [
            Preset("in space", {"stiffness": 0.0}),
            Preset("on a spring", {"stiffness": 20.0}),
        ]
    return Exhibit(film, knobs, presets=presets)


def _film(
    title: str, right: SteppedHandle, other: Any, attempt: Attempt | None, hung: bool
) -> Film:
    motions = moved(right, other) if attempt else [right]
    keep = _kept(len(right.times))

    def pane(title: str, motion: SteppedHandle) -> Pane:
        return _pane(title, motion, keep, hung)

    names = attempt.names if attempt else ("by steps",)
    whole = float(right.energy[0])
    energy = {
        name: np.clip(100 * m.energy[keep] / whole, -1e6, 1e6)
        for name, m in zip(names, motions, strict=False)
    }
    upright = {
        name: np.clip(m.rotation[keep, 2, 1], -1.0, 1.0)
        for name, m in zip(names, motions, strict=False)
    }
    energy["exact"] = 100.0 + 0 * right.times[keep]
    colors = ["blue", "vermillion"][: len(motions)] + ["grey"]
    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane("", right)],
        right.times[keep],
        Space(ground=GROUND, window=WINDOW),
        title="A handle on a spring" if hung else "A handle in space",
        caption="Look whether it turns over when the right one does, and whether its energy stays.",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("energy", "%", energy, limits=(0.0, 250.0), colors=colors),
            Curves("stem, 1 upright, −1 upside down", "", upright, limits=(-1.1, 1.1), colors=colors[:-1]),
        ],
        numbers=[
            Number("energy at the end", tuple(100 * float(m.energy[-1]) / whole for m in motions), "%"),
        ],
    )  # fmt: skip


def _kept(count: int) -> Any:
    """At most ``MOST`` of the moments, first and last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, MOST)).astype(int))


def _pane(title: str, motion: SteppedHandle, keep: Any, hung: bool) -> Pane:
    # An R that is no rotation any more is drawn as the nearest one.
    turn = Rotation.from_matrix(motion.rotation[keep]).as_quat()
    x = motion.position[keep]
    tip = HANDLE_HALF_EXTENTS[0] * [1.0, 0.0, 0.0]
    tip = tip + HANDLE_CENTERS[0] - (HANDLE_CENTERS[1] - _stem())
    place = np.stack([x, x + Rotation.from_quat(turn).apply(tip)], axis=1)
    at = place[:, :1]
    shown = [
        Arrows("L", motion.angular_momentum[keep][:, None], "kg m²/s", at=at, scale=_scale(motion.angular_momentum),
               color="green"),
        Arrows("ω", motion.angular_velocity[keep][:, None], "rad/s", at=at, scale=0.02, color="vermillion"),
    ]  # fmt: skip
    held = motion.held[keep]
    spring = Segments("spring", held[:, :1], held[:, 1:], color="grey")
    return Pane(
        [handle_solid(), replace(ball(0.007, color="black"), what="mark on its end")],
        place,
        np.stack([turn, turn], axis=1),
        title=title,
        arrows=shown,
        segments=[spring] if hung else (),
        trails=[1],
    )


def _stem() -> Array:
    """From the centre to the middle of the stem, in body axes [m]."""
    return study.spring_arm() - HANDLE_HALF_EXTENTS[1] * [0.0, 1.0, 0.0]


def _scale(momentum: Array) -> float:
    """Metres for one unit, 1, 2 or 5 times a power of ten, by L at the start."""
    wanted = 0.17 / float(np.linalg.norm(momentum[0]))
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(s for s in (1, 2, 5) if s * power <= wanted))


def _ending(motions: list[SteppedHandle], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    names = ("the right one", attempt.short) if attempt else ("it",)
    said = [
        f"{name} has {shown_number(100 * float(m.energy[-1] / motions[0].energy[0]), 4)} %"
        for name, m in zip(names, motions, strict=True)
    ]
    return f"Of its energy at the start {', '.join(said)} after {SECONDS:g} s"
