"""The exercise ``rotate``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.turning import drawn_vectors
from course.exercises.slips import slip


def _turning(
    rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any
) -> dict[str, Any]:
    return {"v": drawn_vectors(rng, shape), "theta": drawn_vectors(rng, shape), **fixed}


ROTATE = Exercise(
    name="rotate",
    rows=(14,),
    points=2,
    minutes=12,
    level="stretch",
    task="Return v turned by the angle |theta| about the axis theta/|theta| (the exponential map).",
    arguments=(
        Value("v", "(..., 3)", "", "vectors"),
        Value("theta", "(..., 3)", "rad", "rotation vectors: axis times angle"),
    ),
    results=(Value("turned", "(..., 3)", ""),),
    reference=formulas.rotate,
    cases=lambda rng: [
        Case(
            "a quarter turn about z",
            {"v": np.array([1.0, 0.0, 2.0]), "theta": np.array([0.0, 0.0, np.pi / 2])},
        ),
        Case("about a slanted axis", _turning(rng, ())),
        Case("no turn", _turning(rng, (), theta=np.zeros(3)), "edge"),
        Case(
            "a tiny turn", _turning(rng, (), theta=np.array([3e-9, 0.0, 4e-9])), "edge"
        ),
        Case(
            "more than a whole turn",
            _turning(rng, (), theta=np.array([0.0, 6.0, 4.0])),
            "edge",
        ),
        Case("five vectors", _turning(rng, (5,)), "batch"),
        Case(
            "three vectors, one of them not turned",
            _turning(
                rng,
                (3,),
                theta=np.array([[0.5, 0.2, -1.0], [0.0, 0.0, 0.0], [2.0, 0.3, 0.4]]),
            ),
            "batch",
        ),
        Case("a 2 by 4 batch", _turning(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "length",
            lambda given, answer: (
                np.linalg.norm(answer, axis=-1) - np.linalg.norm(given["v"], axis=-1)
            ),
            "The length of v changes. A turn keeps it.",
        ),
    ),
    mistakes=(
        Mistake(
            "zero angle",
            slip(formulas.rotate, "np.where(angle > 0, angle, 1.0)", "angle"),
            "NaN where nothing turns: theta/|theta| is 0/0 there. Divide by np.where(angle > 0, angle, 1.0).",
        ),
        Mistake(
            "the other way",
            slip(formulas.rotate, "+ sin *", "- sin *"),
            "It turns the other way. By the right hand, a vector moves along theta x v, not v x theta.",
        ),
        Mistake(
            "last term forgotten",
            slip(formulas.rotate, " + (1 - cos) * along", ""),
            "The part of v along the axis shrinks by the cosine. It must stay: the term (1 - cos) (u.v) u gives it "
            "back.",
        ),
        Mistake(
            "cosine in the last term",
            slip(formulas.rotate, "(1 - cos)", "cos"),
            "The part of v along the axis comes with cos + cos. The last term has 1 - cos: what the first term takes "
            "from that part, it gives back.",
        ),
        Mistake(
            "one length for the batch",
            slip(
                formulas.rotate,
                "theta, axis=-1, keepdims=True",
                "theta",
                "u * v, axis=-1, keepdims=True",
                "u * v",
            ),
            "Right for one vector, not for a batch: np.linalg.norm(theta) and np.sum(u * v) without an axis make one "
            "number of it all. Take axis=-1, keepdims=True.",
        ),
        Mistake(
            "half the angle",
            slip(
                formulas.rotate,
                "np.cos(angle), np.sin(angle)",
                "np.cos(angle / 2), np.sin(angle / 2)",
            ),
            "It turns by half the angle. That half belongs to quaternions, which act twice; here the whole angle "
            "counts.",
        ),
        Mistake(
            "axis not of unit length",
            slip(formulas.rotate, "theta / np.where(angle > 0, angle, 1.0)", "theta"),
            "You use theta itself as the axis. The axis is u = theta/|theta|, of unit length; the angle is |theta|.",
        ),
        Mistake(
            "first order",
            slip(
                formulas.rotate,
                "cos * v + sin * np.cross(u, v) + (1 - cos) * along",
                "v + np.cross(theta, v)",
            ),
            "v + theta x v is explicit Euler: right for tiny angles only, and longer than v wherever it turns.",
        ),
        Mistake(
            "first order, brought back",
            slip(
                formulas.rotate,
                "return cos * v + sin * np.cross(u, v) + (1 - cos) * along",
                "longer = v + np.cross(theta, v)\n"
                "    size, before = (np.linalg.norm(x, axis=-1) for x in (longer, v))\n"
                "    return longer * (before / size)[..., None]",
            ),
            "v + theta x v, brought back to its length, turns by arctan|theta| at most, not by |theta|, and what "
            "lies along the axis is lost from step to step.",
        ),
    ),
    hints=(
        "Split v into a part along the axis, which stays, and a part across it, which turns in its plane.",
        "With u the unit axis: cos times v, plus sin times u x v, plus (1 - cos) times (u.v) u. Keep the last axis "
        "of the angle: keepdims=True.",
        "angle = np.linalg.norm(theta, axis=-1, keepdims=True)\n"
        "u = theta / np.where(angle > 0, angle, 1.0)\n"
        "along = np.sum(u * v, axis=-1, keepdims=True) * u\n"
        "return np.cos(angle) * v + np.sin(angle) * np.cross(____, ____) + (1 - np.cos(angle)) * ____",
    ),
)
