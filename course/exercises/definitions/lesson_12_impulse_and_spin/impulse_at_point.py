"""The exercise ``impulse_at_point``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    NORMAL,
    drawn_number,
    drawn_vector,
    scaled,
    unit_vector,
)
from course.exercises.slips import slip

RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")


def _hits(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(
        shape: tuple[int, ...] = (), *, closing: Any = None, **fixed: Any
    ) -> dict[str, Any]:
        normal, second = unit_vector(rng, shape), drawn_vector(rng, shape)
        closing = drawn_number(rng, shape, 0.5, 3.0) if closing is None else closing
        slide = np.cross(normal, drawn_vector(rng, shape))
        hit = {
            "point_velocity_1": np.round(second - scaled(closing, normal) + slide, 3),
            "point_velocity_2": second,
            "normal": normal,
            "mass_felt": drawn_number(rng, shape, 0.3, 0.9),
            "restitution": drawn_number(rng, shape, 0.3, 0.8),
        }
        return hit | fixed

    together = {
        **drawn(),
        "point_velocity_1": np.array([1.0, 2.0, 0.5]),
        "point_velocity_2": np.array([1.0, 2.0, 0.5]),
    }
    mixed = np.round(rng.uniform(-2.0, 2.0, 6), 2)
    mixed[:2] = 1.0, -1.0
    level = {
        "point_velocity_1": np.array([0.0, 0.0, -1.0]),
        "point_velocity_2": np.zeros(3),
        "normal": np.array([0.0, 0.0, 1.0]),
        "mass_felt": 0.25,
        "restitution": 1.0,
    }
    return [
        Case("the level rod on its end", level),
        Case("off the axes", drawn()),
        Case("off the axes again", drawn()),
        Case("the points already part", drawn(closing=-1.5), "edge"),
        Case("the points move together", together, "edge"),
        Case("nothing comes back, e = 0", drawn(restitution=0.0), "edge"),
        Case(
            "three contacts, as many as a vector has components", drawn((3,)), "batch"
        ),
        Case("six contacts", drawn((6,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("some approach, some part", drawn((6,), closing=mixed), "batch"),
        Case("the points approach slowly", drawn(closing=0.1)),
        Case("the points part slowly", drawn(closing=-0.1), "edge"),
    ]


IMPULSE_AT_POINT = Exercise(
    name="impulse_at_point",
    rows=(17, 22),
    points=2,
    minutes=5,
    task="Return p_hat at a contact point, from the velocities of the two points and the mass felt there.",
    arguments=(
        Value(
            "point_velocity_1",
            "(..., 3)",
            "m/s",
            "velocity of body 1's point at the contact",
        ),
        Value(
            "point_velocity_2",
            "(..., 3)",
            "m/s",
            "velocity of body 2's point at the contact",
        ),
        NORMAL,
        Value("mass_felt", "(...)", "kg", "effective mass"),
        RESTITUTION,
    ),
    results=(Value("p_hat", "(...)", "N s", "impulse along n, never below 0"),),
    reference=formulas.impulse_at_point,
    cases=_hits,
    properties=(
        Property(
            "pushes",
            lambda given, answer: np.minimum(answer, 0.0),
            "A negative impulse pulls the bodies together. A collision can only push.",
        ),
    ),
    mistakes=(
        Mistake(
            "no guard",
            slip(
                formulas.impulse_at_point,
                "np.where(u < 0, -(1 + restitution) * u * mass_felt, 0.0)",
                "-(1 + restitution) * u * mass_felt",
            ),
            "Right while they approach. Points that already part get a negative impulse from you: it pulls them back. "
            "Where u >= 0 the impulse is 0.",
        ),
        Mistake(
            "the size for all",
            slip(
                formulas.impulse_at_point,
                "np.where(u < 0, -(1 + restitution) * u * mass_felt, 0.0)",
                "np.abs(-(1 + restitution) * u * mass_felt)",
            ),
            "Right while they approach. With the absolute value you also push points that already part: there the "
            "impulse is 0.",
        ),
        Mistake(
            "guard the wrong way round",
            slip(formulas.impulse_at_point, "u < 0", "u > 0"),
            "Points that part get an impulse from you, and those that approach none. They approach where "
            "u = (v1 - v2).n < 0.",
        ),
        Mistake(
            "v2 - v1",
            slip(
                formulas.impulse_at_point,
                "point_velocity_1 - point_velocity_2",
                "point_velocity_2 - point_velocity_1",
            ),
            "It gives what v2 - v1 for v1 - v2 would give: points that part are pushed, and those that approach are "
            "not. They approach where u = (v1 - v2).n < 0, and get -(1 + e) u mu.",
        ),
        Mistake(
            "sign",
            slip(formulas.impulse_at_point, "-(1 + restitution)", "(1 + restitution)"),
            "The sign is reversed: u is negative while they approach, and the impulse is -(1 + e) u mu, positive.",
        ),
        Mistake(
            "only e",
            slip(formulas.impulse_at_point, "-(1 + restitution)", "-restitution"),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends the points back.",
        ),
        Mistake(
            "1 - e",
            slip(formulas.impulse_at_point, "1 + restitution", "1 - restitution"),
            "The factor is 1 - e. After the impact u' = -e u, so the change is -(1 + e) u: at e = 1 there is twice the "
            "impulse of e = 0, not none.",
        ),
        Mistake(
            "no e",
            slip(formulas.impulse_at_point, "-(1 + restitution) * u", "-u"),
            "e is missing: you stop the approach and no more.",
        ),
        Mistake(
            "1 + e u",
            slip(
                formulas.impulse_at_point,
                "-(1 + restitution) * u",
                "(1 - restitution * u)",
            ),
            "Brackets: 1 + e is one factor. You computed 1 and e times the closing speed, added.",
        ),
        Mistake(
            "divided by the mass",
            slip(formulas.impulse_at_point, "* mass_felt", "/ mass_felt"),
            "You divide by the mass felt. An impulse is a mass times a change of velocity: multiply.",
        ),
        Mistake(
            "whole speed",
            slip(
                formulas.impulse_at_point,
                "-(1 + restitution) * u",
                "(1 + restitution) * np.linalg.norm(point_velocity_1 - point_velocity_2, axis=-1)",
            ),
            "You take the length of the relative velocity. Without friction only its part along n matters: the dot "
            "product with n.",
        ),
        Mistake(
            "point 1 only",
            slip(
                formulas.impulse_at_point,
                "-(1 + restitution) * u",
                "-(1 + restitution) * np.sum(point_velocity_1 * normal, axis=-1)",
            ),
            "The velocity of body 2's point is missing: what counts is the relative velocity of the two points.",
        ),
        Mistake(
            "a vector",
            slip(
                formulas.impulse_at_point,
                "np.where(u < 0, -(1 + restitution) * u * mass_felt, 0.0)",
                "np.where(u < 0, -(1 + restitution) * u * mass_felt, 0.0)[..., None] * normal",
            ),
            "You return the vector p_hat n. Return the number p_hat, one for each contact.",
        ),
    ),  # fmt: skip
    hints=(
        "It is impulse_central of lesson 10, with two things exchanged: which velocities approach, and which "
        "mass is felt.",
        "u = (v1 - v2).n with the velocities of the points. Where u < 0 the impulse is -(1 + e) u times the mass felt; "
        "elsewhere it is 0.",
        "u = np.sum((point_velocity_1 - point_velocity_2) * normal, axis=-1)\n"
        "return np.where(u < 0, -(1 + restitution) * ____ * ____, 0.0)",
    ),
)
