"""The exercise ``separation_speed``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_10_impulse.shared import (
    NORMAL,
    RESTITUTION,
    VELOCITY_1,
    VELOCITY_2,
    impacts,
)
from course.exercises.slips import slip


def _only(names: Sequence[str], cases: Sequence[Case]) -> list[Case]:
    return [
        Case(c.label, {name: c.arguments[name] for name in names}, c.kind)
        for c in cases
    ]


SEPARATION_SPEED = Exercise(
    name="separation_speed",
    rows=(17,),
    points=1,
    minutes=7,
    task="Return (v1' - v2').n after the impact: e times the closing speed; bodies that part keep their speed.",
    arguments=(VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(
        Value("separation_speed", "(...)", "m/s", "(v1' - v2').n, never below 0"),
    ),
    reference=formulas.separation_speed,
    cases=lambda rng: _only(
        ("velocity_1", "velocity_2", "normal", "restitution"), impacts(rng)
    ),
    mistakes=(
        Mistake(
            "as printed",
            slip(formulas.separation_speed, "-restitution", "restitution"),
            "The sign is the one the slide prints: after the impact your bodies still approach. Before it "
            "(v1 - v2).n is negative; after it, it must be positive: -e (v1 - v2).n.",
        ),
        Mistake(
            "restitution left out",
            slip(formulas.separation_speed, "-restitution * u", "-u"),
            "They leave as fast as they came, whatever e is. Multiply the closing speed by e.",
        ),
        Mistake(
            "v2 - v1",
            slip(
                formulas.separation_speed,
                "velocity_1 - velocity_2",
                "velocity_2 - velocity_1",
            ),
            "It gives what u = (v2 - v1).n would give. That is positive while they approach, and u < 0 would pick the "
            "pairs that part: it takes (v1 - v2).n.",
        ),
        Mistake(
            "guard the wrong way round",
            slip(formulas.separation_speed, "u < 0", "u > 0"),
            "Pairs that part are turned back in your answer, and those that approach go on as they are. They approach "
            "where (v1 - v2).n < 0.",
        ),
        Mistake(
            "0 for those that part",
            slip(
                formulas.separation_speed,
                "np.where(u < 0, -restitution * u, u)",
                "np.maximum(-restitution * u, 0.0)",
            ),
            "Right while they approach. Bodies that part have no *impulse*, but they do have a separation speed: the "
            "one they came with.",
        ),
        Mistake(
            "the size for all",
            slip(
                formulas.separation_speed,
                "np.where(u < 0, -restitution * u, u)",
                "np.abs(restitution * u)",
            ),
            "Right while they approach. With the absolute value you slow down bodies that part by themselves: nothing "
            "happens to them, return u.",
        ),
        Mistake(
            "1 + e",
            slip(formulas.separation_speed, "-restitution", "-(1 + restitution)"),
            "1 + e is how much the relative speed *changes*. What is left after the impact is e times the closing "
            "speed.",
        ),
        Mistake(
            "squared",
            slip(formulas.separation_speed, "-restitution", "-(restitution**2)"),
            "e^2 is what remains of the energy of approach; of the speed, e remains.",
        ),
        Mistake(
            "whole speed",
            slip(
                formulas.separation_speed,
                "-restitution * u",
                "restitution * np.linalg.norm(velocity_1 - velocity_2, axis=-1)",
            ),
            "You take the length of the whole relative velocity. Only its part along the normal changes; sliding "
            "across it goes on: take the dot product with n.",
        ),
        Mistake(
            "no guard",
            slip(
                formulas.separation_speed,
                "np.where(u < 0, -restitution * u, u)",
                "-restitution * u",
            ),
            "Right for bodies that approach; those that part you send into each other. Where (v1 - v2).n >= 0 nothing "
            "happens: return it as it is (np.where).",
        ),
    ),  # fmt: skip
    hints=(
        "Restitution speaks of one number only: the relative velocity along the normal, u = (v1 - v2).n.",
        "While u is negative they approach, and afterwards it is -e times what it was. Where u is not negative, it "
        "stays. np.where chooses element by element.",
        "u = np.sum((velocity_1 - velocity_2) * normal, axis=____)\nreturn np.where(u < 0, ____ * u, u)",
    ),
)
