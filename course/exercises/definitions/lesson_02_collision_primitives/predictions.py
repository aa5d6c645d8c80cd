"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Prediction

_ROD = np.array([0.5, 0.005, 0.005])  # half extents of a rod of 1 m by 1 cm by 1 cm


def _about_z(degrees: float) -> Array:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _growth(half_extents: Array, rotation: Array) -> float:
    box = formulas.rotated_box_extents(half_extents, rotation)
    return float(np.prod(box / half_extents))


def _fifty_one() -> str:
    """A rod grows as its length over its thickness, and a cube hardly, at the same angle."""
    rod, cube = _growth(_ROD, _about_z(45.0)), _growth(np.ones(3), _about_z(45.0))
    longer = _growth(_ROD * [2, 1, 1], _about_z(45.0))
    return "length" if longer > 1.9 * rod and cube < 3 else "angle"


def _places() -> int:
    return int(np.sum(np.ones((4, 3)) * np.array([0.6, 0.8, 0.0]), axis=-1).size)


def _moved_corner() -> float:
    moved = _about_z(90.0) @ np.array([1.0, 2.0, 0.0]) + np.array([5.0, 0.0, 0.0])
    return float(moved[0])


def _turned_cube() -> float:
    return _growth(np.ones(3), _about_z(45.0))


def _ball_of_box() -> float:
    return float(np.linalg.norm([2.0, 1.0, 2.0]))


def _tenfold_angle() -> float:
    """Where 1 + sin(2 theta) (q + 1/q)/2 = 10, q the thickness over the length."""
    q = _ROD[1] / _ROD[0]
    return float(np.degrees(0.5 * np.arcsin(18.0 / (q + 1 / q))))


def _which_kind() -> str:
    from course.study import fitted_volumes

    ratio = fitted_volumes()
    near = {"aabb": "box", "kdop26": "kdop", "capsule": "capsule"}
    best = min(near, key=lambda name: ratio[name])
    return near[best]


def _diagonal_rod() -> str:
    """A rod of 1 m by 1 cm by 1 cm along a cube's diagonal."""
    n = np.ones(3) / np.sqrt(3)
    u = np.array([1.0, -1.0, 0.0]) / np.sqrt(2)
    grown = _growth(_ROD, np.stack([n, u, np.cross(n, u)], axis=1))
    return "2000" if grown > 1000 else "100" if grown > 75 else "51"


def _ritter() -> str:
    from course.study import ritter_excess

    mean = float(np.mean(ritter_excess(60, points=100, seed=2)))
    return "none" if mean < 0.01 else "some" if 0.03 < mean < 0.12 else "third"


def _crowded() -> str:
    from course.study import crowded_boxes

    principal, faces = crowded_boxes([0.0, 0.9])[1:]
    grown = principal[1] / principal[0]
    return "grows" if grown > 1.05 and faces[1] < 1.01 * faces[0] else "same"


PREDICTIONS = (
    Prediction(
        "fifty_one",
        "A rod of 1 m by 1 cm by 1 cm is turned by 45 degrees. The box along the axes around it has 51 times the "
        "volume that it had before. Why so much?",
        _fifty_one,
        "The rod is still as long, but it lies across the box: two sides of the box are now about as long as the rod, "
        "where one was. The volume grows as length over thickness. A cube turned by the same angle only doubles.",
        choices={
            "angle": "any box at 45 degrees grows so: it depends on the angle",
            "length": "two sides of the box are now about as long as the rod",
            "third": "all three sides of the box grow with the turn",
        },
        wrong={"angle": "A cube turned by 45 degrees doubles. The form decides."},
        later="See",
    ),
    Prediction(
        "sums_of_points",
        "From lesson 00: points has the shape (4, 3) and n the shape (3,). How many numbers does "
        "np.sum(points * n, axis=-1) give?",
        _places,
        "One for each point: the sum runs over the last axis, the coordinates.",
        tolerance=0.0,
        wrong={12: "So many products are made; the sum runs over three at a time.",
               3: "axis=-1 is the axis of the coordinates: it is summed up and gone."},
    ),
    Prediction(
        "moved_corner",
        "From lesson 01: a collider is turned by 90 degrees about z, from x toward y, and then moved by (5, 0, 0). Its "
        "corner was at (1, 2, 0). Where is the corner along x now?",
        _moved_corner,
        "The turn takes (1, 2, 0) to (-2, 1, 0), and the shift to (3, 1, 0).",
        unit="m",
        wrong={7: "So it is after a turn the other way.", 6: "That is the shift without the turn."},
    ),
    Prediction(
        "ball_of_box",
        "A length in space: a box has half extents of 2, 1 and 2 m. How far is a corner from its centre?",
        _ball_of_box,
        "The root of 4 + 1 + 4. A ball of 3 m about the centre holds the box at every turn.",
        unit="m",
        wrong={5: "That is the sum. The corner's distance is the root of the sum of squares."},
    ),
    Prediction(
        "turned_cube",
        "A cube is turned by 45 degrees about one of its axes. How many times its own volume does the upright box "
        "around it have?",
        _turned_cube,
        "With e_1 = e_2 each of two sides grows by the root of 2, so the volume doubles: 1 + sin(90 deg) (1 + 1)/2.",
        wrong={51: "That is the rod. A cube is not long and thin.", 1.414: "Two sides grow by the root of 2, not one.",
               2.828: "Only two of the three sides grow: the third is along the axis of the turn."},
    ),
    Prediction(
        "which_kind",
        "A dumbbell, two balls on a thin bar, lies turned in space. Which of these three colliders around it has the "
        "least volume?",
        _which_kind,
        "The dumbbell is long and round: a capsule along it has its length and its width, whatever the turn. The "
        "directions of the k-DOP belong to the world, and none lies along the dumbbell.",
        choices={
            "box": "the box along the axes, with 6 sides",
            "kdop": "the k-DOP with 26 sides",
            "capsule": "the capsule, with one segment and one radius",
        },
        wrong={"kdop": "More sides help, but they stand in the world's directions."},
    ),
    Prediction(
        "tenfold_angle",
        "The rod lies along x, and its upright box is as large as itself. From which angle of turn on has the box ten "
        "times the rod's volume?",
        _tenfold_angle,
        "The ratio is 1 + sin(2 theta) (q + 1/q)/2 with q = 0.01, so sin(2 theta) = 0.18: 5.2 degrees.",
        unit="degrees",
        tolerance=0.1,
        wrong={9: "That is a fifth of 45: the ratio is steepest at the start, and does not wait for the middle.",
               45: "At 45 degrees it is 51."},
    ),
    Prediction(
        "diagonal_rod",
        "A setting not met before: the same rod points along the diagonal of a cube, (1, 1, 1). About how many times "
        "its volume has the upright box now?",
        _diagonal_rod,
        "Now all three sides are near 1/sqrt(3) = 0.58 m: 0.2 cubic metres against 0.0001 of the rod.",
        choices={"51": "about 51", "100": "about 100", "2000": "about 2,000"},
        wrong={"51": "In a plane two sides grow. Along the diagonal all three do.", "100": "One more side than at 45 "
               "degrees is not twice: it goes from 1 cm to 58 cm."},
    ),
)  # fmt: skip
DEEPER_PREDICTIONS = (
    Prediction(
        "ritter",
        "Ritter's sphere looks at each point twice. By how much is its radius larger than the smallest, on average "
        "over clouds of 100 random points?",
        _ritter,
        "About 7 percent: the widest of three pairs is nearly the widest of all, and each growth is the least that "
        "takes the point in. But it never shrinks again.",
        choices={
            "none": "less than 1 percent: it is nearly exact",
            "some": "between 3 and 12 percent",
            "third": "about a third",
        },
        later="Speed against accuracy",
    ),
    Prediction(
        "crowded",
        "A plate has thousands of points, evenly spread. Now most of them crowd along one diagonal, but the outline "
        "stays as it was. What does the box along the principal axes do?",
        _crowded,
        "The covariance sees the crowd and not the outline: its longest axis turns toward the diagonal, and the box "
        "grows.",
        choices={
            "same": "it stays as it was: the outline decides",
            "grows": "it turns toward the crowd and grows",
            "less": "it shrinks toward the crowd",
        },
        wrong={"less": "It must still hold every point of the outline."},
    ),
)
