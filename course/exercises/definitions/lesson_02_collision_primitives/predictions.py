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


def _tenfold_angle() -> float:
    """Where 1 + sin(2 theta) (q + 1/q)/2 = 10, q the thickness over the length."""
    q = _ROD[1] / _ROD[0]
    return float(np.degrees(0.5 * np.arcsin(18.0 / (q + 1 / q))))


def _which_kind() -> str:
    """The fewest looks among the fits with at most as much air as dumbbell."""
    from course.study import collider_fits as fits

    mesh = fits.turned_dumbbell()
    points, ratio = mesh.vertices, fits.fitted_volumes(mesh)
    ball, bar, other = (part.vertices for part in mesh.parts())
    looks = {
        "kdop26": 13 * len(points),
        "capsule": fits.capsule_looks(points),
        "convex_hull": fits.hull_looks(points),
        "compound": fits.sphere_looks(ball) + fits.capsule_looks(bar) + fits.sphere_looks(other),
    }  # fmt: skip
    close = [name for name in looks if ratio[name] <= 2]
    return {"kdop26": "kdop", "convex_hull": "hull"}.get(
        best := min(close, key=lambda name: looks[name]), best
    )


def _turned_plate() -> str:
    """A plate of 1 m by 1 m by 1 cm, turned about one of its long sides."""
    grown = _growth(np.array([0.5, 0.005, 0.5]), _about_z(45.0))
    return "two" if grown < 10 else "fifty" if grown < 100 else "thousands"


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
        wrong={"angle": "A cube turned by 45 degrees doubles. The form decides.",
               "third": "The side along the axis of the turn is as it was, 1 cm."},
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
        "The dumbbell has 674 corners. A collider with at most as much air as dumbbell is wanted. Which of these takes "
        "the fewest looks at a corner to make?",
        _which_kind,
        "Each part of the compound is round and small, and its kind was chosen for it: its two spheres and its capsule "
        "see only the corners of their own part, a few times each.",
        choices={
            "kdop": "the k-DOP with 26 sides",
            "capsule": "the capsule, with one segment and one radius",
            "hull": "the convex hull",
            "compound": "the compound: a sphere, a capsule, a sphere",
        },
        wrong={
            "kdop": "Its 26 sides leave 1.7 times as much air as dumbbell: none lies along it.",
            "capsule": "It is close enough, but looks nearly three times as often.",
            "hull": "It is close enough, but looks at every corner for every side.",
        },
    ),
    Prediction(
        "tenfold_angle",
        "The rod lies along x, and its upright box is as large as itself. From which angle of turn on has the box ten "
        "times the rod's volume? What is within 3 percent counts.",
        _tenfold_angle,
        "The ratio is 1 + sin(2 theta) (q + 1/q)/2 with q = 0.01, so sin(2 theta) = 0.18: 5.2 degrees.",
        unit="degrees",
        tolerance=0.03,
        wrong={9: "That is a fifth of 45: the ratio is steepest at the start, and does not wait for the middle.",
               45: "At 45 degrees it is 51.",
               10.37: "That is 2 theta: the sine in the formula is that of twice the angle.",
               0.0905: "That is in radians.",
               5.76: "The rod's own volume is in it as well: the turn adds 9 times, not 10."},
    ),
    Prediction(
        "turned_plate",
        "A setting not met before: a square plate of 1 m by 1 m by 1 cm is turned by 45 degrees about one of its long "
        "sides. About how many times its volume has the upright box now?",
        _turned_plate,
        "In the plane of the turn it is the rod: 1 m by 1 cm, q = 0.01. The third side, along the axis of the turn, is "
        "as it was and cancels, whether it is 1 cm or 1 m.",
        choices={"two": "about 2", "fifty": "about 51", "thousands": "about 2,600"},
        wrong={"two": "So it is for a turn about its normal, in which it is a square.",
               "thousands": "Only two sides change: the one along the axis of the turn is as it was."},
    ),
)  # fmt: skip
DEEPER_PREDICTIONS = (
    Prediction(
        "ritter",
        "Ritter's sphere is made by going through the points twice. By how much is its radius larger than the "
        "smallest, on average over clouds of 100 random points?",
        _ritter,
        "About 7 percent: the widest of three pairs is nearly the widest of all, and each growth is the least that "
        "takes the point in. But it never shrinks again.",
        choices={
            "none": "less than 1 percent: it is nearly exact",
            "some": "between 3 and 12 percent",
            "third": "about a third",
        },
        wrong={
            "third": "In none of the clouds tried here was it more than a fifth too large."
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
        wrong={
            "same": "The axes come from a mean over all points, and the outline has only some of them.",
            "less": "It must still hold every point of the outline.",
        },
    ),
)
