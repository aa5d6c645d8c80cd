"""The exercise ``rk4_step``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import I_BODY
from course.exercises.definitions.turning import drawn_vectors, inertias, solved, times


def rate_of_l(l: Any, I_body: Any, sign: float = 1.0) -> np.ndarray:  # noqa: E741
    return sign * np.cross(l, solved(I_body, l))


def runge_kutta(
    nodes: Sequence[float], weights: Sequence[float], *, sign: float = 1.0
) -> Callable[..., Any]:
    """Each stage ``nodes[i]`` h along the one before it; the step along the weighted stages."""

    def function(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
        start = np.asarray(l, dtype=float)
        stages = [rate_of_l(start, I_body, sign)]
        for node in nodes:
            stages.append(rate_of_l(start + node * h * stages[-1], I_body, sign))
        return start + h * sum(w * s for w, s in zip(weights, stages, strict=True))

    return function


def all_from_the_first(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    start = np.asarray(l, dtype=float)
    k1 = rate_of_l(start, I_body)
    k2 = k3 = rate_of_l(start + 0.5 * h * k1, I_body)
    k4 = rate_of_l(start + h * k1, I_body)
    return start + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def weighed_alike(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return runge_kutta(_FOUR, (1 / 6, 1 / 6, 1 / 6, 1 / 6))(l, I_body, h)


def change_alone(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return runge_kutta(_FOUR, _WEIGHTS)(l, I_body, h) - l


def second_at_the_end(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return runge_kutta((1.0, 0.5, 1.0), _WEIGHTS)(l, I_body, h)


def times_the_inertia(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return _four_of(lambda at: np.cross(at, times(I_body, at)), l, h)


def times_the_inertia_of_one(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return _four_of(lambda at: np.cross(at, np.asarray(I_body) @ at), l, h)


def without_a_column(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    return _four_of(lambda at: np.cross(at, np.linalg.solve(I_body, at)), l, h)


def _four_of(rate: Callable[[np.ndarray], np.ndarray], l: Any, h: float) -> np.ndarray:  # noqa: E741
    start = np.asarray(l, dtype=float)
    k1 = rate(start)
    k2 = rate(start + 0.5 * h * k1)
    k3 = rate(start + 0.5 * h * k2)
    return start + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(start + h * k3))


def _tops(
    rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any
) -> dict[str, Any]:
    return {
        "l": drawn_vectors(rng, shape, 2.0),
        "I_body": inertias(rng, shape),
        "h": 0.2,
        **fixed,
    }


_FOUR, _WEIGHTS = (0.5, 0.5, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)

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
    reference=runge_kutta(_FOUR, _WEIGHTS),
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
            runge_kutta(_FOUR, _WEIGHTS, sign=-1.0),
            "The rate is omega x l; without torque it is l x omega in body axes: L stands still and the body turns "
            "away under it.",
        ),
        Mistake(
            "equal weights",
            runge_kutta(_FOUR, (0.25, 0.25, 0.25, 0.25)),
            "All four rates count the same. The two in the middle of the step count twice: (k1 + 2 k2 + 2 k3 + "
            "k4)/6.",
        ),
        Mistake(
            "one of each, over six",
            weighed_alike,
            "The two rates in the middle count twice, k1 + 2 k2 + 2 k3 + k4: only then is a sixth of the sum a mean.",
        ),
        Mistake(
            "the change alone",
            change_alone,
            "This is the change of l. Add it to the l from before the step.",
        ),
        Mistake(
            "k2 at the end",
            second_at_the_end,
            "k2 is taken at the end of the step. It belongs in its middle, at l + h/2 k1.",
        ),
        Mistake(
            "I in place of its inverse",
            times_the_inertia,
            "You multiply l by I_body. omega is I_body^-1 l: solve for it.",
        ),
        Mistake(
            "I @ l",
            times_the_inertia_of_one,
            "You multiply l by I_body. omega is I_body^-1 l: solve for it, each l as a column, so that a batch works "
            "too.",
        ),
        Mistake(
            "solve without a column",
            without_a_column,
            "Right for one body, not for a batch: np.linalg.solve takes a batch of vectors for one matrix. Make each "
            "a column and take it back: np.linalg.solve(I_body, l[..., None])[..., 0].",
        ),
        Mistake(
            "explicit Euler",
            runge_kutta((), (1.0,)),
            "This is explicit Euler, the first of the four rates alone.",
        ),
        Mistake(
            "midpoint",
            runge_kutta((0.5,), (0.0, 1.0)),
            "This is the midpoint method, of order 2: two of the four rates are missing.",
        ),
        Mistake(
            "full steps",
            runge_kutta((1.0, 1.0, 1.0), _WEIGHTS),
            "k2 and k3 are taken at the end of the step. They belong in its middle: l + h/2 k1 and l + h/2 k2.",
        ),
        Mistake(
            "half at the end",
            runge_kutta((0.5, 0.5, 0.5), _WEIGHTS),
            "k4 is taken in the middle of the step. It belongs at its end: l + h k3.",
        ),
        Mistake(
            "all from k1",
            all_from_the_first,
            "k3 and k4 start from k1. Each rate is taken where the one *before* it leads: k3 at l + h/2 k2, k4 at "
            "l + h k3.",
        ),
        Mistake(
            "a quarter of the sum",
            runge_kutta(_FOUR, (0.25, 0.5, 0.5, 0.25)),
            "You divide by 4, but the weights 1, 2, 2, 1 add up to 6.",
        ),
        Mistake(
            "sixth forgotten",
            runge_kutta(_FOUR, (1.0, 2.0, 2.0, 1.0)),
            "The weights 1, 2, 2, 1 add up to 6: divide by 6, or the step is six steps long.",
        ),
    ),
    hints=(
        "Write the rate as a function of l first; RK4 calls it four times.",
        "k1 at the start, k2 and k3 in the middle (each from the one before), k4 at the end; then their mean with "
        "the weights 1, 2, 2, 1.",
        "k1 = rate(l)\nk2 = rate(l + h / 2 * k1)\nk3 = rate(____)\nk4 = rate(____)\n"
        "return l + h / 6 * (k1 + ____ * k2 + ____ * k3 + k4)",
    ),
)
