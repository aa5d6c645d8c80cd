"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Prediction

GRAVITY, STEPS = 9.81, 60  # [m/s^2], [1/s]


def _resting_or_colliding() -> str:
    """The same box, asked with a small and with a larger tolerance."""
    pressed = -GRAVITY / STEPS
    said = {
        str(formulas.contact_state(0.0, pressed, 0.0, (0.003, s))) for s in (0.05, 0.33)
    }
    return "nobody" if len(said) == 2 else said.pop()


def _closing_speed() -> float:
    return float(
        formulas.speed_along(np.array([1.0, 2.0, -3.0]), np.array([0.0, 0.0, 1.0]))
    )


def _air_in_the_hull() -> str:
    from course.study import mug, mug_collider

    filled = mug().volume() / float(mug_collider("hull").volume())
    return min((abs(filled - x), name) for name, x in _SHARES.items())[1]


_SHARES = {"quarter": 0.25, "half": 0.5, "most": 0.8}


def _fixed_tolerance() -> float:
    from course.study import share_without_rest

    rates = np.arange(30.0, 81.0)
    shares = [share_without_rest([0.2], steps_per_second=r)[0] for r in rates.tolist()]
    return float(rates[np.array(shares) > 0].max())


def _marble() -> str:
    from course.study import marble_height

    return "rim" if marble_height("hull") > 0.09 else "bottom"


def _lift() -> float:
    return (GRAVITY + 2.0) / STEPS


PREDICTIONS = (
    Prediction(
        "resting_or_colliding",
        "The gap of the box is 0, and in each step gravity makes its rate -0.16 m/s before the floor answers. Is it "
        "resting, is it colliding, or does nobody know from these two numbers?",
        _resting_or_colliding,
        "With a tolerance of 0.05 m/s it is called colliding, with 0.33 m/s resting, in the very same step. A number "
        "of the program decides, and it has to be at least g h = 0.16 m/s for a box that rests to be called so.",
        choices={
            "resting": "its height does not change",
            "colliding": "it touches, and it comes closer",
            "nobody": "these two numbers do not tell",
        },
        later="See",
    ),
    Prediction(
        "closing_speed",
        "From lesson 00: a box moves at v = (1, 2, -3) over a floor whose normal is n = (0, 0, 1). At which rate does "
        "its gap to the floor change?",
        _closing_speed,
        "v.n = -3: the gap closes at 3 m/s, so its rate is below 0.",
        unit="m/s",
        wrong={
            3: "A gap that closes becomes smaller: its rate is below 0.",
            0: "All three components do not add up: only the one along n counts.",
        },
    ),
    Prediction(
        "air_in_the_hull",
        "A mug without a handle stands in its convex hull, the tightest collider without hollows. Which share of "
        "the hull is mug?",
        _air_in_the_hull,
        "27 percent: the hull closes the mug like a lid, and nearly all inside of a mug is air.",
        choices={"quarter": "about a quarter", "half": "about a half", "most": "more than two thirds"},
        wrong={
            "half": "The wall is thin, 5 mm of 8 cm: the hollow takes more than half.",
            "most": "The wall is thin, 5 mm of 8 cm: most of the hull is the hollow.",
        },
    ),
    Prediction(
        "fixed_tolerance",
        "A program like that of the film has a fixed tolerance of 0.2 m/s. With few, long steps a box that was put "
        "down never rests. What is the largest whole number of steps a second at which it never does?",
        _fixed_tolerance,
        "g h = 0.2 m/s at h = 0.2/9.81 s: 49.05 steps a second. With 49 the step is a little too long.",
        unit="1/s",
        tolerance=0.002,  # 49.05, where the two are equal, is right as well
        wrong={
            50: "At 50 steps a second g h is 0.196 m/s, which is within 0.2: it rests.",
            60: "At 60 steps a second g h is 0.16 m/s, which is within 0.2.",
            30: "It fails there, but it fails sooner.",
        },
    ),
    Prediction(
        "marble",
        "The mug stands on the table, and its hull is its collider. A marble is let down into it. Where does it stop?",
        _marble,
        "A hull has no hollow: the marble stops level with the rim, on nothing that is seen.",
        choices={"bottom": "on the mug's bottom", "rim": "level with its rim, in mid-air", "half": "half way down"},
        wrong={"bottom": "The picture is hollow, the collider is not."},
    ),
    Prediction(
        "lift",
        "The box stands on the floor of a lift that accelerates upward at 2 m/s^2. The program works in the lift and "
        "takes 60 steps a second. Which is now the least tolerance of speed?",
        _lift,
        "In the lift everything falls at 9.81 + 2 m/s^2: (9.81 + 2)/60 = 0.197 m/s.",
        unit="m/s",
        tolerance=0.0015,  # from 0.1966 to 0.1971: whoever rounds down is below the edge
        wrong={
            0.2: "That is enough, but not the least.",
            0.196: "A little below the edge: it never rests.",
            0.16: "So it is in a lift that stands still.",
            0.164: "So it is in a lift that stands still.",
            0.13: "Upward: the box is pressed more, not less.",
            0.033: "That is the lift's share alone: gravity's comes on top.",
            0.0333: "That is the lift's share alone: gravity's comes on top.",
            0.1635: "So it is in a lift that stands still.",
            0.1302: "Upward: the box is pressed more, not less.",
        },
    ),
)  # fmt: skip
