"""The exercise ``wall_bounce``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip


def _hits(
    rng: np.random.Generator,
    shape: tuple[int, ...] = (),
    speed: Any = None,
    **fixed: Any,
) -> dict[str, Any]:
    """Velocities that come in at ``speed`` along the normal and slide across it as
    well.
    """
    normal = unit_vector(rng, shape)
    speed = rng.uniform(0.5, 3.0, shape) if speed is None else np.asarray(speed)
    velocity = np.round(
        -speed[..., None] * normal + np.cross(normal, rng.normal(size=(*shape, 3))), 3
    )
    e = np.round(rng.uniform(0.3, 0.8, shape), 3)
    return {
        "velocity": velocity,
        "normal": normal,
        "restitution": e if shape else float(e),
        **fixed,
    }


RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")


def _bounces(rng: np.random.Generator) -> Sequence[Case]:
    floor = {
        "velocity": np.array([1.0, 0.0, -2.0]),
        "normal": np.array([0.0, 0.0, 1.0]),
        "restitution": 0.5,
    }
    return [
        Case("a floor", floor),
        Case("a slanted wall", _hits(rng)),
        Case("the ball already leaves", _hits(rng, speed=-1.2), "edge"),
        Case("the ball slides along the wall", {"velocity": np.array([1.0, 2.0, 0.0]),
             "normal": np.array([0.0, 0.0, 1.0]), "restitution": 0.5}, "edge"),
        Case("nothing lost, e = 1", _hits(rng, restitution=1.0), "edge"),
        Case("it sticks, e = 0", _hits(rng, restitution=0.0), "edge"),
        Case("three balls, as many as a vector has components", _hits(rng, (3,)), "batch"),
        Case("five balls", _hits(rng, (5,)), "batch"),
        Case("a 2 by 4 batch, one restitution for all", _hits(rng, (2, 4), restitution=0.4), "batch"),
        Case("some come, some go", _hits(rng, (4,), speed=[1.0, -1.0, 2.0, -0.5]), "batch"),
        Case("the ball comes in slowly", _hits(rng, speed=0.1)),
        Case("the ball leaves slowly", _hits(rng, speed=-0.1), "edge"),
    ]  # fmt: skip


WALL_BOUNCE = Exercise(
    name="wall_bounce",
    rows=(18,),
    points=2,
    minutes=9,
    task="Return v' = v - (1 + e) (v.n) n for a ball that comes in, v itself for one that does not.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "velocity before"),
        Value("normal", "(..., 3)", "", "unit vector out of the wall"),
        RESTITUTION,
    ),
    results=(Value("velocity", "(..., 3)", "m/s", "velocity after"),),
    reference=formulas.wall_bounce,
    cases=_bounces,
    properties=(
        Property(
            "no gain",
            lambda given, v: np.maximum(
                np.sum(np.square(v), -1) - np.sum(np.square(given["velocity"]), -1), 0.0
            ),
            "The ball leaves faster than it came: a wall that stands still gives no energy.",
        ),
        Property(
            "sliding kept",
            lambda given, v: np.cross(v - given["velocity"], given["normal"]),
            "The part of the velocity along the wall changes. Without friction nothing pushes in that direction.",
        ),
    ),
    mistakes=(
        Mistake(
            "always 2",
            slip(formulas.wall_bounce, "(1 + np.asarray(restitution)[..., None])", "2"),
            "The factor is 2, as on the slide. That is right for e = 1 only; in general it is 1 + e.",
        ),
        Mistake(
            "the slide's line",
            slip(
                formulas.wall_bounce,
                "(1 + np.asarray(restitution)[..., None])",
                "2",
                "np.where(along < 0, after, velocity)",
                "after",
            ),
            "This is the slide's line as it stands: e = 1, and a ball that comes in. In general the factor is 1 + e, "
            "and a ball that already leaves keeps its velocity.",
        ),
        Mistake(
            "the size of v.n",
            slip(
                formulas.wall_bounce,
                "velocity - (1",
                "velocity + (1",
                "* along *",
                "* np.abs(along) *",
                "np.where(along < 0, after, velocity)",
                "after",
            ),
            "Right for balls that come in. With the absolute value you push a ball that already leaves, and it gains "
            "speed: where v.n >= 0 return v as it is.",
        ),
        Mistake(
            "only the part along n",
            slip(
                formulas.wall_bounce,
                "velocity - (1 + np.asarray(restitution)[..., None])",
                "-np.asarray(restitution)[..., None]",
            ),
            "You return the part along n alone. The part along the wall is not touched and belongs to the answer too.",
        ),
        Mistake(
            "only e",
            slip(
                formulas.wall_bounce,
                "(1 + np.asarray(restitution)[..., None])",
                "np.asarray(restitution)[..., None]",
            ),
            "The factor is e where it must be 1 + e: your ball goes on into the wall, only slower.",
        ),
        Mistake(
            "1 - e",
            slip(formulas.wall_bounce, "(1 + np", "(1 - np"),
            "The factor is 1 - e. The 1 stops the ball at the wall, and e more sends it back: 1 + e.",
        ),
        Mistake(
            "plus",
            slip(formulas.wall_bounce, "velocity - (1", "velocity + (1"),
            "The sign is reversed: v.n is negative for a ball that comes in, so subtract (1 + e) (v.n) n.",
        ),
        Mistake(
            "no guard",
            slip(formulas.wall_bounce, "np.where(along < 0, after, velocity)", "after"),
            "Right for balls that come in. One that already leaves you throw back into the wall: where v.n >= 0 "
            "return v as it is.",
        ),
        Mistake(
            "the test turned round",
            slip(formulas.wall_bounce, "along < 0", "along > 0"),
            "You change the balls that leave and let those through that come in: v.n < 0 means that a ball comes in.",
        ),
        Mistake(
            "whole velocity",
            slip(
                formulas.wall_bounce,
                "velocity - (1 + np.asarray(restitution)[..., None]) * along * normal",
                "-np.asarray(restitution)[..., None] * velocity",
            ),
            "You reverse the whole velocity. Only the part along n meets the wall; the part along the wall stays.",
        ),
        Mistake(
            "friction by the way",
            slip(
                formulas.wall_bounce,
                "velocity - (1 + np.asarray(restitution)[..., None]) * along * normal",
                "np.asarray(restitution)[..., None] * (velocity - 2 * along * normal)",
            ),
            "You multiply the whole reflected velocity by e. e acts on the part along n; sliding is not slowed.",
        ),
        Mistake(
            "one batch axis short",
            slip(
                formulas.wall_bounce,
                "axis=-1)[..., None]",
                "axis=-1)",
                "np.asarray(restitution)[..., None]",
                "restitution",
            ),
            "Right for one ball, not for a batch: v.n has shape (...) and n has (..., 3). Give the numbers one more "
            "axis, (v.n)[..., None], restitution too if it is an array.",
        ),
    ),
    hints=(
        "Split v into the part along n and the rest. Only the first part changes, and only if it points into the wall.",
        "The speed along n goes from v.n to -e times v.n: subtract (1 + e) times v.n, along n. Where v.n is not "
        "negative keep v.",
        "along = np.sum(velocity * normal, axis=-1)[..., None]\n"
        "after = velocity - (1 + np.asarray(restitution)[..., None]) * ____ * normal\n"
        "return np.where(along < 0, after, ____)",
    ),
)
