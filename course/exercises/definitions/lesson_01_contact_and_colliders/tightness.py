"""The exercise ``tightness``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_FORMULA = "visual_volume / collider_volume"


def _case(
    rng: np.random.Generator, label: str, shape: tuple[int, ...], kind: str = "single"
) -> Case:
    visual = rng.uniform(0.2, 2.0, shape).round(3)
    collider = (visual * rng.uniform(1.1, 6.0, shape)).round(3)
    given = {"collider_volume": collider, "visual_volume": visual}
    return Case(label, given, kind)  # type: ignore[arg-type]


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    cube = {"collider_volume": 8.0, "visual_volume": 2.0}
    tight = {"collider_volume": 0.5, "visual_volume": 0.5}
    drawn = rng.uniform(1.2, 4.0, 3).round(3)
    return [
        Case("2 of 8 cubic metres", cube),
        _case(rng, "drawn", ()),
        _case(rng, "three bodies", (3,), "batch"),
        _case(rng, "a 2 by 4 batch", (2, 4), "batch"),
        Case(
            "three colliders of one body",
            {"collider_volume": drawn, "visual_volume": 0.7},
            "batch",
        ),
        Case("no air", tight, "edge"),
    ]


def _slip(name: str, new: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.tightness, _FORMULA, new), message)


def _of_one_number(collider_volume, visual_volume):
    return float(visual_volume) / float(collider_volume)


TIGHTNESS = Exercise(
    name="tightness",
    rows=(1,),
    points=1,
    minutes=3,
    task="Return the share of a collider's volume that the body it stands for fills: 1 means no air.",
    arguments=(
        Value("collider_volume", "(...)", "m³", "of a collider around the visual"),
        Value("visual_volume", "(...)", "m³", "of what is seen"),
    ),
    results=(Value("tightness", "(...)", "", "from 0 to 1"),),
    reference=formulas.tightness,
    cases=_cases,
    mistakes=(
        _slip(
            "the other way round",
            "collider_volume / visual_volume",
            "The two have changed places: a collider around a body has the larger volume, and a share is at most 1.",
        ),
        _slip(
            "percent",
            "100 * visual_volume / collider_volume",
            "This is the share in percent. Asked is the share itself, from 0 to 1.",
        ),
        _slip(
            "share of air",
            "1 - visual_volume / collider_volume",
            "This is the share of air. Asked is what remains: a collider without air has 1.",
        ),
        _slip(
            "volume of the air",
            "collider_volume - visual_volume",
            "This is the volume of the air, in cubic metres. A share has no unit.",
        ),
        _slip(
            "air by the body",
            "(collider_volume - visual_volume) / visual_volume",
            "This compares the air with the body. Asked is the body's share of the whole collider.",
        ),
        _slip(
            "of lengths",
            "(visual_volume / collider_volume) ** (1 / 3)",
            "The cube root compares lengths. Asked is the share of the volume.",
        ),
        _slip(
            "whole number",
            "visual_volume // collider_volume",
            "// keeps the whole part only, and of a share below 1 that is 0. One slash divides.",
        ),
        Mistake(
            "float",
            _of_one_number,
            "Right for one body. float() takes one number: leave it out, and arrays are divided as well.",
        ),
    ),  # fmt: skip
    hints=(
        "A share: the part, by the whole.",
        "The part is what the body fills, the whole is the collider.",
        "return ____ / collider_volume",
    ),
)
