"""The exercise ``effective_mass``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    NORMAL,
    drawn_inverse_inertia,
    drawn_number,
    drawn_vector,
    times,
    unit_vector,
)
from course.exercises.definitions.vectors import dot
from course.exercises.slips import slip


def _apart(
    rng: np.random.Generator,
    draw: Callable[[], dict[str, Any]],
    good: Callable[[dict[str, Any]], Any],
) -> Any:
    """Draw until the case serves."""
    for _ in range(1000):
        case = draw()
        if np.all(good(case)):
            return case
    raise RuntimeError("no case found")


def _bodies(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> dict[str, Any]:
    return {
        "inverse_mass_1": drawn_number(rng, shape, 0.3, 1.0),
        "inverse_mass_2": drawn_number(rng, shape, 1.2, 2.0),
        "inverse_inertia_1": drawn_inverse_inertia(rng, shape, 0.6),
        "inverse_inertia_2": drawn_inverse_inertia(rng, shape, 0.2),
        "arm_1": drawn_vector(rng, shape),
        "arm_2": drawn_vector(rng, shape, 0.7),
        "normal": unit_vector(rng, shape),
    }


def _share(case: dict[str, Any], body: int) -> Any:
    lever = np.cross(case[f"arm_{body}"], case["normal"])
    return dot(lever, times(case[f"inverse_inertia_{body}"], lever))


def _told_apart(case: dict[str, Any]) -> Any:
    """Both bodies turn, and not so much that a sign slip makes 1/mu zero or hides
    beside rounding.
    """
    masses = np.asarray(case["inverse_mass_1"]) + case["inverse_mass_2"]
    one, two = _share(case, 1), _share(case, 2)
    away = (np.abs(masses - one - two) > 0.1) & (np.abs(masses + one - two) > 0.1)
    return (one > 0.05) & (two > 0.02) & away


ROD = {
    "inverse_mass_1": 1.0,
    "inverse_mass_2": 0.0,
    "inverse_inertia_1": np.diag([100.0, 12.0, 12.0]),
    "inverse_inertia_2": np.zeros((3, 3)),
    "arm_1": np.array([0.5, 0.0, 0.0]),
    "arm_2": np.zeros(3),
    "normal": np.array([0.0, 0.0, 1.0]),
}


def _masses(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        found: dict[str, Any] = _apart(rng, lambda: _bodies(rng, shape), _told_apart)
        return found

    central = drawn()
    central = {
        **central,
        "arm_1": -0.5 * central["normal"],
        "arm_2": 0.25 * central["normal"],
    }
    fixed_1, fixed_2 = drawn(), drawn()
    fixed_1 |= {"inverse_mass_1": 0.0, "inverse_inertia_1": np.zeros((3, 3))}
    fixed_2 |= {"inverse_mass_2": 0.0, "inverse_inertia_2": np.zeros((3, 3))}
    some_fixed = drawn((4,))
    free = np.array([1.0, 0.0, 1.0, 0.0])
    some_fixed["inverse_mass_2"] = some_fixed["inverse_mass_2"] * free
    some_fixed["inverse_inertia_2"] = (
        some_fixed["inverse_inertia_2"] * free[:, None, None]
    )
    return [
        Case("a rod of 1 kg and 1 m on a floor, hit at its end", ROD),
        Case("two bodies that turn", drawn()),
        Case("two other bodies", drawn()),
        Case("two more", drawn()),
        Case("both arms along the normal", central, "edge"),
        Case("body 2 is fixed", fixed_2, "edge"),
        Case("body 1 is fixed", fixed_1, "edge"),
        Case("three pairs, as many as a vector has components", drawn((3,)), "batch"),
        Case("five pairs", drawn((5,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("four pairs, in two of them body 2 is fixed", some_fixed, "batch"),
    ]


EFFECTIVE_MASS = Exercise(
    name="effective_mass",
    rows=(17, 22),
    points=3,
    minutes=10,
    task="Return mu, the mass that an impulse along n feels at a contact of two bodies that turn.",
    arguments=(
        Value("inverse_mass_1", "(...)", "1/kg", "1/m of body 1; 0 for a fixed body"),
        Value("inverse_mass_2", "(...)", "1/kg", "1/m of body 2; 0 for a fixed body"),
        Value(
            "inverse_inertia_1",
            "(..., 3, 3)",
            "1/(kg m²)",
            "I^-1 of body 1, world axes; zeros if it is fixed",
        ),
        Value(
            "inverse_inertia_2", "(..., 3, 3)", "1/(kg m²)", "I^-1 of body 2, likewise"
        ),
        Value("arm_1", "(..., 3)", "m", "from the centre of body 1 to the contact"),
        Value("arm_2", "(..., 3)", "m", "from the centre of body 2 to the contact"),
        NORMAL,
    ),
    results=(Value("effective_mass", "(...)", "kg"),),
    reference=formulas.effective_mass,
    cases=_masses,
    properties=(
        Property(
            "no more than without spin",
            lambda given, answer: np.maximum(
                answer * (np.asarray(given["inverse_mass_1"]) + given["inverse_mass_2"])
                - 1,
                0.0,
            ),
            "It feels heavier than if the bodies could not turn. Turning only makes a point give way more: each term "
            "adds to 1/mu.",
        ),
    ),
    mistakes=(
        Mistake(
            "one over forgotten",
            slip(formulas.effective_mass, "1 / inverse", "inverse"),
            "This is 1/mu, in 1/kg. Return one over it.",
        ),
        Mistake(
            "spin left out",
            slip(
                formulas.effective_mass,
                "inverse + np.sum(lever * turned, axis=-1)",
                "inverse",
            ),
            "This is 1/(1/m1 + 1/m2), the mass felt by an impulse through both centres. Add what turning contributes "
            "to 1/mu for each body.",
        ),
        Mistake(
            "only body 1 turns",
            slip(formulas.effective_mass, ", (inverse_inertia_2, arm_2)", ","),
            "Only body 1 turns in your formula. Body 2 gives way by turning as well, unless it is fixed.",
        ),
        Mistake(
            "only body 2 turns",
            slip(
                formulas.effective_mass,
                "(inverse_inertia_1, arm_1), (inverse_inertia_2, arm_2)",
                "(inverse_inertia_2, arm_2),",
            ),
            "Only body 2 turns in your formula. Body 1 gives way by turning as well.",
        ),
        Mistake(
            "body 2's sign",
            slip(formulas.effective_mass, "(inverse_inertia_2", "(-inverse_inertia_2"),
            "Body 2's term is subtracted. Body 2 gets the opposite impulse, and its motion is subtracted from that of "
            "body 1: two minus signs, so its term adds to 1/mu.",
        ),
        Mistake(
            "both signs",
            slip(formulas.effective_mass, "inverse + np.sum", "inverse - np.sum"),
            "The turning terms are subtracted: a cross product stands in the wrong order. (I^-1 (r x n)) x r is the "
            "velocity the turning gives the point; r x (I^-1 (r x n)) is the opposite.",
        ),
        Mistake(
            "r where r x n belongs",
            slip(formulas.effective_mass, "np.cross(arm, normal)", "arm"),
            "You put the arm itself on both sides of I^-1. What turns a body is the lever r x n: an arm along n does "
            "nothing.",
        ),
        Mistake(
            "entry by entry",
            slip(formulas.effective_mass, "np.cross(arm, normal)", "arm * normal"),
            "Your lever is r times n, entry by entry. The cross product is np.cross(r, n).",
        ),
        Mistake(
            "only the diagonal",
            slip(
                formulas.effective_mass,
                "(inverse_inertia @ lever[..., None])[..., 0]",
                "np.diagonal(inverse_inertia, axis1=-2, axis2=-1) * lever",
            ),
            "You use only the diagonal of the inverse inertia. It is diagonal in the body's own axes, but a body that "
            "has turned has in general a full matrix in world axes.",
        ),
        Mistake(
            "inverse undone",
            slip(
                formulas.effective_mass,
                "(inverse_inertia @ lever[..., None])[..., 0]",
                "np.linalg.solve(inverse_inertia, lever[..., None])[..., 0]",
            ),
            "You divide by the matrix that is already inverted, and so multiply by the inertia. The argument is I^-1: "
            "multiply by it.",
        ),
        Mistake(
            "second lever forgotten",
            slip(
                formulas.effective_mass,
                "np.sum(lever * turned, axis=-1)",
                "np.linalg.norm(turned, axis=-1)",
            ),
            "You add the length of I^-1 (r x n), which is a spin per impulse. The point moves by that spin times its "
            "lever: dot it with r x n once more.",
        ),
        Mistake(
            "masses not inverse",
            slip(
                formulas.effective_mass,
                "inverse_mass_1 + inverse_mass_2",
                "1 / np.asarray(inverse_mass_1) + 1 / np.asarray(inverse_mass_2)",
            ),
            "You invert the masses again. The arguments are inverse masses already, so that a fixed body is a plain 0: "
            "add them.",
        ),
        Mistake(
            "masses not inverse, plain numbers",
            slip(
                formulas.effective_mass,
                "inverse_mass_1 + inverse_mass_2",
                "1 / inverse_mass_1 + 1 / inverse_mass_2",
            ),
            "The masses come inverse, and a fixed body's is 0: that is why yours stops at 1/0. Add the inverse masses "
            "as they are.",
        ),
        Mistake(
            "to masses and back",
            slip(
                formulas.effective_mass,
                "inverse_mass_1 + inverse_mass_2",
                "1 / (1 / inverse_mass_1) + 1 / (1 / inverse_mass_2)",
            ),
            "Right where both bodies are free. You turn the inverse masses into masses first, and a fixed body, whose "
            "inverse mass is 0, has none to compute: 1/mu needs 1/m only.",
        ),
        Mistake(
            "matrix times vector in a batch",
            slip(
                formulas.effective_mass,
                "(inverse_inertia @ lever[..., None])[..., 0]",
                "inverse_inertia @ lever",
            ),
            "Right for one pair. In a batch `matrix @ vector` takes the vectors for a matrix: write "
            "(matrix @ vector[..., None])[..., 0].",
        ),
    ),  # fmt: skip
    hints=(
        "The last line of the derivation gives 1/mu: four terms, one for each way of giving way. Return one over their "
        "sum.",
        "For each body take the lever r x n, multiply the inverse inertia by it, and dot the result with the lever. "
        "Matrix times vector in a batch is (matrix @ vector[..., None])[..., 0].",
        "inverse = inverse_mass_1 + inverse_mass_2\n"
        "for inverse_inertia, arm in ((inverse_inertia_1, arm_1), (____, ____)):\n"
        "    lever = np.cross(____, ____)\n"
        "    turned = (inverse_inertia @ lever[..., None])[..., 0]\n"
        "    inverse = inverse + np.sum(____, axis=-1)\n"
        "return 1 / inverse",
    ),
)
