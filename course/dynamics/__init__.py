"""Bodies that move, from plain arrays: state, impulses, bounces (syllabus rows 14-18)."""

from course.dynamics.bodies import Bodies
from course.dynamics.bounces import bounce_path_length, bounce_rest_time, bounce_times, wall_bounce
from course.dynamics.impulse import (
    apply_impulse,
    effective_mass,
    impulse_at_point,
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    normal_velocity,
    point_velocity,
    separation_speed,
    velocity_after,
)

__all__ = [
    "Bodies",
    "apply_impulse",
    "bounce_path_length",
    "bounce_rest_time",
    "bounce_times",
    "effective_mass",
    "impulse_at_point",
    "impulse_central",
    "kinetic_energy_lost",
    "momentum_after",
    "normal_velocity",
    "point_velocity",
    "separation_speed",
    "velocity_after",
    "wall_bounce",
]
