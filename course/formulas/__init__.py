"""Every formula of the lecture as a student writes it: plain arrays, no checks.

One module a lesson, named as the lesson is. An exercise's reference is the function of
its name, with its own signature: what it is judged by, what its hint shows at the end
and what its solution cell holds are these lines; the library is measured by them. Asked
by no exercise are ``bounding_box``, which lesson 02 shows, ``point_in_sphere`` (04),
``project`` and ``box_axes`` (05), and ``separation_acceleration``.

lesson_00_start_here (Start here)
    speed_along
lesson_01_contact_and_colliders (Contact and colliders)
    hidden_drop, contact_state, place, tightness
lesson_02_collision_primitives (Collision primitives)
    bounding_box, box_growth, support, rotated_box_extents, k_dop,
    compound_support, bounding_sphere, principal_box
lesson_04_overlap_tests (Overlap tests)
    point_in_sphere, spheres_overlap, boxes_overlap, foot_share,
    closest_point_on_segment, sphere_capsule_gap, capsule_gap, sphere_box_gap
lesson_05_separating_axis (Separating axis)
    project, shadow_gap, edge_normals, polygons_overlap, half_shadow, box_axes,
    oriented_boxes_overlap, least_translation, hulls_overlap
lesson_06_moving_objects (Moving objects)
    meeting_time, swept_spheres_time, swept_boxes_time, miss_probability,
    conservative_advancement
lesson_09_energy_and_motion (Energy and motion)
    sigma, linear_kinetic_energy, angular_kinetic_energy, world_inertia,
    angular_acceleration, symplectic_euler_step, rotate, rk4_step
lesson_10_impulse (Impulse)
    p_hat, momentum_after, separation_speed, impulse_central, kinetic_energy_lost
lesson_11_wall_bounce (The wall bounce)
    rest_time, wall_bounce, bounce_times, bouncing_ball_step
lesson_12_impulse_and_spin (Impulse and spin)
    rod_impulse, point_velocity, effective_mass, impulse_at_point, apply_impulse,
    simultaneous_impulses
lesson_13_separation (Separation)
    top_rate, separation, normal_rate, separation_rate, edge_normal_rate
lesson_14_separation_acceleration (The acceleration of the separation)
    top_acceleration, free_point_acceleration, contact_bias,
    separation_acceleration, angular_acceleration_free
lesson_15_contact_matrix (The contact matrix)
    ladder_entry, point_response, contact_matrix_entry, contact_matrix
lesson_16_contact_forces (Contact forces)
    slope_1, complementarity_residual, solve_contact_qp, projected_gauss_seidel,
    pivot

"syllabus row 17" counts as lessons and misprints do, which is not the slide's number:
``course syllabus`` gives the slide of each row. A misprint has its number in
docs/misprints.md. ``(...)`` is a batch of any shape. A
function that ends in "as an expression" takes and gives SymPy expressions.
"""

from course.formulas.lesson_00_start_here import speed_along
from course.formulas.lesson_01_contact_and_colliders import (
    contact_state,
    hidden_drop,
    place,
    tightness,
)
from course.formulas.lesson_02_collision_primitives import (
    bounding_box,
    bounding_sphere,
    box_growth,
    compound_support,
    k_dop,
    principal_box,
    rotated_box_extents,
    support,
)
from course.formulas.lesson_04_overlap_tests import (
    boxes_overlap,
    capsule_gap,
    closest_point_on_segment,
    foot_share,
    point_in_sphere,
    sphere_box_gap,
    sphere_capsule_gap,
    spheres_overlap,
)
from course.formulas.lesson_05_separating_axis import (
    box_axes,
    edge_normals,
    half_shadow,
    hulls_overlap,
    least_translation,
    oriented_boxes_overlap,
    polygons_overlap,
    project,
    shadow_gap,
)
from course.formulas.lesson_06_moving_objects import (
    conservative_advancement,
    meeting_time,
    miss_probability,
    swept_boxes_time,
    swept_spheres_time,
)
from course.formulas.lesson_09_energy_and_motion import (
    angular_acceleration,
    angular_kinetic_energy,
    linear_kinetic_energy,
    rk4_step,
    rotate,
    sigma,
    symplectic_euler_step,
    world_inertia,
)
from course.formulas.lesson_10_impulse import (
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    p_hat,
    separation_speed,
)
from course.formulas.lesson_11_wall_bounce import (
    bounce_times,
    bouncing_ball_step,
    rest_time,
    wall_bounce,
)
from course.formulas.lesson_12_impulse_and_spin import (
    apply_impulse,
    effective_mass,
    impulse_at_point,
    point_velocity,
    rod_impulse,
    simultaneous_impulses,
)
from course.formulas.lesson_13_separation import (
    edge_normal_rate,
    normal_rate,
    separation,
    separation_rate,
    top_rate,
)
from course.formulas.lesson_14_separation_acceleration import (
    angular_acceleration_free,
    contact_bias,
    free_point_acceleration,
    separation_acceleration,
    top_acceleration,
)
from course.formulas.lesson_15_contact_matrix import (
    contact_matrix,
    contact_matrix_entry,
    ladder_entry,
    point_response,
)
from course.formulas.lesson_16_contact_forces import (
    complementarity_residual,
    pivot,
    projected_gauss_seidel,
    slope_1,
    solve_contact_qp,
)

__all__ = [
    "angular_acceleration",
    "angular_acceleration_free",
    "angular_kinetic_energy",
    "apply_impulse",
    "bounce_times",
    "bouncing_ball_step",
    "bounding_box",
    "bounding_sphere",
    "box_axes",
    "box_growth",
    "boxes_overlap",
    "capsule_gap",
    "closest_point_on_segment",
    "complementarity_residual",
    "compound_support",
    "conservative_advancement",
    "contact_bias",
    "contact_matrix",
    "contact_matrix_entry",
    "contact_state",
    "edge_normal_rate",
    "edge_normals",
    "effective_mass",
    "foot_share",
    "free_point_acceleration",
    "half_shadow",
    "hidden_drop",
    "hulls_overlap",
    "impulse_at_point",
    "impulse_central",
    "k_dop",
    "kinetic_energy_lost",
    "ladder_entry",
    "least_translation",
    "linear_kinetic_energy",
    "meeting_time",
    "miss_probability",
    "momentum_after",
    "normal_rate",
    "oriented_boxes_overlap",
    "p_hat",
    "pivot",
    "place",
    "point_in_sphere",
    "point_response",
    "point_velocity",
    "polygons_overlap",
    "principal_box",
    "project",
    "projected_gauss_seidel",
    "rest_time",
    "rk4_step",
    "rod_impulse",
    "rotate",
    "rotated_box_extents",
    "separation",
    "separation_acceleration",
    "separation_rate",
    "separation_speed",
    "shadow_gap",
    "sigma",
    "simultaneous_impulses",
    "slope_1",
    "solve_contact_qp",
    "speed_along",
    "sphere_box_gap",
    "sphere_capsule_gap",
    "spheres_overlap",
    "support",
    "swept_boxes_time",
    "swept_spheres_time",
    "symplectic_euler_step",
    "tightness",
    "top_acceleration",
    "top_rate",
    "wall_bounce",
    "world_inertia",
]
