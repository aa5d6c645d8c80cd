"""The exercise ``ladder_entry``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

# ladder_entry, the student's step of the derivation: what a force at the top does to
# the gap at the foot.


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "mass": np.round(rng.uniform(5.0, 20.0, 8), 1),
        "theta": np.round(rng.uniform(0.3, 0.7, 8), 2),
        "ell": np.round(rng.uniform(2.0, 5.0, 8), 2),
    }
    return [
        Case("one ladder", {"mass": 10.0, "theta": 0.5, "ell": 4.0}),
        Case("eight ladders", draws, "batch"),
    ]


LADDER_ENTRY = Exercise(
    name="ladder_entry",
    kind="expression",
    rows=(21, 24),
    points=2,
    minutes=8,
    task="Give a_12 of the ladder, what a unit of force at its top adds to d_ddot at its foot, in mass, theta and ell.",
    arguments=(
        Value("mass", "scalar", "kg", "of the ladder; I = mass ell^2 / 12"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(Value("ladder_entry", "(...)", "1/kg", "a_12"),),
    reference=formulas.ladder_entry,
    cases=_ladders,
    mistakes=(
        Mistake("sign", slip(formulas.ladder_entry, "-3", "3"),
                "The sign is reversed. The top is pushed to the left: which way does "
                "the ladder begin to turn, and where does that take the foot?"),
        Mistake("zero", slip(formulas.ladder_entry, "-3", "0"),
                "You say that the foot feels nothing. N_1.N_2 = 0 is true of the pushes "
                "themselves, but the push at the top also turns the ladder."),
        Mistake("with 1/m", slip(formulas.ladder_entry, "/ mass", "/ mass + 1 / mass"),
                "You add 1/m. The push at the top is horizontal: the centre is "
                "accelerated to the left, which does not move the foot up or down."),
        Mistake("whole arms", slip(formulas.ladder_entry, "-3", "-12"),
                "Too large by 4: both arms are half the ladder, not the whole."),
        Mistake("moment about the end", slip(formulas.ladder_entry, "-3", "-3 / 4"),
                "Too small by 4: m l^2/3 is the moment about an end. "
                "Torques are taken about the centre here, where it is m l^2/12."),
        Mistake("two cosines", slip(formulas.ladder_entry, "sp.sin", "sp.cos"),
                "You have cosine squared. That is the foot's own arm twice: at the "
                "top the part of the arm that lies across N_2 counts, which is the sine."),
        Mistake("two sines", slip(formulas.ladder_entry, "sp.cos", "sp.sin"),
                "You have sine squared. That is the top's own arm twice: at the foot "
                "the part of the arm that lies across N_1 counts, which is the cosine."),
        Mistake("half as large", slip(formulas.ladder_entry, "-3", "-3 / 2"),
                "Too small by 2. Both arms are ell/2, and 12/4 is 3."),
        Mistake("mass forgotten", slip(formulas.ladder_entry, " / mass", ""),
                "The mass is missing: it stands in I = m l^2/12."),
        Mistake("one arm left out", slip(formulas.ladder_entry, "-3", "-6", "/ mass", "/ (mass * ell)"),
                "A length is left over, as if one of the "
                "two arms were missing: the torque brings one, the way from the turn to the foot the other."),
        Mistake("the 12 forgotten", slip(formulas.ladder_entry, "-3", "-1 / 4"),
                "Too small by 12: the moment of a rod about its centre is "
                "m l^2/12."),
        Mistake("directions for arms",
                slip(formulas.ladder_entry, "-3", "-12", "/ mass", "/ (mass * ell**2)"),
                "Your arms have length 1. Each is half the "
                "ladder long, and then the length cancels."),
        Mistake("inertia for its inverse",
                slip(formulas.ladder_entry, "-3", "-(ell**2) / 4", "/ mass", "* mass * ell**2 / 12"),
                "You multiply by the inertia. The angular acceleration is "
                "torque divided by I."),
    ),
    hints=(
        "Start from a_11 in the text and change what is pushed: the push is N_2 at the top, the answer that of the "
        "foot along N_1.",
        "w = y N_z - z N_y is the lever of a contact at (y, z) from the centre: a_12 = N_1.N_2/m + w_1 w_2/I, "
        "w_1 = -(ell/2) cos(theta). Find w_2 the same way.",
        "w_1, w_2 = -ell / 2 * sp.cos(theta), ____\nladder_entry = w_1 * w_2 / (mass * ell**2 / ____)",
    ),
)  # fmt: skip
