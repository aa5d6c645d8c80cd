"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Prediction

_SPEED = 900.0


def _missed(rate: float) -> float:
    from course.study.wall_shots import RADIUS, THICKNESS

    return float(formulas.miss_probability(THICKNESS, RADIUS, _SPEED, 1 / rate))


def _enough() -> str:
    """The smallest of three rates at which no bullet passes."""
    rates = {"double": 120, "thousands": 10_000}
    for name, rate in rates.items():
        if _missed(rate) == 0:
            return name
    return "none"


def _sign_of_c() -> float:
    m = np.array([1.0, 2.0, 2.0])
    return float(m @ m - (1.0 + 1.5) ** 2)


def _one_axis_apart() -> str:
    gaps = formulas.shadow_gap(
        np.array([0.0, 0.0, 0.0]), np.array([2.0, 2.0, 2.0]), np.array([1.0, -1.0, 3.0]), np.array([4.0, 1.0, 4.0])
    )  # fmt: skip
    return "yes" if np.all(gaps <= 0) else "no"


def _looks_needed() -> float:
    """The rate at which the probability first is 0, by halving."""
    low, high = 60.0, 1e5
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _missed(middle) > 0 else (low, middle)
    return high


def _looks_for_one_percent() -> str:
    from course.study import by_looks, missed_share, random_shots, true_hits

    shots = random_shots(2000, seed=6)
    hits = true_hits(shots)
    for name, looks in (("20", 20), ("60", 60), ("200", 200)):
        if missed_share(by_looks(shots, looks)[0], hits) < 0.01:
            return name
    return "more"


def _single() -> str:
    from course.study import wrong_in_single

    shares = wrong_in_single(formulas.swept_spheres_time, [10.0, 1e3])
    wrong = np.array(["ten", "kilometre"])[shares > 0.05]
    return str(wrong[0]) if wrong.size else "farther"


def _thrown_back() -> str:
    from course.study import held_share

    (share,) = held_share(formulas.swept_spheres_time, [0.0])
    return "none" if share < 0.05 else "half" if share < 0.8 else "all"


def _light_barrier() -> float:
    return float(formulas.miss_probability(0.0, 0.035, 40.0, 0.01))


def _half_turn() -> str:
    from course.study import ball_ahead, rod_time, tip_swept_straight

    rod = ball_ahead(2.0, 90.0, 1.05)
    straight = tip_swept_straight(rod, np.pi / 2.0)
    if np.isinf(straight):
        return "never"
    return "early" if straight < rod_time(rod) else "late"


def _more_digits() -> str:
    from course.study import advancement_steps, ball_ahead

    rod = ball_ahead(2.0, 90.0, 0.6)
    steps = [advancement_steps(rod, 10.0**-k)[1] for k in (4, 8)]
    return "few" if steps[1] - steps[0] < 20 else "many"


PREDICTIONS = (
    Prediction(
        "enough_looks",
        "The bullet is looked at 60 times a second, and 99 in 100 pass. How many looks a second are enough for none to "
        "pass?",
        _enough,
        "From one look to the next the bullet must not go farther than the piece on which it touches the wall, "
        "10.4 cm. "
        "At 900 m/s that takes 8,654 looks a second.",
        choices={
            "double": "twice as many: 120",
            "thousands": "some thousands",
            "none": "no number is enough: a look is a moment",
        },
        later="See",
    ),
    Prediction(
        "without_a_root",
        "From lesson 04: the centres of two spheres differ by m = (1, 2, 2) m, their radii are 1 and 1.5 m. What is "
        "m.m - r^2, with r the sum of the radii?",
        _sign_of_c,
        "9 - 6.25 = 2.75: above 0, so they are apart, and no root was needed.",
        unit="m²",
        wrong={0.5: "That is the gap, 3 - 2.5. Asked are the squares.", 5.75: "The radii are added before they are "
            "squared."},
    ),
    Prediction(
        "one_axis_apart",
        "From lesson 05: the shadows of two upright boxes overlap on x and on y, and have a gap on z. Do the boxes "
        "overlap?",
        _one_axis_apart,
        "One axis with a gap is proof that they are apart. To overlap they must overlap on all three.",
        choices={"yes": "yes", "no": "no"},
        wrong={"yes": "Two of three are not enough: a plane across z fits into the gap."},
    ),
    Prediction(
        "looks_needed",
        "How many looks a second must there be at least, so that the probability to miss this bullet is 0?",
        _looks_needed,
        "It touches the wall on 0.1 + 2 * 0.002 = 0.104 m of its way, and 900/0.104 = 8,654.",
        unit="looks a second",
        tolerance=0.002,
        wrong={4327: "There half of them are seen. Asked is a probability of 0.",
            9000: "That is 900/0.1, for a point.", 8823.5: "The front meets the wall a radius before the "
        "centre, and "
            "the back leaves it a radius after: a whole diameter."},
    ),
    Prediction(
        "looks_for_one_percent",
        "2,000 bullets at 450 to 900 m/s fly at balls of 10 cm to 1 m across, for 1/60 s. From how many looks a "
        "step on "
        "will fewer than 1 in 100 hits be missed?",
        _looks_for_one_percent,
        "60 looks are 20 cm apart, and miss 10 in 100; 200 looks miss 0.65. What is left is bullets that hit a ball "
        "near its rim, where the way through it is short.",
        choices={"20": "20", "60": "60", "200": "200", "more": "more than 200"},
        wrong={"20": "Then the looks are half a metre apart: only the largest balls are hit surely.",
            "60": "Through the middle of each ball that would do. But most do not hit the middle.",
            "more": "Some are missed with any number, but fewer than 1 in 100 with 200."},
    ),
    Prediction(
        "thrown_back",
        "Balls are stopped at the time of impact, put at x + v t, and thrown back the way they came. How many "
        "will your "
        "function say meet again at once, at 0 s?",
        _thrown_back,
        "After the stop the gap is not 0 but some 1e-15 m, above or below. Where it is below, the balls "
        "overlap, and who "
        "overlaps meets at 0, whichever way it moves.",
        choices={"none": "none: they part", "half": "about half", "all": "nearly all"},
        wrong={"none": "They part. But the function gives 0 for all that overlap, before it asks which way they move.",
            "all": "If they all overlapped, yes. Rounding puts some before the touch and some behind it."},
    ),
    Prediction(
        "light_barrier",
        "A setting not met before: a light barrier is read 100 times a second. Its beam is as good as a line. A "
        "ball of "
        "7 cm across is thrown at 40 m/s, and its centre crosses the beam. With which probability does it see nothing?",
        _light_barrier,
        "It breaks the beam on 7 cm of its way, and moves 40 cm from reading to reading: 1 - 7/40 = 0.825.",
        tolerance=0.005,
        wrong={0.175: "That is the probability that it sees it.", 0.9125: "It breaks the beam on a whole diameter.",
            0.65: "7 cm is the diameter already.", 82.5: "As a probability that is 0.825."},
    ),
)  # fmt: skip
DEEPER_PREDICTIONS = (
    Prediction(
        "half_turn",
        "A rod turns half round within one step. A program takes its tip to run straight from where it begins to where "
        "it ends. A ball lies a quarter turn ahead, just where the tip comes by. When does the program see them meet?",
        _half_turn,
        "Never: the straight way from the tip's first place to its last leads through the pivot, a metre from "
        "the ball.",
        choices={"early": "too early", "late": "too late", "never": "never"},
        later="Derive",
    ),
    Prediction(
        "more_digits",
        "The tip comes straight at a ball. The tolerance is made 10,000 times smaller, from 1e-4 to 1e-8 m. How "
        "many more "
        "steps does the loop take?",
        _more_digits,
        "About ten. Near the impact each step leaves the same share of the gap, here two fifths, so each further digit "
        "costs the same few steps.",
        choices={"few": "about ten", "many": "a hundred times as many"},
        wrong={
            "many": "So it would be if the steps were of one length. They shrink with the gap."
        },
    ),
    Prediction(
        "far_marble",
        "Two balls, each 4 mm across, in numbers of 32 bits (7 digits). From how far away will lesson 06's function "
        "judge one shot in 20 wrongly?",
        _single,
        "Under the root stands a difference of two numbers of about v^2 m^2, and what counts is v^2 r^2. At 12 "
        "m the one "
        "is ten million times the other: the seven digits are used up.",
        choices={
            "ten": "about ten metres",
            "kilometre": "about a kilometre",
            "farther": "farther still",
        },
        wrong={
            "kilometre": "There a place is known to 0.06 mm, which would be enough. But the function squares it."
        },
    ),
)
