"""The exercise ``contact_bias``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_14_separation_acceleration.shared import (
    ZERO,
    draw,
)
from course.exercises.definitions.vectors import dot, unit_vector

UP = np.array([0.0, 0.0, 1.0])


def _bias_with(
    *,
    factor: float = 2.0,
    sign_b: float = -1.0,
    swung_b: float = 1.0,
    moved_b: float = 1.0,
    face: Any = None,
    arm_a: Any = None,
    arm_b: Any = None,
    swing: float = 1.0,
    inward: float = 1.0,
    turning: float = 1.0,
    whole: float = 1.0,
    pull: float = 0.0,
    summed: bool = True,
) -> Any:
    """b with one of its parts changed.

    ``face(word, omega_a, omega_b)`` gives the omega that turns N; ``swung_b`` and ``moved_b`` multiply what B brings
    to the accelerations and to the velocities alone; ``pull`` is added to A's acceleration along z.
    """

    def function(p: Any, n: Any, word: str, body_a: Any, body_b: Any) -> Any:
        def motion(body: Any, arm: Any) -> tuple[Any, Any]:
            x, v, omega, v_dot, omega_dot = body
            r = arm(p, body_a[0], body_b[0]) if arm else p - x
            p_dot = v + turning * np.cross(omega, r)
            return p_dot, v_dot + swing * np.cross(omega_dot, r) + inward * np.cross(
                omega, np.cross(omega, r)
            )

        (v_a, a_a), (v_b, a_b) = motion(body_a, arm_a), motion(body_b, arm_b)
        of_face = (
            face(word, body_a[2], body_b[2])
            if face
            else body_b[2]
            if word == "face_b"
            else body_a[2]
        )
        n_dot = np.cross(of_face, n)
        a_b, v_b = sign_b * swung_b * a_b, sign_b * moved_b * v_b
        p_ddot, p_dot = a_a + pull * UP + a_b, v_a + v_b
        if not summed:
            return p_ddot * n + factor * p_dot * n_dot
        return whole * (dot(p_ddot, n) + factor * dot(p_dot, n_dot))

    return function


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
        Value("b", "(...)", "m/s^2", "second rate of the gap without contact forces"),
    ),
    reference=_bias_with(),
    cases=_touching,
    mistakes=(
        Mistake(
            "factor 2 missing",
            _bias_with(factor=1.0),
            "The factor 2 is missing. The product rule, used twice, gives the mixed term twice: once each time.",
        ),
        Mistake(
            "N_dot lost",
            _bias_with(factor=0.0),
            "The term with N_dot is missing. It is zero only if the normal stands still or the points move as one.",
        ),
        Mistake(
            "sign of N_dot",
            _bias_with(factor=-2.0),
            "The term with N_dot has the wrong sign. N_dot is omega x N, in this order, and the velocities are A minus "
            "B: p_A_dot - p_B_dot.",
        ),
        Mistake(
            "minus for a face of A",
            _bias_with(face=lambda word, a, b: b if word == "face_b" else -a),
            "Right for a face of B. For a face of A it is omega_A x N too, without a minus: what turns the face's "
            "outward normal -N turns N as well (lesson 13, step 3).",
        ),
        Mistake(
            "sign of body B",
            _bias_with(sign_b=1.0),
            "Body B's motion is added. What counts is how p_A moves as seen from p_B: subtract, in both terms.",
        ),
        Mistake(
            "only A",
            _bias_with(sign_b=0.0),
            "Body B is missing. It may move, turn and fall as well.",
        ),
        Mistake(
            "acceleration of B added",
            _bias_with(swung_b=-1.0),
            "In the first term the acceleration of B's point is added. It is p_A_ddot - p_B_ddot.",
        ),
        Mistake(
            "acceleration of B left out",
            _bias_with(swung_b=0.0),
            "The acceleration of B's point is left out. Even where its centre stands still, a point of a turning body "
            "is accelerated toward the axis.",
        ),
        Mistake(
            "velocity of B added",
            _bias_with(moved_b=-1.0),
            "In the term with N_dot the velocity of B's point is added. It is p_A_dot - p_B_dot.",
        ),
        Mistake(
            "velocity of B left out",
            _bias_with(moved_b=0.0),
            "In the term with N_dot the velocity of B's point is left out: what counts is how A's point moves as seen "
            "from it.",
        ),
        Mistake(
            "omega of the wrong body in N_dot",
            _bias_with(face=lambda word, a, b: a if word == "face_b" else b),
            "N turns with the other body: for a face of B it is omega_B x N, for a face of A omega_A x N.",
        ),
        Mistake(
            "always a face of B",
            _bias_with(face=lambda word, a, b: b),
            'Right for a face of B. Where face is "face_a" the normal turns with A.',
        ),
        Mistake(
            "relative spin in N_dot",
            _bias_with(face=lambda word, a, b: a - b),
            "You turn N with the spin of A against B. It belongs to a face, and turns with that face's body alone.",
        ),
        Mistake(
            "one arm for both bodies",
            _bias_with(arm_b=lambda p, x_a, x_b: p - x_a),
            "Both bodies have the arm of A. They touch in one point, but their centres are different: r_B = p - x_B.",
        ),
        Mistake(
            "arm from the origin",
            _bias_with(arm_a=lambda p, x_a, x_b: p, arm_b=lambda p, x_a, x_b: p),
            "Your arm is the place of the point. It is measured from the centre of mass: r = p - x.",
        ),
        Mistake(
            "arms turned round",
            _bias_with(
                arm_a=lambda p, x_a, x_b: x_a - p, arm_b=lambda p, x_a, x_b: x_b - p
            ),
            "The arms run from the point to the centre. It is r = p - x.",
        ),
        Mistake(
            "arms swapped",
            _bias_with(
                arm_a=lambda p, x_a, x_b: p - x_b, arm_b=lambda p, x_a, x_b: p - x_a
            ),
            "Each body has the arm of the other. A point of A has r_A = p - x_A, a point of B r_B = p - x_B.",
        ),
        Mistake(
            "r x omega",
            _bias_with(turning=-1.0),
            "In the term with N_dot the velocities have r x omega. It is omega x r, in this order.",
        ),
        Mistake(
            "gravity once more",
            _bias_with(pull=-9.81),
            "You add gravity to A. It is in v_dot already, with all the other external forces.",
        ),
        Mistake(
            "products not summed",
            _bias_with(summed=False),
            "a * b of two vectors is a vector of products. A dot product adds them up: np.sum(a * b, axis=-1).",
        ),
        Mistake(
            "no omega_dot",
            _bias_with(swing=0.0),
            "omega_dot x r is missing in the accelerations of the points.",
        ),
        Mistake(
            "no centripetal term",
            _bias_with(inward=0.0),
            "omega x (omega x r) is missing in the accelerations of the points.",
        ),
        Mistake(
            "centres in the velocity",
            _bias_with(turning=0.0),
            "In the term with N_dot you use the velocities of the centres. It wants the points': v + omega x r.",
        ),
        Mistake(
            "centres alone",
            _bias_with(turning=0.0, swing=0.0, inward=0.0),
            "You use velocity and acceleration of the centres throughout. The points that touch are elsewhere.",
        ),
        Mistake(
            "turned round",
            _bias_with(whole=-1.0),
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
