"""The exercise ``rod_impulse``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import drawn_number
from course.exercises.slips import slip

# rod_impulse, the student's step of the derivation.


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
    reference=formulas.rod_impulse,
    cases=_rods,
    mistakes=(
        Mistake(
            "inertia about the end",
            slip(formulas.rod_impulse, "/ 12", "/ 3"),
            "You took m ell^2/3, the inertia of a rod about its end. Here the arm is measured from the centre of mass, "
            "and about that point the rod has m ell^2/12.",
        ),
        Mistake(
            "arm of the whole length",
            slip(formulas.rod_impulse, "ell / 2", "ell"),
            "Your arm is the whole length. It runs from the centre of mass to the end: half the length.",
        ),
        Mistake(
            "sine",
            slip(formulas.rod_impulse, "sp.cos", "sp.sin"),
            "You have the sine where the cosine belongs. Only the part of the arm across n turns the rod, and n points "
            "up: look at the upright rod, which is not turned at all.",
        ),
        Mistake(
            "not squared",
            slip(
                formulas.rod_impulse,
                "(ell / 2 * sp.cos(theta)) ** 2",
                "(ell / 2) ** 2 * sp.cos(theta)",
            ),
            "The lever counts twice: a longer one gives more spin, and each bit of spin moves the point more. So its "
            "square stands in the effective mass.",
        ),
        Mistake(
            "angle left out",
            slip(formulas.rod_impulse, " * sp.cos(theta)", ""),
            "Right for the level rod only. At an angle the lever r x n is shorter than half the length.",
        ),
        Mistake(
            "spin left out",
            slip(
                formulas.rod_impulse,
                " + (ell / 2 * sp.cos(theta)) ** 2 / (m * ell**2 / 12)",
                "",
            ),
            "This is the impulse on a body that cannot turn. Divide by 1/m and what turning adds to it.",
        ),
        Mistake(
            "only turning",
            slip(formulas.rod_impulse, "1 / m + ", ""),
            "You divide by what turning adds, and 1/m is missing: the end gives way by moving and by turning.",
        ),
        Mistake(
            "multiplied by the inertia",
            slip(formulas.rod_impulse, "** 2 / (m", "** 2 * (m"),
            "You multiply the lever's square by the inertia. It is the *inverse* inertia that stands there: a "
            "body that is hard to turn gives way less.",
        ),
        Mistake(
            "upside down",
            slip(formulas.rod_impulse, "v / (1", "v * (1"),
            "You multiply by 1/mu. The impulse is -(1 + e) u mu; look at the unit, which must be kg m/s.",
        ),
        Mistake(
            "only e",
            slip(formulas.rod_impulse, "(1 + e)", "e"),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends the end back.",
        ),
        Mistake(
            "no e",
            slip(formulas.rod_impulse, "(1 + e) * ", ""),
            "e is missing: this impulse stops the end and no more.",
        ),
        Mistake(
            "sign",
            slip(formulas.rod_impulse, "(1 + e)", "-(1 + e)"),
            "Your impulse points down. The end falls, so u = -v is negative and -(1 + e) u mu is positive: the floor "
            "pushes up.",
        ),
    ),
    hints=(
        "Everything is in the box above: u, r x n and I of this rod. u is the velocity of the end along n before.",
        "r = (ell/2)(cos theta, 0, -sin theta) and n = (0, 0, 1), so r x n has the length (ell/2) cos theta. "
        "1/mu is 1/m plus that length squared over I = m ell^2/12.",
        "rod_impulse = (1 + e) * ____ / (1 / m + (ell / 2 * sp.cos(theta)) ** 2 / (____))",
    ),
)
