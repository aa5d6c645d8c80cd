"""The exercise ``miss_probability``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_FORMULA = "1 - seen / np.maximum(way, seen)"


def _looks(*values: Any) -> dict[str, Any]:
    names = ("thickness", "radius", "speed", "step")
    return dict(zip(names, values, strict=True))


def _drawn(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    """Walls and balls of which every third is too slow to be missed."""
    thickness = rng.uniform(0.05, 0.5, shape)
    radius = rng.uniform(0.02, 0.2, shape)
    step = rng.uniform(0.01, 0.05, shape)
    kind = np.arange(int(np.prod(shape))).reshape(shape) % 3
    ways = np.where(
        kind == 0, rng.uniform(0.3, 0.9, shape), rng.uniform(1.2, 9.0, shape)
    )
    speed = ways * (thickness + 2 * radius) / step
    return _looks(*(np.round(x, 4) for x in (thickness, radius, speed, step)))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    x = np.round(rng.uniform(0.5, 0.9, 2), 3)
    return [
        Case("a ball of 20 cm and a wall of 30 cm", _looks(0.3, 0.1, 20.0, 0.1)),
        Case("a faster one", _looks(0.25, 0.05, 30.0 + x[0], 0.1)),
        Case("too slow to be missed", _looks(0.3, 0.1, 4.0 * x[1], 0.1)),
        Case("just seen in every case", _looks(0.25, 0.125, 4.0, 0.125), "edge"),
        Case("a wall without thickness", _looks(0.0, 0.125, 10.0, 0.1), "edge"),
        Case("a point", _looks(0.2, 0.0, 10.0, 0.1), "edge"),
        Case("at rest", _looks(0.2, 0.1, 0.0, 0.1), "edge"),
        Case("six of them", _drawn(rng, (6,)), "batch"),
        Case("a 2 by 4 batch", _drawn(rng, (2, 4)), "batch"),
    ]


#: Wrong lengths: their name, what is replaced by what, and the message.
_PIECES = (
    (
        "one radius", "2 * radius", "radius",
        "It touches from the moment its front meets the wall until its back has left it: that adds a whole diameter to "
        "the thickness, not a radius.",
    ),
    (
        "a point", "2 * radius", "0 * radius",
        "You treat the ball as a point. Its front touches the wall before its centre is there, and its back after.",
    ),
    (
        "not both sides", "thickness + 2 * radius", "thickness - 2 * radius",
        "The ball's size makes it easier to see, not harder: its diameter is added to the thickness.",
    ),
    (
        "speed over step", "speed * step", "speed / step",
        "From one look to the next it goes speed times step, and that belongs below the fraction. You divided one by "
        "the other.",
    ),
)  # fmt: skip
#: As it is asked; cut off at 0 with a division by 0 at rest; and not cut off, which differs in the first three.
_FORMS = ("", "np.clip(1 - seen / way, 0, 1)", "1 - seen / way")
_BESIDES = dict(zip(_FORMS, (
    "", " Besides, at rest you divide by 0.", " Besides, it may leave 0 to 1, and at rest you divide by 0.",
), strict=True))  # fmt: skip


def _wrong_piece(name: str, old: str, new: str, message: str, form: str) -> Mistake:
    edits = (old, new, _FORMULA, form) if form else (old, new)
    return Mistake(
        f"{name}, {form}" if form else name,
        slip(formulas.miss_probability, *edits),
        message + _BESIDES[form],
    )


MISS_PROBABILITY = Exercise(
    name="miss_probability",
    rows=(12,),
    points=1,
    minutes=8,
    task="Return the probability that a ball passes through a wall and no look, once a step, sees it touch.",
    arguments=(
        Value("thickness", "(...)", "m", "of the wall"),
        Value(
            "radius", "(...)", "m", "of the ball; thickness and radius are not both 0"
        ),
        Value(
            "speed",
            "(...)",
            "m/s",
            "across the wall, not below 0; 0 at rest in front of it",
        ),
        Value("step", "(...)", "s", "time from one look to the next"),
    ),
    results=(Value("probability", "(...)", "", "from 0 to 1"),),
    reference=formulas.miss_probability,
    cases=_cases,
    mistakes=(
        Mistake(
            "the chance to be seen",
            slip(formulas.miss_probability, _FORMULA, "seen / np.maximum(way, seen)"),
            "That is the probability that a look *does* see it. Asked is the rest.",
        ),
        Mistake(
            "the chance to be seen, cut off at 1",
            slip(formulas.miss_probability, _FORMULA, "np.minimum(seen / way, 1)"),
            "That is the probability that a look *does* see it, and asked is the rest. Besides, at rest you "
            "divide by 0.",
        ),
        Mistake(
            "below 0",
            slip(formulas.miss_probability, "np.maximum(way, seen)", "way"),
            "Right for fast balls. A slow one is seen by one look at least, often by several: its probability is 0, "
            "not below 0, and at rest you divide by 0.",
        ),
        Mistake(
            "cut off at 0",
            slip(formulas.miss_probability, _FORMULA, "np.maximum(1 - seen / way, 0)"),
            "Right but at rest: there the way from look to look is 0, and you divide by it. Make what stands below the "
            "fraction no less than what stands above it, and the answer is 0 by itself.",
        ),
        Mistake(
            "seen too often",
            slip(
                formulas.miss_probability,
                "np.maximum(way, seen)",
                "np.minimum(way, seen)",
            ),
            "np.maximum and np.minimum changed places: the fast balls get 0, and the slow ones a number.",
        ),
        Mistake(
            "one number for the batch",
            slip(
                formulas.miss_probability,
                "np.maximum(way, seen)",
                "np.max(np.maximum(way, seen))",
            ),
            "Right for one. For a batch you take one way for all: np.maximum compares place by place, np.max takes "
            "the largest of the whole array.",
        ),
        *(_wrong_piece(*wrong, form) for wrong in _PIECES for form in _FORMS[:2]),
        *(_wrong_piece(*wrong, _FORMS[2]) for wrong in _PIECES[:3]),
    ),  # fmt: skip
    hints=(
        "Mark on the line along which it flies where its centre is while it touches the wall. How long is that piece, "
        "and how far apart are the looks?",
        "The looks are speed * step apart, and where the first one falls is chance. The share of that way on which it "
        "touches is the chance to be seen; it cannot be more than 1.",
        "seen, way = thickness + ____, speed * step\nreturn 1 - seen / np.maximum(____, ____)",
    ),
)
