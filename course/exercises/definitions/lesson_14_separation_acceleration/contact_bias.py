"""The exercise ``contact_bias``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_14_separation_acceleration.shared import (
    ZERO,
    draw,
)
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

UP = np.array([0.0, 0.0, 1.0])


def _touching(rng: np.random.Generator) -> Sequence[Case]:
    def body(shape: tuple[int, ...] = ()) -> tuple[np.ndarray, ...]:
        return tuple(draw(rng, shape) for _ in range(5))

    def touch(word: str, shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        drawn = {
            "p": draw(rng, shape),
            "n": unit_vector(rng, shape),
            "face": word,
            "body_a": body(shape),
            "body_b": body(shape),
        }
        return drawn | fixed

    ground: dict[str, Any] = {"p": ZERO, "n": UP, "face": "face_b"}
    floor = (np.array([0.0, 0.0, -1.0]), ZERO, ZERO, ZERO, ZERO)
    corner = (
        np.array([0.0, -0.5, 0.3]),
        np.array([0.0, -0.6, -1.0]),
        np.array([2.0, 0.0, 0.0]),
        -9.81 * UP,
        ZERO,
    )
    seesaw = (np.array([0.0, -0.5, -0.4]), ZERO, np.array([2.0, 0.0, 0.0]), ZERO, ZERO)
    puck = (
        np.array([0.0, 0.5, 0.1]),
        np.array([0.0, 1.0, 2.0]),
        ZERO,
        -9.81 * UP,
        ZERO,
    )
    return [
        Case("a corner of a box on the floor", {**ground, "body_a": corner, "body_b": floor}),
        Case("a puck slides on a seesaw", {"p": np.array([0.0, 0.5, 0.0]), "n": UP, "face": "face_b", "body_a": puck,
                                           "body_b": seesaw}),
        Case("off the axes, face of B", touch("face_b")),
        Case("off the axes, face of A", touch("face_a")),
        Case("all at rest, only gravity", {**ground, "body_a": (0.5 * UP, ZERO, ZERO, -9.81 * UP, ZERO),
                                           "body_b": floor}, "edge"),
        Case("three contacts, faces of B", touch("face_b", (3,)), "batch"),
        Case("a 2 by 4 batch, faces of A", touch("face_a", (2, 4)), "batch"),
        Case("four feet of one table", touch("face_b", p=draw(rng, (4,)), n=UP, body_b=floor), "batch"),
    ]  # fmt: skip


MOTION = "(x, v, omega, v_dot, omega_dot), the last two without contact forces"
CONTACT_BIAS = Exercise(
    name="contact_bias",
    rows=(20, 23, 24),
    points=3,
    minutes=14,
    task="Return b = (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot for a contact of a face, p_A = p_B = p.",
    arguments=(
        Value("p", "(..., 3)", "m", "the point where they touch"),
        Value("n", "(..., 3)", "", "unit vector out of body B toward body A"),
        Value(
            "face",
            "word",
            "",
            '"face_b" or "face_a": whose face carries N',
            dtype="str",
        ),
        Value("body_a", "five of (..., 3)", "", MOTION),
        Value("body_b", "five of (..., 3)", "", MOTION),
    ),
    results=(
        Value("b", "(...)", "m/s²", "second rate of the gap without contact forces"),
    ),
    reference=formulas.contact_bias,
    cases=_touching,
    mistakes=(
        Mistake(
            "factor 2 missing",
            slip(formulas.contact_bias, "2 * (p_a_dot", "(p_a_dot"),
            "The factor 2 is missing. The product rule, used twice, gives the mixed term twice: once each time.",
        ),
        Mistake(
            "N_dot lost",
            slip(formulas.contact_bias, " + 2 * (p_a_dot - p_b_dot) * n_dot", ""),
            "What you give lacks 2 (p_A_dot - p_B_dot).N_dot. That is zero only where N stands still, the points move "
            "as one, or one moves past the other at right angles to N_dot.",
        ),
        Mistake(
            "sign of N_dot",
            slip(formulas.contact_bias, "+ 2 *", "- 2 *"),
            "The term with N_dot has the wrong sign. N_dot is omega x N, in this order, and the velocities are A minus "
            "B: p_A_dot - p_B_dot.",
        ),
        Mistake(
            "minus for a face of A",
            slip(formulas.contact_bias, "else omega_a", "else -omega_a"),
            "Right for a face of B. For a face of A it is omega_A x N too, without a minus: what turns the face's "
            "outward normal -N turns N as well (lesson 13, step 3).",
        ),
        Mistake(
            "sign of body B",
            slip(
                formulas.contact_bias,
                "- p_b_ddot",
                "+ p_b_ddot",
                "- p_b_dot",
                "+ p_b_dot",
            ),
            "Body B's motion is added. What counts is how p_A moves as seen from p_B: subtract, in both terms.",
        ),
        Mistake(
            "only A",
            slip(formulas.contact_bias, " - p_b_ddot", "", " - p_b_dot", ""),
            "Body B is missing. It may move, turn and fall as well.",
        ),
        Mistake(
            "acceleration of B added",
            slip(formulas.contact_bias, "- p_b_ddot", "+ p_b_ddot"),
            "In the first term the acceleration of B's point is added. It is p_A_ddot - p_B_ddot.",
        ),
        Mistake(
            "acceleration of B left out",
            slip(formulas.contact_bias, " - p_b_ddot", ""),
            "The acceleration of B's point is left out. Even where its centre stands still, a point of a turning body "
            "is accelerated toward the axis.",
        ),
        Mistake(
            "velocity of B added",
            slip(formulas.contact_bias, "- p_b_dot", "+ p_b_dot"),
            "In the term with N_dot the velocity of B's point is added. It is p_A_dot - p_B_dot.",
        ),
        Mistake(
            "velocity of B left out",
            slip(formulas.contact_bias, " - p_b_dot", ""),
            "In the term with N_dot the velocity of B's point is left out: what counts is how A's point moves as seen "
            "from it.",
        ),
        Mistake(
            "omega of the wrong body in N_dot",
            slip(formulas.contact_bias, "==", "!="),
            "N turns with the other body: for a face of B it is omega_B x N, for a face of A omega_A x N.",
        ),
        Mistake(
            "always a face of B",
            slip(
                formulas.contact_bias,
                'omega_b if face == "face_b" else omega_a',
                "omega_b",
            ),
            'Right for a face of B. Where face is "face_a" the normal turns with A.',
        ),
        Mistake(
            "relative spin in N_dot",
            slip(
                formulas.contact_bias,
                'omega_b if face == "face_b" else omega_a',
                "omega_a - omega_b",
            ),
            "You turn N with the spin of A against B. It belongs to a face, and turns with that face's body alone.",
        ),
        Mistake(
            "one arm for both bodies",
            slip(formulas.contact_bias, "p - x_a, p - x_b", "p - x_a, p - x_a"),
            "Both bodies have the arm of A. They touch in one point, but their centres are different: r_B = p - x_B.",
        ),
        Mistake(
            "arm from the origin",
            slip(formulas.contact_bias, "p - x_a, p - x_b", "p, p"),
            "Your arm is the place of the point. It is measured from the centre of mass: r = p - x.",
        ),
        Mistake(
            "arms turned round",
            slip(formulas.contact_bias, "p - x_a, p - x_b", "x_a - p, x_b - p"),
            "The arms run from the point to the centre. It is r = p - x.",
        ),
        Mistake(
            "arms swapped",
            slip(formulas.contact_bias, "p - x_a, p - x_b", "p - x_b, p - x_a"),
            "Each body has the arm of the other. A point of A has r_A = p - x_A, a point of B r_B = p - x_B.",
        ),
        Mistake(
            "r x omega",
            slip(formulas.contact_bias, "v_a + np", "v_a - np", "v_b + np", "v_b - np"),
            "In the term with N_dot the velocities have r x omega. It is omega x r, in this order.",
        ),
        Mistake(
            "gravity once more",
            slip(formulas.contact_bias, "(p_a_ddot -", "(p_a_ddot + [0, 0, -9.81] -"),
            "You add gravity to A. It is in v_dot already, with all the other external forces.",
        ),
        Mistake(
            "products not summed",
            slip(
                formulas.contact_bias,
                "np.sum((p_a_ddot - p_b_ddot) * n + 2 * (p_a_dot - p_b_dot) * n_dot, axis=-1)",
                "(p_a_ddot - p_b_ddot) * n + 2 * (p_a_dot - p_b_dot) * n_dot",
            ),
            "a * b of two vectors is a vector of products. A dot product adds them up: np.sum(a * b, axis=-1).",
        ),
        Mistake(
            "no omega_dot",
            slip(
                formulas.contact_bias,
                "v_a_dot, omega_a_dot,",
                "v_a_dot, 0 * omega_a_dot,",
                "v_b_dot, omega_b_dot,",
                "v_b_dot, 0 * omega_b_dot,",
            ),
            "omega_dot x r is missing in the accelerations of the points.",
        ),
        Mistake(
            "no centripetal term",
            slip(
                formulas.contact_bias,
                "omega_a_dot, omega_a, r_a",
                "omega_a_dot, 0 * omega_a, r_a",
                "omega_b_dot, omega_b, r_b",
                "omega_b_dot, 0 * omega_b, r_b",
            ),
            "omega x (omega x r) is missing in the accelerations of the points.",
        ),
        Mistake(
            "centres in the velocity",
            slip(
                formulas.contact_bias,
                "v_a + np.cross(omega_a, r_a), v_b + np.cross(omega_b, r_b)",
                "v_a, v_b",
            ),
            "In the term with N_dot you use the velocities of the centres. It needs those of the points: "
            "v + omega x r.",
        ),
        Mistake(
            "centres alone",
            slip(
                formulas.contact_bias,
                "v_a + np.cross(omega_a, r_a), v_b + np.cross(omega_b, r_b)",
                "v_a, v_b",
                "p_a_ddot - p_b_ddot",
                "v_a_dot - v_b_dot",
            ),
            "You use velocity and acceleration of the centres throughout. The points that touch are elsewhere.",
        ),
        Mistake(
            "turned round",
            slip(formulas.contact_bias, "np.sum", "-np.sum"),
            "The whole has the wrong sign. Take A minus B: gravity on A over a floor must give b below 0.",
        ),
    ),
    hints=(
        "Three parts: velocity and acceleration of the point on each body (exercise 1 does the second), N_dot of the "
        "face, then the two terms.",
        "The point's velocity is v + omega x r and its acceleration is exercise 1. Subtract B "
        "from A; dot the acceleration with N and twice the velocity with N_dot.",
        "p_a_dot = v_a + np.cross(omega_a, ____)\n"
        "p_a_ddot = free_point_acceleration(v_a_dot, omega_a_dot, omega_a, r_a)\n"
        "# ... the same for B ...\n"
        'n_dot = np.cross(omega_b if face == "face_b" else ____, n)\n'
        "return np.sum((p_a_ddot - p_b_ddot) * n, axis=-1) + ____ * np.sum((p_a_dot - p_b_dot) * n_dot, axis=-1)",
    ),
)
