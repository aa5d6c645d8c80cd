"""The exercise ``rk4_step``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import I_BODY
from course.exercises.definitions.turning import drawn_vectors, inertias
from course.exercises.slips import slip


def _tops(
    rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any
) -> dict[str, Any]:
    return {
        "l": drawn_vectors(rng, shape, 2.0),
        "I_body": inertias(rng, shape),
        "h": 0.2,
        **fixed,
    }


RK4_STEP = Exercise(
    name="rk4_step",
    rows=(14,),
    points=2,
    minutes=12,
    level="stretch",
    task=(
        "Return l one step on by the classical Runge-Kutta method; without torque l changes at the rate l x "
        "I_body^-1 l."
    ),
    arguments=(
        Value("l", "(..., 3)", "kg m²/s", "angular momentum in body axes"),
        I_BODY,
        Value("h", "scalar", "s", "the step"),
    ),
    results=(Value("l", "(..., 3)", "kg m²/s"),),
    reference=formulas.rk4_step,
    cases=lambda rng: [
        Case(
            "moments 1, 2, 3",
            {
                "l": np.array([1.0, 4.0, 0.0]),
                "I_body": np.diag([1.0, 2.0, 3.0]),
                "h": 0.1,
            },
        ),
        Case("axes that are not principal", _tops(rng, ())),
        Case(
            "about a principal axis",
            {
                "l": np.array([0.0, 4.0, 0.0]),
                "I_body": np.diag([1.0, 2.0, 3.0]),
                "h": 0.1,
            },
            "edge",
        ),
        Case("a step back in time", _tops(rng, (), h=-0.2), "edge"),
        Case("five tops", _tops(rng, (5,)), "batch"),
        Case(
            "three tops, as many as a vector has components", _tops(rng, (3,)), "batch"
        ),
        Case("a 2 by 4 batch", _tops(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    mistakes=(
        Mistake(
            "sign of the rate",
            slip(formulas.rk4_step, "return np.cross", "return -np.cross"),
            "The rate is omega x l; without torque it is l x omega in body axes: L stands still and the body turns "
            "away under it.",
        ),
        Mistake(
            "equal weights",
            slip(
                formulas.rk4_step,
                "h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)",
                "h / 4 * (k1 + k2 + k3 + k4)",
            ),
            "All four rates count the same. The two in the middle of the step count twice: (k1 + 2 k2 + 2 k3 + "
            "k4)/6.",
        ),
        Mistake(
            "one of each, over six",
            slip(formulas.rk4_step, "2 * k2 + 2 * k3", "k2 + k3"),
            "The two rates in the middle count twice, k1 + 2 k2 + 2 k3 + k4: only then is a sixth of the sum a mean.",
        ),
        Mistake(
            "the change alone",
            slip(formulas.rk4_step, "l + h / 6", "h / 6"),
            "This is the change of l. Add it to the l from before the step.",
        ),
        Mistake(
            "k2 at the end",
            slip(formulas.rk4_step, "h / 2 * k1", "h * k1"),
            "k2 is taken at the end of the step. It belongs in its middle, at l + h/2 k1.",
        ),
        Mistake(
            "I in place of its inverse",
            slip(
                formulas.rk4_step,
                "np.linalg.solve(I_body, l[..., None])[..., 0]",
                "(I_body @ l[..., None])[..., 0]",
            ),
            "You multiply l by I_body. omega is I_body^-1 l: solve for it.",
        ),
        Mistake(
            "I @ l",
            slip(
                formulas.rk4_step,
                "np.linalg.solve(I_body, l[..., None])[..., 0]",
                "I_body @ l",
            ),
            "You multiply l by I_body. omega is I_body^-1 l: solve for it, each l as a column, so that a batch works "
            "too.",
        ),
        Mistake(
            "solve without a column",
            slip(
                formulas.rk4_step,
                "np.linalg.solve(I_body, l[..., None])[..., 0]",
                "np.linalg.solve(I_body, l)",
            ),
            "Right for one body, not for a batch: np.linalg.solve takes a batch of vectors for one matrix. Make each "
            "a column and take it back: np.linalg.solve(I_body, l[..., None])[..., 0].",
        ),
        Mistake(
            "explicit Euler",
            slip(formulas.rk4_step, "h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)", "h * k1"),
            "This is explicit Euler, the first of the four rates alone.",
        ),
        Mistake(
            "midpoint",
            slip(formulas.rk4_step, "h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)", "h * k2"),
            "This is the midpoint method, of order 2: two of the four rates are missing.",
        ),
        Mistake(
            "full steps",
            slip(formulas.rk4_step, "h / 2 * k1", "h * k1", "h / 2 * k2", "h * k2"),
            "k2 and k3 are taken at the end of the step. They belong in its middle: l + h/2 k1 and l + h/2 k2.",
        ),
        Mistake(
            "half at the end",
            slip(formulas.rk4_step, "h * k3", "h / 2 * k3"),
            "k4 is taken in the middle of the step. It belongs at its end: l + h k3.",
        ),
        Mistake(
            "all from k1",
            slip(formulas.rk4_step, "h / 2 * k2", "h / 2 * k1", "h * k3", "h * k1"),
            "k3 and k4 start from k1. Each rate is taken where the one *before* it leads: k3 at l + h/2 k2, k4 at "
            "l + h k3.",
        ),
        Mistake(
            "a quarter of the sum",
            slip(formulas.rk4_step, "h / 6", "h / 4"),
            "You divide by 4, but the weights 1, 2, 2, 1 add up to 6.",
        ),
        Mistake(
            "sixth forgotten",
            slip(formulas.rk4_step, "h / 6", "h"),
            "The weights 1, 2, 2, 1 add up to 6: divide by 6, or the step is six steps long.",
        ),
    ),
    hints=(
        "Write the rate as a function of l first; RK4 calls it four times.",
        "k1 at the start, k2 and k3 in the middle (each from the one before), k4 at the end; then their mean with "
        "the weights 1, 2, 2, 1.",
        "k1 = rate_of(l)\nk2 = rate_of(l + h / 2 * k1)\nk3 = rate_of(____)\nk4 = rate_of(____)\n"
        "return l + h / 6 * (k1 + ____ * k2 + ____ * k3 + k4)",
    ),
)
