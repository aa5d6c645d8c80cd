"""Every formula of the lecture as a student writes it: plain arrays, no checks.

One module a lesson, one function an exercise, with the exercise's own signature. What
an exercise is judged by, what its hint shows at the end and what its solution cell
holds are these lines; the library is measured by them.

A docstring names the slide by its row in the syllabus, and a misprint by its number in
the list there. ``(...)`` is a batch of any shape. A function that ends in "as an
expression" takes and gives SymPy expressions.
"""

from course.formulas.contact_forces import (
    complementarity_residual,
    pivot,
    projected_gauss_seidel,
    slope_1,
    solve_contact_qp,
)
from course.formulas.contact_matrices import (
    contact_matrix,
    contact_matrix_entry,
    ladder_entry,
    point_response,
)
from course.formulas.energy_and_motion import (
    angular_acceleration,
    angular_kinetic_energy,
    linear_kinetic_energy,
    rk4_step,
    rotate,
    sigma,
    symplectic_euler_step,
    world_inertia,
)
from course.formulas.impulse import (
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    p_hat,
    separation_speed,
)
from course.formulas.impulse_and_spin import (
    apply_impulse,
    effective_mass,
    impulse_at_point,
    point_velocity,
    rod_impulse,
    simultaneous_impulses,
)
from course.formulas.separation_acceleration import (
    angular_acceleration_free,
    contact_bias,
    free_point_acceleration,
    top_acceleration,
)
from course.formulas.separations import (
    edge_normal_rate,
    normal_rate,
    separation,
    separation_rate,
    top_rate,
)
from course.formulas.start_here import (
    speed_along,
)
from course.formulas.wall_bounces import (
    bounce_times,
    bouncing_ball_step,
    rest_time,
    wall_bounce,
)

__all__ = [
    "angular_acceleration",
    "angular_acceleration_free",
    "angular_kinetic_energy",
    "apply_impulse",
    "bounce_times",
    "bouncing_ball_step",
    "complementarity_residual",
    "contact_bias",
    "contact_matrix",
    "contact_matrix_entry",
    "edge_normal_rate",
    "effective_mass",
    "free_point_acceleration",
    "impulse_at_point",
    "impulse_central",
    "kinetic_energy_lost",
    "ladder_entry",
    "linear_kinetic_energy",
    "momentum_after",
    "normal_rate",
    "p_hat",
    "pivot",
    "point_response",
    "point_velocity",
    "projected_gauss_seidel",
    "rest_time",
    "rk4_step",
    "rod_impulse",
    "rotate",
    "separation",
    "separation_rate",
    "separation_speed",
    "sigma",
    "simultaneous_impulses",
    "slope_1",
    "solve_contact_qp",
    "speed_along",
    "symplectic_euler_step",
    "top_acceleration",
    "top_rate",
    "wall_bounce",
    "world_inertia",
]
