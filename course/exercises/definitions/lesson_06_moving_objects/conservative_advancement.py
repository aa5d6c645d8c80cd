"""The exercise ``conservative_advancement``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

_ARGUMENTS = (
    Value("pivot", "(3,)", "m", "the end of the rod about which it turns"),
    Value("arm", "(3,)", "m", "from there to its other end, at the start"),
    Value("omega", "(3,)", "rad/s", "its angular velocity, which does not change"),
    Value("center", "(3,)", "m", "centre of the ball, which rests"),
    Value("radius", "scalar", "m", "of the ball"),
    Value("horizon", "scalar", "s", "how long the rod is followed"),
    Value("tolerance", "scalar", "m", "a gap that counts as none"),
)


def _case(*values: Any) -> dict[str, Any]:
    return {
        v.name: np.asarray(x, float) if v.shape == "(3,)" else float(x)
        for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _drawn(rng: np.random.Generator, tolerance: float) -> dict[str, Any]:
    """A rod in any place, whose spin leans; the ball lies on the way of some point of it.

    The tolerance is small: by another bound the time reached is another one, by less than is judged.
    """
    axis = unit_vector(rng)
    arm = np.cross(axis, unit_vector(rng))
    arm *= rng.uniform(0.8, 1.6) / np.linalg.norm(arm)
    arm += rng.uniform(0.1, 0.5) * axis
    angle, share = rng.uniform(0.8, 2.0), rng.uniform(0.3, 0.9)
    c, s = np.cos(angle), np.sin(angle)
    turned = c * arm + s * np.cross(axis, arm) + (1 - c) * (axis @ arm) * axis
    pivot, rate = rng.uniform(-2.0, 2.0, 3), rng.uniform(1.5, 4.0)
    radius = 0.1 * share
    return _case(
        pivot, arm, rate * axis, pivot + share * turned, radius, 5.0, tolerance
    )


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    zero, x, z = np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    return [
        Case("a rod of 2 m, a ball a quarter turn ahead", _case(zero, 2 * x, 2 * z, [0, 1.0, 0], 0.1, 3.0, 1e-9)),
        Case("a ball near the tip", _case(x, 2 * x, 1.5 * z, [0.9, 1.9, 0], 0.05, 3.0, 1e-9)),
        Case("drawn", _drawn(rng, 1e-9)),
        Case("a ball near the origin, far from the pivot", _case(2 * x, -2 * x, -z, [0.1, 0.6, 0], 0.05, 3.0, 1e-9)),
        Case("a fast one, a short horizon", _case(zero, 2 * x, 3 * z, [0.1, 1.9, 0], 0.05, 1.0, 1e-9)),
        Case("a slow one", _case(x, 0.8 * x, 0.5 * z, [1.3, 0.5, 0], 0.05, 9.0, 1e-9)),
        Case("drawn again", _drawn(rng, 1e-9)),
        Case("and again", _drawn(rng, 1e-9)),
        Case("the ball beyond its tip", _case(x, 2 * x, 3 * z, [1.0, 2.05, 0], 0.1, 3.0, 1e-9)),
        Case("the ball out of reach", _case(zero, 2 * x, 2 * z, [0, 3.0, 0], 0.5, 3.0, 1e-9), "edge"),
        Case("the ball behind the pivot", _case(zero, 2 * x, 2 * z, [-0.5, -0.2, 0], 0.1, 1.0, 1e-9), "edge"),
        Case("after the horizon", _case(zero, 2 * x, 2 * z, [0, 1.0, 0], 0.1, 0.5, 1e-9), "edge"),
        Case("touching at the start", _case(zero, 2 * x, 2 * z, [1.0, 0.25, 0], 0.25, 3.0, 1e-9), "edge"),
        Case("touching, and a horizon of 0", _case(zero, 2 * x, 2 * z, [1.0, 0.25, 0], 0.25, 0.0, 1e-9), "edge"),
        Case("at rest", _case(zero, 2 * x, zero, [0, 1.0, 0], 0.1, 3.0, 1e-9), "edge"),
        Case("nearer than the tolerance at the start", _case(zero, 2 * x, -z, [1.0, 0.375, 0], 0.25, 3.0, 0.125),
             "edge"),
        Case("at rest, and touching", _case(zero, 2 * x, zero, [1.0, 0.2, 0], 0.25, 3.0, 1e-9), "edge"),
    ]  # fmt: skip


def _wrong(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.conservative_advancement, *edits), message)


CONSERVATIVE_ADVANCEMENT = Exercise(
    name="conservative_advancement",
    level="stretch",
    rows=(12,),
    points=3,
    minutes=14,
    task="Return when a rod that turns about its end comes within the tolerance of a ball, by steps that cannot pass "
    "the impact.",
    arguments=_ARGUMENTS,
    results=(
        Value(
            "time",
            "scalar",
            "s",
            "the time reached, inf where they do not meet",
            relative=1e-6,
            absolute=1e-6,
        ),
    ),
    reference=formulas.conservative_advancement,
    cases=_cases,
    mistakes=(
        _wrong(
            "radius forgotten",
            " - radius",
            "",
            message="The distance to the ball's *centre* is no gap: its radius comes off.",
        ),
        _wrong(
            "a line without ends",
            "np.clip(way @ rod / (arm @ arm), 0, 1)",
            "way @ rod / (arm @ arm)",
            message="The foot of the perpendicular may lie beyond the rod's ends. The rod has ends: the share "
            "along it is "
            "held between 0 and 1.",
        ),
        _wrong(
            "speed of the middle",
            "gap / (rate * np.linalg.norm(arm))",
            "2 * gap / (rate * np.linalg.norm(arm))",
            message="You step by the speed of the rod's middle. Its tip is twice as fast, and may pass the ball within "
            "such a step: the bound must hold for every point.",
        ),
        _wrong(
            "arm forgotten",
            "gap / (rate * np.linalg.norm(arm))",
            "gap / rate",
            message="You divide metres by radians a second. The fastest point of the rod is its tip, |omega| |arm|.",
        ),
        _wrong(
            "the gap as a time",
            "gap / (rate * np.linalg.norm(arm))",
            "gap",
            message="You add a gap to a time. The step is the gap divided by the speed of the fastest point.",
        ),
        _wrong(
            "the other way",
            "+ s * np.cross(axis, arm)",
            "- s * np.cross(axis, arm)",
            message="Your rod turns the other way: it is cos(angle) arm + sin(angle) axis x arm + ...",
        ),
        _wrong(
            "small turns",
            "c, s = np.cos(rate * t), np.sin(rate * t)",
            "c, s = 1.0, rate * t",
            message="Your rod runs straight on instead of round: that holds for small turns only.",
        ),
        _wrong(
            "horizon forgotten",
            "while t <= horizon",
            "while t <= 40 * horizon",
            message="You follow the rod beyond the horizon.",
        ),
    ),  # fmt: skip
    hints=(
        "Three lines in a loop: where is the rod at t, how far is it from the ball, and how long can no point "
        "of it have "
        "come that far?",
        "The rod at t is given by turned(arm, omega, t). Its point nearest to the ball's centre is a share of it, "
        "way @ rod / (arm @ arm), held between 0 and 1. The fastest point is the tip, |omega| |arm|: where that is 0, "
        "the next time is inf.",
        "while t <= horizon:\n"
        "    rod = ____\n"
        "    along = np.clip(way @ rod / (arm @ arm), 0, 1)\n"
        "    gap = np.linalg.norm(way - along * rod) - ____\n"
        "    if gap <= tolerance:\n"
        "        return t\n"
        "    t = t + gap / ____ if rate > 0 else np.inf\n"
        "return np.inf",
    ),
)
