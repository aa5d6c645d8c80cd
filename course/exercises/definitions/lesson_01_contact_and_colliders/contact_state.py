"""The exercise ``contact_state``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

#: A gap, its rate and the slip, in units of the tolerances: no word near its border.
_KINDS = np.array([
    [3.0, -9.0, 0.0], [1.4, 0.3, 4.0], [1.6, 8.0, 0.2], [2.0, -0.5, 0.0],
    [-1.5, -6.0, 0.0], [-3.0, 5.0, 2.0], [-1.3, 0.2, 0.4], [-1.8, -0.4, 3.0],
    [0.0, -3.0, 0.0], [0.6, -1.6, 5.0], [-0.7, -8.0, 0.3], [-0.4, -1.5, 2.0],
    [0.0, 2.0, 0.0], [0.5, 1.5, 3.0], [-0.6, 6.0, 0.4], [0.3, 1.4, 0.2],
    [0.0, -0.7, 1.5], [0.7, 0.4, 4.0], [-0.5, -0.3, 2.0], [-0.8, 0.6, 7.0],
    [0.0, -0.7, 0.0], [0.7, 0.5, 0.3], [-0.6, -0.6, 0.6], [-0.3, 0.3, 0.5],
])  # fmt: skip


def _case(label: str, gap: Any, rate: Any, slip_speed: Any, tolerance: Any) -> Case:
    names = ("gap", "gap_rate", "slip_speed", "tolerance")
    values = (gap, rate, slip_speed, tolerance)
    return Case(label, dict(zip(names, values, strict=True)))


def _several(rng: np.random.Generator, label: str, shape: tuple[int, ...]) -> Case:
    """All kinds in turn, each a little otherwise than the table has it."""
    distance, speed = rng.uniform(0.002, 0.009), rng.uniform(0.1, 0.5)
    count = int(np.prod(shape))
    drawn = _KINDS[rng.permutation(len(_KINDS))[np.arange(count) % len(_KINDS)]]
    drawn = drawn * rng.uniform(0.95, 1.05, (count, 3)) * [distance, speed, speed]
    gap, rate, slip_speed = drawn.T.reshape(3, *shape)
    case = _case(label, gap, rate, slip_speed, (distance, speed))
    return Case(label, case.arguments, "batch")


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    step = (0.004, 0.25)
    on = (0.25, 0.5)  # of which sums are exact
    return [
        _case("a box that gravity presses on the floor", 0.0, -0.16, 0.0, step),
        _case("it comes down at 2 m/s", 0.001, -2.0, 0.0, step),
        _case("it comes down askew", 0.001, -2.0, 1.5, step),
        _case("it comes down at 2 m/s, still 5 cm away", 0.05, -2.0, 0.0, step),
        _case("it leaves", 0.001, 1.0, 0.0, step),
        _case("a book slides along", -0.002, 0.0, 1.5, step),
        _case("it is 2 cm deep in the floor", -0.02, -2.0, 0.0, step),
        _several(rng, "three pairs", (3,)),
        _several(rng, "all kinds", (24,)),
        _several(rng, "a 2 by 24 batch", (2, 24)),
        *(
            Case(f"on a tolerance, {what}", _case("", *values, on).arguments, "edge")
            for what, values in (
                ("the gap", (0.25, 0.0, 0.0)),
                ("the depth", (-0.25, 0.0, 0.0)),
                ("coming", (0.0, -0.5, 0.0)),
                ("leaving", (0.0, 0.5, 0.0)),
                ("the slip", (0.0, 0.0, 0.5)),
            )
        ),
    ]


def _slip(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.contact_state, *edits), message)


def _by_ifs(gap, gap_rate, slip_speed, tolerance):
    distance, speed = tolerance
    if gap > distance:
        return "apart"
    if gap < -distance:
        return "penetrating"
    if gap_rate < -speed:
        return "colliding"
    if gap_rate > speed:
        return "separating"
    return "sliding" if slip_speed > speed else "resting"


def _cut(letters: int) -> Mistake:
    """Words written into an array whose first ones were no longer than so many letters."""

    def cut(gap, gap_rate, slip_speed, tolerance):
        said = formulas.contact_state(gap, gap_rate, slip_speed, tolerance)
        return np.asarray(said).astype(f"U{letters}")

    return Mistake(
        f"words of {letters}",
        cut,
        f"NumPy has cut your words to {letters} letters: an array holds words as long as the longest it was made "
        'with. np.select has room for all; so has np.full(..., dtype="U11").',
    )


_ASKED = """        gap > distance,
        gap < -distance,
        gap_rate < -speed,
        gap_rate > speed,
        slip_speed > speed,
"""
_WORDS = '["apart", "penetrating", "colliding", "separating", "sliding"]'

CONTACT_STATE = Exercise(
    name="contact_state",
    rows=(1,),
    points=3,
    minutes=13,
    task='Return what two bodies are to each other: "apart", "penetrating", "colliding", "separating", "sliding" or '
    '"resting". What lies on a tolerance is within it.',
    arguments=(
        Value("gap", "(...)", "m", "below 0 where they penetrate"),
        Value("gap_rate", "(...)", "m/s", "below 0 where they approach"),
        Value("slip_speed", "(...)", "m/s", "along each other, not below 0"),
        Value("tolerance", "(distance, speed)", "m, m/s", "two numbers, above 0"),
    ),
    results=(Value("state", "(...)", "", "one of the six words", dtype="str"),),
    reference=formulas.contact_state,
    cases=_cases,
    mistakes=(
        _slip(
            "coming and leaving",
            "gap_rate < -speed",
            "gap_rate > speed",
            "gap_rate > speed,\n        slip",
            "gap_rate < -speed,\n        slip",
            message="Coming and leaving have changed places. A gap that closes becomes smaller: its rate is below 0.",
        ),
        _slip(
            "no tolerance of speed",
            "gap_rate < -speed",
            "gap_rate < 0",
            "gap_rate > speed",
            "gap_rate > 0",
            message="You compare the rate with 0. Then only a rate of exactly 0 is rest, and what gravity adds in a "
            "step is a collision.",
        ),
        _slip(
            "no tolerance of coming",
            "gap_rate < -speed",
            "gap_rate < 0",
            message="You say colliding as soon as the rate is below 0. Gravity makes it so in every step: only what is "
            "faster than the tolerance collides.",
        ),
        _slip(
            "size of the rate",
            "gap_rate < -speed",
            "abs(gap_rate) > speed",
            message="You take the size of the rate, so what leaves is colliding too. Compare without abs: the sign "
            "tells coming from leaving.",
        ),
        *map(_cut, (1, 5, 7)),
        _slip(
            "nothing left",
            ', default="resting"',
            "",
            message="np.select puts a 0 where no condition holds, and that is no word. Give it one for what is left: "
            "default=...",
        ),
        _slip(
            "no distance above",
            "gap > distance",
            "gap > 0",
            message="You say apart from 0 on. Two bodies touch while the gap is at most the distance of the tolerance.",
        ),
        _slip(
            "no distance below",
            "gap < -distance",
            "gap < 0",
            message="You say penetrating from 0 on. They touch down to minus the distance of the tolerance.",
        ),
        _slip(
            "no distance at all",
            "gap > distance",
            "gap > 0",
            "gap < -distance",
            "gap < 0",
            message="You compare the gap with 0. No program that steps lands on 0: within the distance they touch.",
        ),
        _slip(
            "distance and speed",
            "distance, speed = tolerance",
            "speed, distance = tolerance",
            message="The two tolerances have changed places: the distance comes first, then the speed.",
        ),
        _slip(
            "no slip",
            "slip_speed > speed",
            "slip_speed < 0",
            message="You never say sliding. What touches and neither comes nor leaves may still move along.",
        ),
        _slip(
            "any slip",
            "slip_speed > speed",
            "slip_speed > 0",
            message="You say sliding for any slip above 0. The tolerance of speed holds for it as for the rate.",
        ),
        _slip(
            "slip before the rate",
            _ASKED,
            "        gap > distance,\n        gap < -distance,\n        slip_speed > speed,\n"
            "        gap_rate < -speed,\n        gap_rate > speed,\n",
            _WORDS,
            '["apart", "penetrating", "sliding", "colliding", "separating"]',
            message="You ask for the slip before the rate: what comes down askew then slides, and nothing stops it.",
        ),
        _slip(
            "rate before the gap",
            _ASKED,
            "        gap_rate < -speed,\n        gap_rate > speed,\n        gap > distance,\n"
            "        gap < -distance,\n        slip_speed > speed,\n",
            _WORDS,
            '["colliding", "separating", "apart", "penetrating", "sliding"]',
            message="You ask for the rate before the gap: what falls is then colliding while it is still high above.",
        ),
        _slip(
            "depth after the rate",
            _ASKED,
            "        gap > distance,\n        gap_rate < -speed,\n        gap_rate > speed,\n"
            "        gap < -distance,\n        slip_speed > speed,\n",
            _WORDS,
            '["apart", "colliding", "separating", "penetrating", "sliding"]',
            message="You ask for the depth after the rate. What is too deep is penetrating, however it moves.",
        ),
        _slip(
            "size of the gap",
            "gap > distance",
            "abs(gap) > distance",
            message="You take the size of the gap, so what is deep in the floor is apart. Its sign says on which side.",
        ),
        _slip(
            "on a tolerance",
            "gap > distance",
            "gap >= distance",
            "gap < -distance",
            "gap <= -distance",
            "gap_rate < -speed",
            "gap_rate <= -speed",
            "gap_rate > speed",
            "gap_rate >= speed",
            "slip_speed > speed",
            "slip_speed >= speed",
            message="What lies exactly on a tolerance is within it: compare with > and <.",
        ),
        Mistake(
            "ifs",
            _by_ifs,
            "Right for one pair of bodies. An `if` takes one decision, and a batch needs one for each pair: np.select "
            "takes a list of conditions and a list of words.",
        ),
    ),  # fmt: skip
    hints=(
        "Which question comes first? What is apart, or too deep, is that however it moves; how it moves counts for "
        "what touches, and the slip for what neither comes nor leaves.",
        "Five conditions in that order: above the distance, below minus the distance, rate below minus the speed, rate "
        "above the speed, slip above the speed. np.select gives the word of the first one that holds.",
        "distance, speed = tolerance\n"
        "asked = [gap > distance, gap < ____, gap_rate < ____, gap_rate > ____, ____]\n"
        'words = ["apart", "penetrating", "colliding", "separating", "sliding"]\n'
        'return np.select(asked, words, default="____")',
    ),
)
