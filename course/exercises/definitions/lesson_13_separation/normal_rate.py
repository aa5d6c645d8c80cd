"""The exercise ``normal_rate``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_13_separation.shared import (
    NORMAL,
    OMEGA_A,
    OMEGA_B,
    UP,
    draw,
)
from course.exercises.definitions.vectors import dot, unit_vector
from course.exercises.slips import slip


def _faces(rng: np.random.Generator) -> Sequence[Case]:
    def face(word: str, shape: tuple[int, ...] = ()) -> dict[str, Any]:
        omega_a, omega_b = draw(rng, shape), draw(rng, shape)
        return {
            "n": unit_vector(rng, shape),
            "omega_a": omega_a,
            "omega_b": omega_b,
            "face": word,
        }

    turning = {
        "n": UP,
        "omega_a": np.array([0.0, 3.0, 0.0]),
        "omega_b": np.array([2.0, 0.0, 0.0]),
    }
    return [
        Case("a plank that turns, face of B", {**turning, "face": "face_b"}),
        Case("the same, face of A", {**turning, "face": "face_a"}),
        Case("off the axes, face of B", face("face_b")),
        Case("off the axes, face of A", face("face_a")),
        Case(
            "B turns about its own normal",
            {**face("face_b"), "n": UP, "omega_b": 2.5 * UP},
            "edge",
        ),
        Case("three faces of B", face("face_b", (3,)), "batch"),
        Case("a 2 by 4 batch, faces of A", face("face_a", (2, 4)), "batch"),
    ]


NORMAL_RATE = Exercise(
    name="normal_rate",
    rows=(20,),
    points=1,
    minutes=5,
    task='Return N_dot where a face carries the normal: a face of B (face is "face_b") or of A ("face_a").',
    arguments=(
        NORMAL,
        OMEGA_A,
        OMEGA_B,
        Value("face", "word", "", '"face_b" or "face_a"', dtype="str"),
    ),
    results=(Value("n_dot", "(..., 3)", "1/s", "rate of N"),),
    reference=formulas.normal_rate,
    cases=_faces,
    properties=(
        Property(
            "keeps its length",
            lambda given, answer: dot(answer, given["n"]),
            "Your N_dot has a part along N, so N would not keep its length of 1.",
        ),
    ),
    mistakes=(
        Mistake(
            "order",
            slip(formulas.normal_rate, "omega_of_face, n", "n, omega_of_face"),
            "The sign is reversed: a cross product changes its sign with the order. What turns with omega changes "
            "by omega x (itself). (A's own outward normal is -N, but it turns by the same rule.)",
        ),
        Mistake(
            "the other body",
            slip(formulas.normal_rate, "==", "!="),
            "You took the omega of the other body. N is fixed to the body whose face it belongs to, and turns with it.",
        ),
        Mistake(
            "always B",
            slip(
                formulas.normal_rate,
                'omega_b if face == "face_b" else omega_a',
                "omega_b",
            ),
            'Right for a face of B. When the face is A\'s (face == "face_a") the normal turns with A.',
        ),
        Mistake(
            "always A",
            slip(
                formulas.normal_rate,
                'omega_b if face == "face_b" else omega_a',
                "omega_a",
            ),
            'Right for a face of A. When the face is B\'s (face == "face_b") the normal turns with B.',
        ),
        Mistake(
            "sign for A",
            slip(formulas.normal_rate, "else omega_a", "else -omega_a"),
            "Right for a face of B. For a face of A you reversed the sign: A's outward normal is -N, its rate is "
            "-N_dot, and the two signs cancel.",
        ),
        Mistake(
            "relative spin",
            slip(
                formulas.normal_rate,
                'omega_b if face == "face_b" else omega_a',
                "omega_a - omega_b",
            ),
            "You took the spin of A against B. The face knows nothing of the other body: one omega is enough.",
        ),
        Mistake(
            "relative spin, turned round",
            slip(
                formulas.normal_rate,
                'omega_b if face == "face_b" else omega_a',
                "omega_b - omega_a",
            ),
            "You took the spin of B against A. The face knows nothing of the other body: one omega is enough.",
        ),
        Mistake(
            "relative spin, own minus other",
            slip(
                formulas.normal_rate,
                'omega_b if face == "face_b" else omega_a',
                'omega_b - omega_a if face == "face_b" else omega_a - omega_b',
            ),
            "You took the spin of the face's body as seen from the other one. The face knows nothing of the other "
            "body: its own omega is enough.",
        ),
        Mistake(
            "none",
            slip(formulas.normal_rate, "return np", "return 0 * np"),
            "Your N_dot is 0, as if the normal stayed as it is. It is fixed to a face, and the face turns.",
        ),
        Mistake(
            "no cross",
            slip(
                formulas.normal_rate, "np.cross(omega_of_face, n)", "omega_of_face * n"
            ),
            "You multiply component by component. A turning arrow changes by a cross product: np.cross.",
        ),
    ),
    hints=(
        "See Derive: an arrow that is fixed to a turning body. Which body is N fixed to?",
        "The rate is omega x N, with the omega of the body whose face it is. np.cross works on the last axis.",
        'omega_of_face = omega_b if face == "face_b" else ____\nreturn np.cross(____, ____)',
    ),
)
