"""The exercise ``kinetic_energy_lost``: inputs, comparison and planted mistakes."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_10_impulse.shared import (
    MASS_1,
    MASS_2,
    NORMAL,
    RESTITUTION,
    VELOCITY_1,
    VELOCITY_2,
    impacts,
)
from course.exercises.slips import slip

KINETIC_ENERGY_LOST = Exercise(
    name="kinetic_energy_lost",
    rows=(15, 17),
    points=2,
    minutes=8,
    task="Return T_lost, the kinetic energy that the impact takes away; 0 for bodies that do not approach.",
    arguments=(MASS_1, MASS_2, VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("T_lost", "(...)", "J", "kinetic energy lost, never below 0"),),
    reference=formulas.kinetic_energy_lost,
    cases=impacts,
    properties=(
        Property(
            "never gained",
            lambda given, answer: np.minimum(answer, 0.0),
            "A negative loss is energy from nowhere.",
        ),
    ),
    mistakes=(
        Mistake(
            "1 - e",
            slip(formulas.kinetic_energy_lost, "restitution**2", "restitution"),
            "The factor is 1 - e where it must be 1 - e^2: energy goes with the square of the speed, and e^2 of the "
            "energy of approach comes back.",
        ),
        Mistake(
            "(1 - e)^2",
            slip(
                formulas.kinetic_energy_lost,
                "(1 - restitution**2)",
                "(1 - restitution) ** 2",
            ),
            "(1 - e)^2 is not 1 - e^2. Before the impact the energy of approach is mu u^2/2, after it mu (e u)^2/2: "
            "subtract.",
        ),
        Mistake(
            "what remains",
            slip(
                formulas.kinetic_energy_lost, "(1 - restitution**2)", "restitution**2"
            ),
            "This is the energy of approach that comes back, e^2 of it. Lost is the rest, 1 - e^2.",
        ),
        Mistake(
            "speed not squared",
            slip(formulas.kinetic_energy_lost, "closing**2", "closing"),
            "The speed is not squared: your unit is kg m/s, not J.",
        ),
        Mistake(
            "mass of body 1",
            slip(
                formulas.kinetic_energy_lost, "1 / (1 / mass_1 + 1 / mass_2)", "mass_1"
            ),
            "You use the mass of body 1 alone. It is the reduced mass that goes with the speed of approach.",
        ),
        Mistake(
            "half forgotten",
            slip(formulas.kinetic_energy_lost, "0.5 * ", ""),
            "Twice too much: the half of m v^2/2 is missing.",
        ),
        Mistake(
            "sum of masses",
            slip(
                formulas.kinetic_energy_lost,
                "1 / (1 / mass_1 + 1 / mass_2)",
                "mass_1 + mass_2",
            ),
            "You use m1 + m2. The energy of approach belongs to the reduced mass, 1/(1/m1 + 1/m2); with m1 + m2 you "
            "could lose more than there is.",
        ),
        Mistake(
            "reduced mass upside down",
            slip(
                formulas.kinetic_energy_lost,
                "1 / (1 / mass_1 + 1 / mass_2)",
                "1 / mass_1 + 1 / mass_2",
            ),
            "Your mass is 1/m1 + 1/m2, in 1/kg. The reduced mass is one over that.",
        ),
        Mistake(
            "reduced mass as a fraction",
            slip(
                formulas.kinetic_energy_lost,
                "1 / (1 / mass_1 + 1 / mass_2)",
                "mass_1 * mass_2 / (mass_1 + mass_2)",
            ),
            "Right for two bodies, NaN for a wall. Infinity over infinity, as in m1 m2/(m1 + m2), or infinity times 0 "
            "has no value; 1/(1/m1 + 1/m2) does, because 1/infinity is 0.",
        ),
        Mistake(
            "guard the wrong way round",
            slip(formulas.kinetic_energy_lost, "closing > 0", "closing < 0"),
            "Pairs that part lose energy in your answer, and those that approach none. They approach where "
            "(v1 - v2).n < 0.",
        ),
        Mistake(
            "whole speed",
            slip(
                formulas.kinetic_energy_lost,
                "closing**2",
                "np.linalg.norm(velocity_2 - velocity_1, axis=-1) ** 2",
            ),
            "You use the whole relative speed. Without friction sliding keeps its energy: only motion along n can "
            "lose any.",
        ),
        Mistake(
            "no guard",
            slip(
                formulas.kinetic_energy_lost, "np.where(closing > 0, lost, 0.0)", "lost"
            ),
            "Bodies that already part lose nothing: there is no impact. Return 0 where (v2 - v1).n <= 0.",
        ),
    ),
    hints=(
        "Compare the energy of the relative motion along n before and after: its speed is the "
        "closing speed before and e times that after.",
        "The mass that goes with the relative speed is the reduced mass, one over the sum of the inverse masses. "
        "Half of it times what the square of that speed loses is lost.",
        "closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)\n"
        "mu = 1 / (1 / mass_1 + 1 / mass_2)\n"
        "lost = 0.5 * mu * (1 - ____) * ____**2\n"
        "return np.where(closing > 0, lost, 0.0)",
    ),
)
