"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Prediction

_HEIGHT = 3.0  # of one crossed cube over the other [m]


def _hidden_gap() -> str:
    from course.study import crossed_gaps

    faces, edges = crossed_gaps(_HEIGHT)
    return "another" if faces < 0 < edges else "none"


def _along() -> float:
    return float(np.array([2.0, 1.0]) @ np.array([0.6, 0.8]))


def _touching() -> str:
    return "yes" if formulas.shadow_gap(0.0, 2.0, 2.0, 3.0) <= 0 else "no"


def _stopped_height() -> float:
    from course.study import sinking_boxes

    times = np.linspace(0.0, 3.0, 31)
    sunk = sinking_boxes(45.0, 0.0, times, formulas.oriented_boxes_overlap)
    return float(sunk.height[-1])


def _six_axes() -> str:
    from course.study import by_axes, random_box_pairs

    pairs = random_box_pairs(2000, seed=5)
    said, true = by_axes(pairs, 6)[0], by_axes(pairs, 15)[0]
    share = np.sum(said & ~true) / np.sum(said)
    return "rare" if share < 0.005 else "ninth" if share < 0.2 else "fifth"


def _tilt() -> str:
    from course.study import called_apart

    shares = called_apart([1e-3, 1e-8, 1e-15], count=4000)
    wrong = np.array(["milli", "tiny", "rounding"])[shares > 1e-2]
    return str(wrong[0])


def _notch() -> float:
    outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3.0]])
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    x = np.linspace(0.0, 4.0, 401)
    moved = square + x[:, None, None]
    said = formulas.polygons_overlap(np.broadcast_to(outline, (401, 6, 2)), moved)
    return float(x[np.flatnonzero(said)[-1]])


def _triangle_and_box() -> int:
    faces_of_box, edges_of_box, face, edges = 3, 3, 1, 3
    return faces_of_box + face + edges_of_box * edges


def _shortest_way() -> str:
    """Shifts of the least length, in many directions: which of them parts the polygons?"""
    from course.study import PENTAGON, TRIANGLE, polygon_shadows, turned

    a = turned(TRIANGLE, 20.0, (-0.6, 0.4))
    found = polygon_shadows(a, PENTAGON)
    angle = np.radians(np.arange(3600) / 10)
    ways = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    depth = -found.gap.max()
    parting = [
        w
        for w in ways
        if polygon_shadows(a + 1.0001 * depth * w, PENTAGON).gap.max() > 0
    ]
    across = np.abs(np.mean(parting, axis=0) @ found.axes.T).max()
    return "normal" if across > 0.999 else "centres"


def _products_of_64() -> int:
    n = 64
    return 2 * n * (2 * (2 * n - 4) + (3 * n - 6) ** 2)


PREDICTIONS = (
    Prediction(
        "hidden_gap",
        "Two boxes are apart, and their shadows on the normals of all six face directions overlap. What must be true?",
        _hidden_gap,
        "There is a direction along which their shadows have a gap, and it is normal to no face: it is across an edge "
        "of one and an edge of the other. Two convex shapes that are apart always have such a direction.",
        choices={
            "another": "their shadows have a gap along some other direction",
            "none": "no direction shows a gap: shadows alone cannot tell",
            "rounding": "a shadow was computed wrongly by rounding",
        },
        later="See",
    ),
    Prediction(
        "along",
        "How far along the unit vector n = (0.6, 0.8) is the point (2, 1)?",
        _along,
        "The dot product: 2 * 0.6 + 1 * 0.8 = 2.",
        unit="m",
        wrong={3: "That is the sum of the coordinates."},
    ),
    Prediction(
        "touching",
        "Intervals from 0 to 2 and from 2 to 3 share one point. Do they overlap, in this course?",
        _touching,
        "Solids are closed: they contain their surface, and a gap of 0 is an overlap.",
        choices={"yes": "yes", "no": "no"},
        wrong={"no": "Their common length is 0, but a common point is enough."},
    ),
    Prediction(
        "turned_edges",
        "The upper cube is turned by 45 degrees about z, so that its lower edge crosses A's upper edge at 45 degrees. "
        "Its centre sinks from high above A's. At which height do the two touch in truth?",
        _stopped_height,
        "Both edges are still level, so the axis across both is still z, and half a shadow on it is still the root of "
        "2: 2.83 m.",
        unit="m",
        tolerance=0.02,
        wrong={
            3.5355: "There the last gap on the six face normals closes; the axis across both edges still has one.",
            3.8284: "There the last gap on the face normals closed before the turn.",
            2: "They touch along their edges, which reach 1.41 m, farther than the 1 m of a face.",
        },
    ),
    Prediction(
        "six_axes",
        "Pairs of boxes are drawn at random, near enough for their bounding balls to overlap. Of the pairs that six "
        "axes call overlapping, how many are apart?",
        _six_axes,
        "Two edges that pass each other are no rare accident: of turned boxes that miss each other by less than a "
        "centimetre, only the products of edges show the gap in about half of the pairs.",
        choices={"rare": "fewer than 1 in 200", "ninth": "about 1 in 9", "fifth": "more than 1 in 5"},
    ),
    Prediction(
        "notch",
        "The square leaves the notch along the diagonal; its lower left corner is at (x, x). Up to which x does "
        "polygons_overlap, given the outline of the L, say that they overlap?",
        _notch,
        "The L's edges have two directions of normals only, x and y, and along both its shadow "
        "reaches to 3. The slanted side of its hull, which would part them from 2 m on, is no edge of the outline.",
        unit="m",
        tolerance=0.02,
        wrong={1: "Up to there they do overlap. The function does not know about the "
            "notch.", 2: "That is where it leaves the hull of the L, whose slanted edge the outline does not have."},
    ),
    Prediction(
        "triangle_and_box",
        "A setting not met before: a triangle in space, of a mesh, against a box. Count its axes as you counted those "
        "of two boxes. How many are there?",
        _triangle_and_box,
        "3 face normals of the box, 1 of the triangle, and 3 times 3 products of edges: 13.",
        tolerance=0.0,
        wrong={
            7: "Those are four faces and three edges: each edge is crossed with each of the box's three directions.",
            10: "The face of the triangle and the products are there; the three faces of the box come to it.",
            12: "The box's faces and the products are there; the triangle's own face comes to it.",
            15: "A box has three directions of faces, a triangle has one.",
            9: "Those are the products of edges; the faces come to it.",
            4: "Those are the faces; the products of edges come to it.",
        },
    ),
)  # fmt: skip
DEEPER_PREDICTIONS = (
    Prediction(
        "shortest_way",
        "Two convex polygons overlap. Along which direction is the shortest shift that parts them?",
        _shortest_way,
        "It is across an edge of A or of B: from a place inside a polygon the nearest place on its rim is the "
        "foot of a "
        "perpendicular on a side.",
        choices={
            "centres": "from middle to middle",
            "normal": "across an edge of one of the two",
            "corners": "from the deepest corner of one to the nearest corner of the other",
        },
        wrong={"centres": "So it is for circles."},
        later="Derive",
    ),
    Prediction(
        "products_of_64",
        "How many dot products does a verdict by all axes take, for two polytopes with 64 corners each?",
        _products_of_64,
        "124 faces and 186 edges each: 248 + 186^2 = 34,844 axes, times 128 corners.",
        tolerance=0.02,
        wrong={
            34844: "That is the number of axes. Each asks for the places of 128 corners."
        },
    ),
    Prediction(
        "tilt",
        "Two boxes that overlap are turned almost alike; the directions of their edges differ by a small tilt. From "
        "which tilt downward will the short form call more than one pair in a hundred apart?",
        _tilt,
        "The nine numbers are off by about 1e-16. Only where the tilt, the length of the product, is within ten times "
        "of that does the error matter to so many.",
        choices={
            "milli": "from 1e-3 rad on: small angles are risky",
            "tiny": "from 1e-8 rad on, the root of the rounding",
            "rounding": "not before about 1e-15 rad, near the rounding itself",
        },
        wrong={
            "tiny": "The root of the rounding appears where a small *square* is compared, as in 1 - cos. "
            "Here the tilt stands alone."
        },
    ),
)
