"""The exercise ``rod_impulse``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import drawn_number

# rod_impulse, the student's step of the derivation.


def _rod_impulse(m: Any, v: Any, theta: Any, e: Any, ell: Any) -> Any:
    return (1 + e) * m * v / (1 + 3 * _cosine(theta) ** 2)


def _cosine(angle: Any) -> Any:
    if hasattr(
        angle, "free_symbols"
    ):  # the reference is lent in the student's own symbols
        import sympy

        return sympy.cos(angle)
    return np.cos(angle)


def _rod(
    *, factor: Any = lambda e: 1 + e, bracket: Any = lambda c, s: 1 + 3 * c**2
) -> Any:
    def function(m: Any, v: Any, theta: Any, e: Any, ell: Any) -> Any:
        return factor(e) * m * v / bracket(np.cos(theta), np.sin(theta))

    return function


def _rods(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "m": drawn_number(rng, (8,), 0.5, 3.0),
        "v": drawn_number(rng, (8,), 0.5, 4.0),
        "theta": drawn_number(rng, (8,), 0.2, 1.3),
        "e": drawn_number(rng, (8,), 0.2, 0.9),
        "ell": drawn_number(rng, (8,), 1.2, 3.0),
    }
    return [
        Case("a level rod", {"m": 1.0, "v": 1.0, "theta": 0.0, "e": 0.5, "ell": 2.0}),
        Case(
            "an inclined rod",
            {name: float(values[0]) for name, values in draws.items()},
        ),
        Case("eight drawn rods", draws, "batch"),
    ]


ROD_IMPULSE = Exercise(
    name="rod_impulse",
    kind="expression",
    rows=(17, 18),
    points=2,
    minutes=8,
    task="Give the impulse on the lower end of a rod that falls at speed v, at an angle theta from the horizontal.",
    arguments=(
        Value("m", "scalar", "kg", "mass of the rod"),
        Value("v", "scalar", "m/s", "speed at which it falls"),
        Value("theta", "scalar", "rad", "angle of the rod from the horizontal"),
        Value("e", "scalar", "", "restitution"),
        Value("ell", "scalar", "m", "length of the rod; it need not occur"),
    ),
    results=(Value("rod_impulse", "(...)", "N s", "impulse of the floor, upward"),),
    reference=_rod_impulse,
    cases=_rods,
    mistakes=(
        Mistake(
            "inertia about the end",
            _rod(bracket=lambda c, s: 1 + 0.75 * c**2),
            "You took m ell^2/3, the inertia of a rod about its end. Here the arm is measured from the centre of mass, "
            "and about that point the rod has m ell^2/12.",
        ),
        Mistake(
            "arm of the whole length",
            _rod(bracket=lambda c, s: 1 + 12 * c**2),
            "Your arm is the whole length. It runs from the centre of mass to the end: half the length.",
        ),
        Mistake(
            "sine",
            _rod(bracket=lambda c, s: 1 + 3 * s**2),
            "You have the sine where the cosine belongs. Only the part of the arm across n turns the rod, and n points "
            "up: look at the upright rod, which is not turned at all.",
        ),
        Mistake(
            "not squared",
            _rod(bracket=lambda c, s: 1 + 3 * c),
            "The lever counts twice: a longer one gives more spin, and each bit of spin moves the point more. So its "
            "square stands in the effective mass.",
        ),
        Mistake(
            "angle left out",
            _rod(bracket=lambda c, s: 4 + 0 * c),
            "Right for the level rod only. At an angle the lever r x n is shorter than half the length.",
        ),
        Mistake(
            "spin left out",
            _rod(bracket=lambda c, s: 1 + 0 * c),
            "This is the impulse on a body that cannot turn. Divide by 1/m and what turning adds to it.",
        ),
        Mistake(
            "only turning",
            _rod(bracket=lambda c, s: 3 * c**2),
            "You divide by what turning adds, and 1/m is missing: the end gives way by moving and by turning.",
        ),
        Mistake(
            "multiplied by the inertia",
            lambda m, v, theta, e, ell: (
                (1 + e)
                * v
                / (1 / m + (0.5 * ell * np.cos(theta)) ** 2 * (m * ell**2 / 12))
            ),
            "You multiply the lever's square by the inertia. It is the *inverse* inertia that stands there: a "
            "body that is hard to turn gives way less.",
        ),
        Mistake(
            "upside down",
            lambda m, v, theta, e, ell: (
                (1 + e) * v * (1 / m) * (1 + 3 * np.cos(theta) ** 2)
            ),
            "You multiply by 1/mu. The impulse is -(1 + e) u mu; look at the unit, which must be kg m/s.",
        ),
        Mistake(
            "only e",
            _rod(factor=lambda e: e),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends the end back.",
        ),
        Mistake(
            "no e",
            _rod(factor=lambda e: 1 + 0 * e),
            "e is missing: this impulse stops the end and no more.",
        ),
        Mistake(
            "sign",
            _rod(factor=lambda e: -(1 + e)),
            "Your impulse points down. The end falls, so u = -v is negative and -(1 + e) u mu is positive: the floor "
            "pushes up.",
        ),
    ),
    hints=(
        "Everything is in the box above: u, r x n and I of this rod. u is the velocity of the end along n before.",
        "r = (ell/2)(cos theta, 0, -sin theta) and n = (0, 0, 1), so r x n has the length (ell/2) cos theta. "
        "1/mu is 1/m plus that length squared over I = m ell^2/12.",
        "lever = ell / 2 * sp.cos(theta)\nrod_impulse = (1 + e) * ____ / (1 / m + lever**2 / (____))",
    ),
)
