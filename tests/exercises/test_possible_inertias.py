"""Every inertia that an exercise hands out is one that a body can have.

With the second moments s_x = sum m x^2 and so on along the principal axes, I_1 = s_y + s_z and so on round
(H. Goldstein, Classical Mechanics, 3rd ed., section 5.3), so no principal moment exceeds the sum of the other two.
"""

import numpy as np
import pytest

from course.exercises.definition import Exercise, all_lessons

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]
SEEDS = (None, *range(40))
#: Those that take inertias today; a new one is found by its units or names, and one that is lost is missed here.
KNOWN = {
    "sigma", "world_inertia", "angular_acceleration", "symplectic_euler_step", "rk4_step", "effective_mass",
    "apply_impulse", "angular_acceleration_free", "point_response", "contact_matrix_entry", "contact_matrix",
}  # fmt: skip


def moments_of(matrices, *, inverse: bool) -> np.ndarray:
    """Principal moments (k, 3), least first, of those bodies whose matrix is not zero (fixed ones are zero)."""
    matrices = np.asarray(matrices, dtype=float).reshape(-1, 3, 3)
    assert np.array_equal(matrices, np.swapaxes(matrices, 1, 2))
    values = np.linalg.eigvalsh(matrices[np.any(matrices != 0, axis=(1, 2))])
    assert np.all(values > 0)
    return 1 / values[:, ::-1] if inverse else values


def moments_in(exercise: Exercise, arguments) -> list[np.ndarray]:
    """The principal moments of all inertias among the arguments, told by units, and by names inside a tuple."""
    found, single = [], []
    for value in exercise.arguments:
        given, unit = arguments[value.name], value.unit.replace("²", "^2")
        if isinstance(given, tuple):
            names = value.shape.strip("()").split(", ")
            found += [
                moments_of(part, inverse=name.startswith("inverse"))
                for name, part in zip(names, given, strict=False)
                if "inertia" in name
            ]
        elif value.own_axes == 2 and "kg m^2" in unit:
            found.append(moments_of(given, inverse=unit.startswith("1/")))
        elif value.shape == "scalar" and unit == "kg m^2":
            single.append(np.atleast_1d(given))
    return found + ([np.sort(np.stack(single, axis=-1), axis=-1)] if single else [])


def excess(moments: np.ndarray) -> np.ndarray:
    """By how much the largest exceeds the sum of the others, as a part of all three; 0 for a flat body."""
    return (moments[:, 2] - moments[:, 0] - moments[:, 1]) / moments.sum(axis=1)


@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda e: e.name)
@pytest.mark.long
def test_every_inertia_is_one_that_a_body_can_have(exercise):
    every = [
        (f"seed {seed}, {case.label}", moments)
        for seed in SEEDS
        for case in exercise.draw(seed)
        for moments in moments_in(exercise, case.arguments)
    ]
    assert bool(every) == (exercise.name in KNOWN), (
        "inertias found where none are known, or none where some are"
    )
    impossible = {label: moments[excess(moments) > 1e-12] for label, moments in every}
    assert {
        label: moments for label, moments in impossible.items() if len(moments)
    } == {}


def test_an_impossible_inertia_is_seen():
    """The counterexample by hand, and most of what positive matrices drawn at random say."""
    assert excess(moments_of(np.diag([0.5, 1.0, 2.0]), inverse=True)) == pytest.approx(
        0.5 / 3.5
    )
    assert excess(moments_of(np.diag([1.0, 2.0, 3.0]), inverse=False)) == 0
    root = np.random.default_rng(4).normal(size=(500, 3, 3))
    assert (
        np.mean(excess(moments_of(root @ np.swapaxes(root, 1, 2), inverse=False)) > 0)
        > 0.8
    )
