"""The exercise ``separation_rate``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_13_separation.shared import (
    NORMAL,
    POINT_A,
    POINT_B,
    UP,
    ZERO,
    draw,
    short_unit_vector,
)
from course.exercises.slips import slip


def _pairs(rng: np.random.Generator) -> Sequence[Case]:
    def body(shape: tuple[int, ...] = ()) -> tuple[np.ndarray, ...]:
        return draw(rng, shape), draw(rng, shape), draw(rng, shape)

    def pair(shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        n = short_unit_vector(rng, shape)
        # Points that are not opposite each other along N: otherwise the N_dot term is 0
        # and nobody misses it.
        drawn = {"p_a": draw(rng, shape), "p_b": draw(rng, shape), "body_a": body(shape), "body_b": body(shape),
                 "n": n, "n_dot": np.round(np.cross(draw(rng, shape), n), 4)}  # fmt: skip
        return drawn | fixed

    still = (np.array([0.0, 0.0, 0.0]), ZERO, ZERO)
    falling = {
        "p_a": np.array([0.0, 0.5, 0.7]), "p_b": np.array([0.0, 0.5, 0.2]),
        "body_a": (np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0]), np.array([3.0, 0.0, 0.0])),
        "body_b": still, "n": UP, "n_dot": ZERO,
    }  # fmt: skip
    p = draw(rng)
    x_a, _, omega_a = body()
    x_b, _, omega_b = body()
    return [
        Case("a box that falls and turns over a floor", falling),
        Case("off the axes", pair()),
        Case("off the axes again", pair()),
        Case(
            "both centres stand still",
            pair(body_a=(x_a, ZERO, omega_a), body_b=(x_b, ZERO, omega_b)),
            "edge",
        ),
        Case("they touch: p_A = p_B", pair(p_a=p, p_b=p), "edge"),
        Case(
            "nothing turns",
            pair(
                body_a=(x_a, draw(rng), ZERO), body_b=(x_b, draw(rng), ZERO), n_dot=ZERO
            ),
            "edge",
        ),
        Case("three pairs", pair((3,)), "batch"),
        Case("a 2 by 4 batch", pair((2, 4)), "batch"),
        Case(
            "five corners of A over one floor",
            pair((5,), p_b=draw(rng), body_b=still, n=UP, n_dot=ZERO),
            "batch",
        ),
    ]


MOTION = (
    "(x, v, omega): centre of mass [m], its velocity [m/s], angular velocity [rad/s]"
)
SEPARATION_RATE = Exercise(
    name="separation_rate",
    rows=(20, 22),
    points=3,
    minutes=12,
    task="Return d_dot = N.(p_A_dot - p_B_dot) + N_dot.(p_A - p_B); a body is the tuple (x, v, omega).",
    arguments=(
        POINT_A,
        POINT_B,
        Value("body_a", "((..., 3), (..., 3), (..., 3))", "", MOTION),
        Value("body_b", "((..., 3), (..., 3), (..., 3))", "", MOTION),
        NORMAL,
        Value("n_dot", "(..., 3)", "1/s", "rate of N"),
    ),
    results=(Value("d_dot", "(...)", "m/s", "rate of the separation"),),
    reference=formulas.separation_rate,
    cases=_pairs,
    mistakes=(
        Mistake(
            "no turning",
            slip(formulas.separation_rate, "p_a_dot - p_b_dot", "v_a - v_b"),
            "You use the velocities of the centres. The points that meet are elsewhere on the bodies, and move by "
            "omega x r besides.",
        ),
        Mistake(
            "cross product turned round",
            slip(
                formulas.separation_rate,
                "v_a + np",
                "v_a - np",
                "v_b + np",
                "v_b - np",
            ),
            "omega x r has the wrong sign: either the order is r x omega, or the arm runs from the point to the "
            "centre. It is omega x r with r = p - x, from the centre to the point.",
        ),
        Mistake(
            "one arm for both bodies",
            slip(formulas.separation_rate, "p_b - x_b", "p_a - x_a"),
            "Both bodies turn with the arm of A. Each has its own arm, from its own centre to its own point: "
            "r_B = p_B - x_B.",
        ),
        Mistake(
            "arm from the origin",
            slip(formulas.separation_rate, "p_a - x_a", "p_a", "p_b - x_b", "p_b"),
            "Your arm is the place of the point, measured from the origin of the axes. A body turns about its own "
            "centre: r = p - x.",
        ),
        Mistake(
            "arms from the other centre",
            slip(
                formulas.separation_rate,
                "p_a - x_a",
                "p_a - x_b",
                "p_b - x_b",
                "p_b - x_a",
            ),
            "The arms start at the centre of the other body: r_A = p_A - x_A, r_B = p_B - x_B.",
        ),
        Mistake(
            "p_A on both bodies",
            slip(formulas.separation_rate, "p_b - x_b", "p_a - x_b"),
            "B's arm ends at p_A. That is the same only where p_A and p_B are one point; B's own point is p_B.",
        ),
        Mistake(
            "spins swapped",
            slip(
                formulas.separation_rate,
                "omega_a, p_a",
                "omega_b, p_a",
                "omega_b, p_b",
                "omega_a, p_b",
            ),
            "Each arm turns with the omega of the other body. Go through which tuple is whose.",
        ),
        Mistake(
            "sign of body B",
            slip(formulas.separation_rate, "p_a_dot - p_b_dot", "p_a_dot + p_b_dot"),
            "The velocities of the two points are added. What counts is how p_A moves as seen from p_B: subtract.",
        ),
        Mistake(
            "only A",
            slip(formulas.separation_rate, " - p_b_dot", ""),
            "Body B is missing. It may move and turn as well, and then its point moves.",
        ),
        Mistake(
            "N_dot lost",
            slip(formulas.separation_rate, " + (p_a - p_b) * n_dot", ""),
            "The second term, N_dot.(p_A - p_B), is missing. It is zero where the points touch or lie opposite each "
            "other along N, and these need not.",
        ),
        Mistake(
            "sign of N_dot",
            slip(formulas.separation_rate, "+ (p_a", "- (p_a"),
            "The second term has the wrong sign. By the product rule both terms are added.",
        ),
        Mistake(
            "N_dot twice",
            slip(formulas.separation_rate, "+ (p_a", "+ 2 * (p_a"),
            "The second term is taken twice. A factor 2 comes in the *second* derivative only.",
        ),
        Mistake(
            "turned round",
            slip(formulas.separation_rate, "np.sum", "-np.sum"),
            "The whole has the wrong sign: below 0 they approach. Take A minus B in both terms.",
        ),
        Mistake(
            "whole speed",
            slip(
                formulas.separation_rate,
                "np.sum((p_a_dot - p_b_dot) * n + (p_a - p_b) * n_dot, axis=-1)",
                "np.linalg.norm(p_a_dot - p_b_dot, axis=-1)",
            ),
            "You return how fast the points move past each other. Only the part along N changes the gap: take the dot "
            "product with N.",
        ),
    ),  # fmt: skip
    hints=(
        "Two steps: the velocity of each point, as in Derive, then the two terms of the product rule.",
        "For each body the arm is r = p - x and the point moves with v + omega x r. Subtract B's from A's, dot with N, "
        "and add (p_A - p_B) dotted with N_dot.",
        "x_a, v_a, omega_a = body_a\n"
        "x_b, v_b, omega_b = body_b\n"
        "p_a_dot = v_a + np.cross(omega_a, ____ - ____)\n"
        "p_b_dot = v_b + np.cross(omega_b, ____ - ____)\n"
        "return np.sum(n * (____ - ____), axis=-1) + np.sum(____ * (p_a - p_b), axis=-1)",
    ),
)
