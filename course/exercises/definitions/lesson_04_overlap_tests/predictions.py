"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Prediction

_FAR = 1e8  # where the spheres of the question are [m]


def _eight_metres() -> str:
    from course.study import far_places as far

    pairs = far.sphere_pairs(4000, _FAR, seed=4)
    four = far.stored(pairs, 4)
    wide = far.wrong_verdicts(formulas.spheres_overlap, far.stored(four, 8))
    first = far.stored(far.seen_from_a(pairs), 4)
    order = far.wrong_verdicts(formulas.spheres_overlap, first)
    return "order" if order == 0.0 < wide else "bytes"


def _sums_in_a_batch() -> int:
    a = np.ones((4, 5, 3))
    return int(np.sum(a * a, axis=-1).size)


def _box_of_rod() -> float:
    from course.shapes import Capsule

    bounds = Capsule(np.zeros(3), np.array([3.0, 4.0, 0.0]), np.array(0.5)).bounds()
    return float(bounds.upper[0] - bounds.lower[0])


def _two_bytes() -> str:
    from course.study import far_places as far

    pairs = far.sphere_pairs(10_000, 1e6, seed=4, clear=1e-3)
    four = far.wrong_verdicts(formulas.spheres_overlap, far.stored(pairs, 4))
    first = far.stored(far.seen_from_a(pairs), 2)
    two = far.wrong_verdicts(formulas.spheres_overlap, first)
    return "two" if two < 0.5 * four else "four" if four < 0.5 * two else "same"


def _first_wrong() -> str:
    from course.study import safe_until

    limit = safe_until(0.01)
    return "1" if limit < 5e3 else "65" if limit < 1e6 else "10000"


def _tenths_touch() -> str:
    far, near = np.array([0.8, 0.0, 0.0]), np.zeros(3)
    said = formulas.spheres_overlap(near, 0.1, far, 0.7)
    return "touch" if said else "apart"


def _clock() -> float:
    from course.study import spacing

    powers = 2.0 ** np.arange(30)
    first = next(t for t in powers if spacing(t) > 1 / 60)
    return float(first / 3600)


def _end_among() -> str:
    """Rods with ends drawn in a cube: are the feet of the line across both inside both?"""
    rng = np.random.default_rng(4)
    a, b, c, d = rng.uniform(size=(4, 4000, 3))
    nothing = np.zeros(4000)
    gap = formulas.capsule_gap(a, b, nothing, c, d, nothing)
    across = np.cross(b - a, d - c)
    lines = np.abs(np.sum((c - a) * across, axis=-1)) / np.linalg.norm(across, axis=-1)
    share = np.mean(gap > lines * (1 + 1e-9))
    return "few" if share < 0.3 else "most" if share < 0.9 else "all"


def _depth_inside() -> float:
    centre, r = np.array([2.0, 2.0, 0.25]), 0.5
    upper = np.array([4.0, 4.0, 1.0])
    return float(formulas.sphere_box_gap(centre, r, np.zeros(3), upper))


PREDICTIONS = (
    Prediction(
        "eight_metres",
        "On the right the same formula decides, and every place is stored in 4 bytes. What would make it stop B where "
        "the spheres touch?",
        _eight_metres,
        "The formula loses nothing: the places are rounded before it sees them, and no arithmetic brings back what is "
        "gone. Subtracted first, the places are small numbers, and 4 bytes are more than enough.",
        choices={
            "formula": "a formula with fewer roundings",
            "bytes": "the same formula, reckoning in 8 bytes from the stored places",
            "order": "the same formula in 4 bytes, on places that are subtracted before they are rounded",
        },
        wrong={
            "formula": "The formula's own roundings are a millionth of a metre here.",
            "bytes": "It reckons exactly with places that are wrong by metres.",
        },
        later="See",
    ),
    Prediction(
        "sums_in_a_batch",
        "From lesson 00: a and b have the shape (4, 5, 3). How many numbers are in np.sum(a * b, axis=-1)?",
        _sums_in_a_batch,
        "The last axis is summed, the others stay: shape (4, 5), 20 numbers, one for each pair.",
        tolerance=0.0,
        wrong={60: "So many products are summed.", 1: "That is the sum without axis=-1.", 3: "That is what is summed."},
    ),
    Prediction(
        "box_of_rod",
        "From lesson 02: a capsule of radius 0.5 m runs from (0, 0, 0) to (3, 4, 0). How long is its upright bounding "
        "box along x?",
        _box_of_rod,
        "From 0 - 0.5 to 3 + 0.5: the segment's own 3 m, and the radius at both ends.",
        unit="m",
        wrong={
            3: "The radius sticks out at both ends.",
            3.5: "The radius sticks out at both ends.",
            5: "That is the length of the segment.",
        },
    ),
    Prediction(
        "two_bytes",
        "Spheres 1,000 km from the origin, between 1 mm and 50 cm from touching. Which way has fewer wrong verdicts?",
        _two_bytes,
        "Seen from A, B is a few metres away, and 2 bytes have steps of 1 or 2 mm there. Seen from the origin, 4 bytes "
        "have steps of 6 cm.",
        choices={
            "four": "places as they are, in 4 bytes a number",
            "two": "places seen from A, in 2 bytes a number",
            "same": "about the same",
        },
        wrong={"four": "Twice the digits, but most of them are spent on the way from the origin."},
    ),
    Prediction(
        "first_wrong",
        "All pairs are at least 1 cm from touching, and places are stored in 4 bytes. Up to which coordinate is every "
        "verdict right for sure? (A coordinate is off by up to half a step; there are three.)",
        _first_wrong,
        "The distance is off by up to the root of 3 times a step, 1.73 steps. Steps of 3.9 mm are fine, of 7.8 mm not; "
        "those begin at 2^16 m = 65.5 km.",
        choices={"1": "1 km", "65": "65 km", "10000": "10,000 km"},
        wrong={"10000": "The step there is 1 m.", "1": "The step there is a sixteenth of a millimetre."},
    ),
    Prediction(
        "tenths_touch",
        "Spheres with radii of 0.1 m and 0.7 m, their centres 0.8 m apart, all in 8 bytes. What does your function "
        "say?",
        _tenths_touch,
        "None of the three numbers can be stored. 0.1 + 0.7 comes out just below 0.8: 0.7999999999999999.",
        choices={"touch": "they overlap, since touching counts", "apart": "they are apart"},
        wrong={"touch": "So it would be in exact numbers."},
    ),
    Prediction(
        "clock",
        "A setting not met before: a game keeps the time since its start in seconds, in 4 bytes, and adds 1/60 s a "
        "step. After how many hours is the step from one stored number to the next larger than 1/60 s?",
        _clock,
        "4 bytes have steps of 2^(k - 23) from 2^k on. 2^-6 = 1/64 is still smaller than 1/60, 2^-5 is not: k = 18, "
        "and 2^18 s are 72.8 hours.",
        unit="h",
        tolerance=0.02,
        wrong={
            36.4: "From there on the step is 1/64 s, still smaller than 1/60 s.",
            145.6: "That is one power of 2 too many.",
            262144: "So many seconds; asked are hours.",
        },
    ),
)  # fmt: skip
DEEPER_PREDICTIONS = (
    Prediction(
        "end_among",
        "Two thin rods, with ends drawn anywhere in a cube. How often is an *end* of one of them among the two nearest "
        "points?",
        _end_among,
        "In 58 of 100 cases. In the other 42 the feet of the line across both lie inside both rods.",
        choices={
            "few": "seldom: they are nearest somewhere between their ends",
            "most": "in somewhat more than half of the cases",
            "all": "practically always",
        },
        later="Derive",
    ),
    Prediction(
        "depth_inside",
        "A sphere of 0.5 m has its centre at (2, 2, 0.25), inside a box from (0, 0, 0) to (4, 4, 1). What is the gap?",
        _depth_inside,
        "The nearest face is z = 0, 0.25 m away. The centre must go there, and another 0.5 m, before the sphere is "
        "out: -0.75 m.",
        unit="m",
        tolerance=0.01,
        wrong={
            -0.5: "So it would be with the centre on a face.",
            -0.25: "So the centre alone.",
            0.75: "Below 0 means overlapping.",
        },
    ),
)
