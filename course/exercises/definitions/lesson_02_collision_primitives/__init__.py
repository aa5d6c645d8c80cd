"""Lesson 02: the seven kinds of collider and how they are fitted, and its second notebook."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_02_collision_primitives.bounding_sphere import (
    BOUNDING_SPHERE,
)
from course.exercises.definitions.lesson_02_collision_primitives.box_growth import (
    BOX_GROWTH,
)
from course.exercises.definitions.lesson_02_collision_primitives.compound_support import (
    COMPOUND_SUPPORT,
)
from course.exercises.definitions.lesson_02_collision_primitives.k_dop import K_DOP
from course.exercises.definitions.lesson_02_collision_primitives.predictions import (
    DEEPER_PREDICTIONS,
    PREDICTIONS,
)
from course.exercises.definitions.lesson_02_collision_primitives.principal_box import (
    PRINCIPAL_BOX,
)
from course.exercises.definitions.lesson_02_collision_primitives.rotated_box_extents import (
    ROTATED_BOX_EXTENTS,
)
from course.exercises.definitions.lesson_02_collision_primitives.support import SUPPORT

LESSON = Lesson(
    number="02",
    name="collision-primitives",
    title="Collision primitives",
    question="Turn a rod, 1 m by 1 cm, by 45 degrees: why does its AABB grow 51-fold?",
    minutes=75,
    exercises=(BOX_GROWTH, SUPPORT, ROTATED_BOX_EXTENTS, K_DOP, COMPOUND_SUPPORT),
    predictions=PREDICTIONS,
)

MORE = Lesson(
    number="02-more",
    name="collision-primitives",
    title="Collision primitives, deeper",
    question="How near do quick fits come to the least sphere and the least box?",
    minutes=49,
    exercises=(BOUNDING_SPHERE, PRINCIPAL_BOX),
    predictions=DEEPER_PREDICTIONS,
)
