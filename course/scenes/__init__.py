"""Scenes: bodies with what acts on them, each with its truth and the error of an answer where these are known."""

from course.scenes.balls import (
    POOL_MASS,
    POOL_RADIUS,
    balls_on_domes,
    billiard_rack,
    cannonballs,
    pile,
    rack,
    touching_row,
)
from course.scenes.changes import (
    about_to_part,
    on_a_moving_ground,
    shaken,
    tilted_foot,
    weighed_anew,
    with_duplicates,
    with_redundant_points,
    without_forces,
)
from course.scenes.drawn import random_scene, side_by_side, tangle
from course.scenes.impacts import box_on_corners, falling_rods, rod_on_two_pegs
from course.scenes.masonry import stack, wall
from course.scenes.moving_pairs import (
    FlyingCorners,
    bar_and_plank_outlines,
    bar_over_plank,
    flying_corners,
    moving_contact,
)
from course.scenes.resting_bodies import (
    ladder,
    leaning_rod,
    loaded_plank,
    spinning_between_pins,
    table,
    wedged_ball,
)
from course.scenes.scene import GRAVITY, Scene
from course.scenes.spinning import (
    handle_mass_properties,
    spinning_body,
    spinning_handle,
)

__all__ = [
    "GRAVITY",
    "POOL_MASS",
    "POOL_RADIUS",
    "FlyingCorners",
    "Scene",
    "about_to_part",
    "balls_on_domes",
    "bar_and_plank_outlines",
    "bar_over_plank",
    "billiard_rack",
    "box_on_corners",
    "cannonballs",
    "falling_rods",
    "flying_corners",
    "handle_mass_properties",
    "ladder",
    "leaning_rod",
    "loaded_plank",
    "moving_contact",
    "on_a_moving_ground",
    "pile",
    "rack",
    "random_scene",
    "rod_on_two_pegs",
    "shaken",
    "side_by_side",
    "spinning_between_pins",
    "spinning_body",
    "spinning_handle",
    "stack",
    "table",
    "tangle",
    "tilted_foot",
    "touching_row",
    "wall",
    "wedged_ball",
    "weighed_anew",
    "with_duplicates",
    "with_redundant_points",
    "without_forces",
]
