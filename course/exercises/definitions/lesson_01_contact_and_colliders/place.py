"""The exercise ``place``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.turning import rotation_matrices
from course.exercises.slips import slip

_TURNED = "points @ np.swapaxes(rotation, -1, -2)"
_RETURN = "turned + translation[..., None, :]"


def _several(
    rng: np.random.Generator, shape: tuple[int, ...], count: int
) -> dict[str, np.ndarray]:
    return {
        "points": rng.normal(size=(*shape, count, 3)).round(2),
        "rotation": rotation_matrices(rng, shape),
        "translation": rng.normal(0.0, 3.0, (*shape, 3)).round(2),
    }


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    one = {
        "points": np.diag([1.0, 2.0, 3.0]),
        "rotation": quarter,
        "translation": np.array([10.0, 20.0, 30.0]),
    }
    poses = _several(rng, (4,), 5)
    return [
        Case("a quarter turn about z, then a shift", one),
        Case("eight points", _several(rng, (), 8)),
        Case("three bodies of three points", _several(rng, (3,), 3), "batch"),
        Case("four bodies of eight points", _several(rng, (4,), 8), "batch"),
        Case("a 2 by 3 batch", _several(rng, (2, 3), 4), "batch"),
        Case(
            "one body in four poses", {**poses, "points": poses["points"][0]}, "batch"
        ),
        Case("a single point", _several(rng, (), 1), "edge"),
    ]


def _distances(points: np.ndarray) -> np.ndarray:
    apart = points[..., :, None, :] - points[..., None, :, :]
    return np.linalg.norm(apart, axis=-1)


def _each_by_its_own(points, rotation):
    """(rotation @ points[..., None])[..., 0], with its error, to a last bit that does not hang on memory."""
    _ = rotation @ points[..., None]
    return np.sum(rotation * points[..., None, :], axis=-1)


def _one_by_one(points, rotation, translation):
    return _each_by_its_own(points, rotation) + translation[..., None, :]


def _one_by_one_of_one(points, rotation, translation):
    return _each_by_its_own(points, rotation) + translation


_MATRIX_FOR_EACH = (
    "Right for one body. In a batch the points, (..., m, 3), have an axis more than the bodies: "
    "rotation[..., None, :, :] and translation[..., None, :] give each body's to all of its points."
)


_AS_COLUMNS = (
    "rotation @ points takes the points for columns, and mixes them with each other. They are rows: the matrix comes "
    "after them, transposed."
)


def _looped(points, rotation, translation):
    return np.array([rotation @ point + translation for point in points])


def _slip(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.place, *edits), message)


PLACE = Exercise(
    name="place",
    rows=(2,),
    points=2,
    minutes=9,
    task="Return where the points of a body are when it is turned about its origin, and then shifted.",
    arguments=(
        Value("points", "(..., m, 3)", "m", "in the body's own axes"),
        Value("rotation", "(..., 3, 3)", "", "columns: the body's axes"),
        Value("translation", "(..., 3)", "m", "where the body's origin is"),
    ),
    results=(Value("placed", "(..., m, 3)", "m", "in the world"),),
    reference=formulas.place,
    cases=_cases,
    properties=(
        Property(
            "distances stay",
            lambda given, answer: _distances(answer) - _distances(given["points"]),
            "The distances between the points have changed: a rigid body keeps them.",
        ),
    ),
    mistakes=(
        _slip(
            "turned back",
            _TURNED,
            "points @ rotation",
            message="You turn the other way. The points are rows: R q for each of them is points @ (R transposed).",
        ),
        _slip(
            "points as columns",
            _TURNED,
            "rotation @ points",
            message=_AS_COLUMNS,
        ),
        _slip(
            "points as columns, and one shift a point",
            _TURNED,
            "rotation @ points",
            _RETURN,
            "turned + translation",
            message=f"{_AS_COLUMNS} In a batch the translations need an axis for the points besides.",
        ),
        _slip(
            "whole batch transposed",
            _TURNED,
            "points @ rotation.T",
            message="Right for one body. For a batch .T turns all axes round, those of the batch too: np.swapaxes("
            "rotation, -1, -2) transposes each matrix by itself.",
        ),
        _slip(
            "shifted first",
            _TURNED,
            "(points + translation[..., None, :]) @ np.swapaxes(rotation, -1, -2)",
            _RETURN,
            "turned",
            message="You shift first, so the shift is turned as well. The body turns about its own origin, then moves.",
        ),
        _slip(
            "no shift",
            _RETURN,
            "turned + 0 * translation[..., None, :]",
            message="The body turns, but stays at the origin: the translation is missing.",
        ),
        _slip(
            "no turn",
            _TURNED,
            "points + 0 * rotation[..., :1, :]",
            message="The body is shifted, but not turned: the rotation is missing.",
        ),
        _slip(
            "shifted back",
            _RETURN,
            "turned - translation[..., None, :]",
            message="You take the translation away: the body goes the other way.",
        ),
        _slip(
            "one shift a point",
            "translation[..., None, :]",
            "translation",
            message="Right for one body. In a batch the translations, (..., 3), need an axis for the points, so that "
            "each body's goes to all of its points: translation[..., None, :].",
        ),
        _slip(
            "transposed, and one shift a point",
            _TURNED,
            "points @ rotation.T",
            _RETURN,
            "turned + translation",
            message="Right for one body. .T on a batch reverses all axes: np.swapaxes(rotation, -1, -2) transposes "
            "each matrix. And the translations, (..., 3), need an axis for the points: translation[..., None, :].",
        ),
        _slip(
            "a batch of one axis",
            "translation[..., None, :]",
            "translation[:, None]",
            message="translation[:, None] is right only for a batch of one axis: translation[..., None, :] puts the "
            "axis for the points before the last one, whatever stands in front.",
        ),
        _slip(
            "axis behind",
            "translation[..., None, :]",
            "translation[..., None]",
            message="translation[..., None] puts the new axis last: then the first point is shifted by x three times, "
            "the second by y. The axis for the points stands before the last one.",
        ),
        Mistake(
            "a loop over the points",
            _looped,
            "Right for one body. A loop over `points` goes along the first axis, and in a batch these are the bodies. "
            "Rows times a matrix take all points of all bodies at once.",
        ),
        Mistake("a matrix for each point", _one_by_one, _MATRIX_FOR_EACH),
        Mistake(
            "a matrix for each point of one",
            _one_by_one_of_one,
            f"{_MATRIX_FOR_EACH} Yours lacks both.",
        ),
    ),  # fmt: skip
    hints=(
        "Turn first, then shift. The columns of the rotation are where the body's three axes point now.",
        "For one point it is R q + x_A. The points are rows, and a row times a matrix is points @ (R transposed); "
        "np.swapaxes(rotation, -1, -2) transposes each matrix of a batch.",
        "turned = points @ ____\nreturn turned + translation[..., ____, :]",
    ),
)
