"""Lesson 00: how the workbook works, and arrays with a batch in front."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import (
    Case,
    Exercise,
    Lesson,
    Mistake,
    Prediction,
    Value,
)
from course.exercises.slips import slip


def _vectors(rng: np.random.Generator) -> Sequence[Case]:
    def draw(*shape: int) -> dict[str, Any]:
        normal = rng.normal(size=(*shape, 3))
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        return {"velocity": rng.normal(size=(*shape, 3)).round(3), "normal": normal}

    floor = {
        "velocity": np.array([1.0, 2.0, -3.0]),
        "normal": np.array([0.0, 0.0, 1.0]),
    }
    return [
        Case("a box that falls and slides", floor),
        Case("a slanted floor", draw()),
        Case("four boxes", draw(4), "batch"),
        Case("three boxes, as many as a vector has components", draw(3), "batch"),
        Case("a 2 by 5 batch", draw(2, 5), "batch"),
        Case(
            "four boxes on one floor",
            {**draw(4), "normal": np.array([0.0, 0.6, 0.8])},
            "batch",
        ),
        Case(
            "sliding along the floor",
            {**floor, "velocity": np.array([1.0, 2.0, 0.0])},
            "edge",
        ),
    ]


SPEED_ALONG = Exercise(
    name="speed_along",
    rows=(19,),
    points=1,
    minutes=6,
    task="Return v.n, the speed along the normal: one number for each velocity of the batch.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "velocities"),
        Value("normal", "(..., 3)", "", "unit vectors out of the floor"),
    ),
    results=(
        Value("speed_along", "(...)", "m/s", "v.n: above 0 leaving, below 0 coming"),
    ),
    reference=formulas.speed_along,
    cases=_vectors,
    mistakes=(
        Mistake(
            "no axis",
            slip(formulas.speed_along, ", axis=-1", ""),
            "Your sum goes over the whole batch: one number for all boxes together. Take it over the last "
            "axis only, axis=-1.",
        ),
        Mistake(
            "first axis",
            slip(formulas.speed_along, "axis=-1", "axis=0"),
            "axis=0 adds over the batch. The components of a vector lie on the last axis: axis=-1.",
        ),
        Mistake(
            "not summed",
            slip(
                formulas.speed_along,
                "np.sum(velocity * normal, axis=-1)",
                "velocity * normal",
            ),
            "These are the three products, component by component. A dot product is their sum, over the last axis.",
        ),
        Mistake(
            "length",
            slip(
                formulas.speed_along,
                "np.sum(velocity * normal, axis=-1)",
                "np.linalg.norm(velocity, axis=-1)",
            ),
            "This is the whole speed |v|. What is asked for is the part of it along the normal, which has a sign.",
        ),
        Mistake(
            "sign",
            slip(formulas.speed_along, "np.sum", "-np.sum"),
            "The sign is reversed: a box that falls onto the floor has v.n below 0, because n points out of the "
            "floor.",
        ),
    ),
    hints=(
        "Multiply the two arrays component by component, then add the products of each vector.",
        "np.sum takes the axis to sum over. Vectors lie on the last one, whatever stands before it.",
        "return np.sum(velocity * ____, axis=____)",
    ),
)


def _depth_after_a_second() -> float:
    gravity, steps = 9.81, 60
    speed = depth = 0.0
    for _ in range(steps):
        speed += gravity / steps
        depth += speed / steps
    return depth


LESSON = Lesson(
    number="00",
    name="start-here",
    title="Start here",
    question="Three boxes land on a floor: what must a program ask to keep them there?",
    minutes=30,
    exercises=(SPEED_ALONG,),
    predictions=(
        Prediction(
            "unasked",
            "A box stands on a floor. A program moves it 60 times a second: first gravity changes its velocity, then "
            "the velocity its height. Nobody asks about the floor. How deep is the box after one second?",
            _depth_after_a_second,
            "Nothing in gravity knows of a floor. Every step the box gains 0.16 m/s, and it keeps all of it.",
            unit="m",
            tolerance=0.1,
            wrong={
                0.16: "0.16 m/s is what one step adds to the speed; the speeds add up.",
                9.81: "That is its speed, in m/s.",
            },
        ),
    ),
)  # fmt: skip
