"""The exercise ``bouncing_ball_step``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip


def _states(rng: np.random.Generator) -> Sequence[Case]:
    def state(
        height: Any,
        velocity: Any,
        step: float = 0.01,
        restitution: float = 0.7,
        gravity: float = 9.81,
    ) -> dict[str, Any]:
        return {
            "height": height,
            "velocity": velocity,
            "step": step,
            "restitution": restitution,
            "gravity": gravity,
        }

    drawn = [rng.uniform(-most, most, (2, 3)).round(3) for most in (0.1, 3.0)]
    heights = np.array([0.5, -0.02, -0.01, 0.0, 0.3, -0.03])
    return [
        Case("in the air, falling", state(0.5, -1.0)),
        Case("below the floor, falling", state(-0.02, -3.0)),
        Case(
            "in the air, rising",
            state(round(rng.uniform(0.2, 1), 3), round(rng.uniform(1, 2), 3)),
        ),
        Case(
            "below the floor, falling, another step",
            state(-0.05, round(rng.uniform(-4, -2), 3), 0.04, 0.4),
        ),
        Case("below the floor, already rising", state(-0.02, 2.0), "edge"),
        Case("exactly on the floor, falling", state(0.0, -2.0), "edge"),
        Case("nothing lost", state(-0.02, -3.0, 0.01, 1.0), "edge"),
        Case(
            "six balls",
            state(heights, np.array([-1.0, -2.0, 1.5, -0.5, 2.0, -4.0])),
            "batch",
        ),
        Case("a 2 by 3 batch", state(drawn[0], drawn[1]), "batch"),
        Case(
            "on another planet, falling",
            state(0.4, -0.8, gravity=round(rng.uniform(1.5, 5), 2)),
        ),
        Case("below the floor, falling slowly", state(-0.02, -0.2), "edge"),
        Case("below the floor, rising slowly", state(-0.02, 0.2), "edge"),
        Case("below the floor, at rest", state(-0.02, 0.0), "edge"),
    ]


BOUNCING_BALL_STEP = Exercise(
    name="bouncing_ball_step",
    rows=(18,),
    points=3,
    minutes=10,
    task="Reflect a ball that is below the floor and falling, else let gravity act; then move with the new velocity.",
    arguments=(
        Value("height", "(...)", "m", "of the ball's lowest point; below 0 it is in the floor"),
        Value("velocity", "(...)", "m/s", "upward"),
        Value("step", "scalar", "s", "length of the step"),
        Value("restitution", "scalar", "", "e, from 0 to 1"),
        Value("gravity", "scalar", "m/s²", "g, positive"),
    ),
    results=(Value("height", "(...)", "m"), Value("velocity", "(...)", "m/s")),
    reference=formulas.bouncing_ball_step,
    cases=_states,
    mistakes=(
        Mistake(
            "gravity first",
            slip(
                formulas.bouncing_ball_step,
                "hits =",
                "velocity = velocity - gravity * step\n    hits =",
                ", velocity - gravity * step)",
                ", velocity)",
            ),
            "Gravity acts before you reflect. This is the other engine's order, the one with the larger error: ask "
            "about the wall first, and let gravity act only where nothing hit.",
        ),
        Mistake(
            "gravity as well",
            slip(
                formulas.bouncing_ball_step,
                "np.where(hits, -restitution * velocity, velocity - gravity * step)",
                "np.where(hits, -restitution * velocity, velocity) - gravity * step",
            ),
            "After reflecting you let gravity act too. In this order a step either reflects or falls.",
        ),
        Mistake(
            "moved with the old velocity",
            slip(formulas.bouncing_ball_step, "step * after", "step * velocity"),
            "You move with the velocity from before. Change the velocity first, then move with the new one.",
        ),
        Mistake(
            "reflects a rising ball",
            slip(formulas.bouncing_ball_step, " & (velocity < 0)", ""),
            "You reflect every ball below the floor. One that already rises is sent down again and sticks in the "
            "floor: ask for velocity < 0 as well.",
        ),
        Mistake(
            "no restitution",
            slip(formulas.bouncing_ball_step, "-restitution * velocity", "-velocity"),
            "Your ball leaves as fast as it came: multiply by e when it is reflected.",
        ),
        Mistake(
            "gravity upward",
            slip(
                formulas.bouncing_ball_step, "velocity - gravity", "velocity + gravity"
            ),
            "Gravity pulls your ball up. The velocity counts upward, so it loses g times the step.",
        ),
        Mistake(
            "not turned round",
            slip(formulas.bouncing_ball_step, "-restitution", "restitution"),
            "Your ball slows down at the floor and goes on into it: the new velocity is *minus* e times the old one.",
        ),
        Mistake(
            "velocity first",
            slip(
                formulas.bouncing_ball_step,
                "height + step * after, after",
                "after, height + step * after",
            ),
            "The two results have changed places: return the height, then the velocity.",
        ),
        Mistake(
            "height clamped",
            slip(
                formulas.bouncing_ball_step,
                "height + step * after",
                "np.maximum(height + step * after, 0.0)",
            ),
            "You lift the ball to the floor. That gives it energy for nothing; in this step the height is only moved "
            "by step * velocity.",
        ),
        Mistake(
            "touching counts as below",
            slip(formulas.bouncing_ball_step, "height < 0", "height <= 0"),
            "A ball exactly at height 0 is not below the floor: reflect where height < 0.",
        ),
    ),
    hints=(
        "Three things happen in this order: ask whether it hits, change the velocity, move. np.where chooses which "
        "change.",
        "It hits where height < 0 and velocity < 0, both. There the velocity becomes -e times itself, elsewhere it "
        "loses g times the step. The height then gains step times the new velocity.",
        "hits = (height < 0) & (____ < 0)\n"
        "after = np.where(hits, ____, velocity - gravity * step)\n"
        "return height + step * ____, after",
    ),
)  # fmt: skip
