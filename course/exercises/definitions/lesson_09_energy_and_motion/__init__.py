"""Lesson 09: kinetic energy, the equations of turning, and steps in time."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_09_energy_and_motion.angular_acceleration import (
    ANGULAR_ACCELERATION,
)
from course.exercises.definitions.lesson_09_energy_and_motion.angular_kinetic_energy import (
    ANGULAR_KINETIC_ENERGY,
)
from course.exercises.definitions.lesson_09_energy_and_motion.linear_kinetic_energy import (
    LINEAR_KINETIC_ENERGY,
)
from course.exercises.definitions.lesson_09_energy_and_motion.predictions import (
    PREDICTIONS,
)
from course.exercises.definitions.lesson_09_energy_and_motion.rk4_step import RK4_STEP
from course.exercises.definitions.lesson_09_energy_and_motion.rotate import ROTATE
from course.exercises.definitions.lesson_09_energy_and_motion.sigma import SIGMA
from course.exercises.definitions.lesson_09_energy_and_motion.symplectic_euler_step import (
    SYMPLECTIC_EULER_STEP,
)
from course.exercises.definitions.lesson_09_energy_and_motion.world_inertia import (
    WORLD_INERTIA,
)

LESSON = Lesson(
    number="09",
    name="energy-and-motion",
    title="Energy and motion",
    question="No torque acts on the handle in space: why does it flip, and how soon?",
    minutes=90,
    exercises=(
        SIGMA,
        LINEAR_KINETIC_ENERGY,
        ANGULAR_KINETIC_ENERGY,
        WORLD_INERTIA,
        ANGULAR_ACCELERATION,
        SYMPLECTIC_EULER_STEP,
        ROTATE,
        RK4_STEP,
    ),
    predictions=PREDICTIONS,
)
