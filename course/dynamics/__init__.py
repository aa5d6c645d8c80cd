"""Bodies that move, from plain arrays: state, impulses, steps, closed forms (syllabus rows 14-18)."""

from course.dynamics.ball_flight import BallEvents, BallMotion, ball_events, ball_motion
from course.dynamics.block_collisions import (
    TwoBlocks,
    count_collisions,
    critical_mass_ratio,
    pi_count,
    predicted_count,
    two_blocks,
)
from course.dynamics.bodies import Bodies
from course.dynamics.bounces import (
    bounce_path_length,
    bounce_rest_time,
    bounce_times,
    wall_bounce,
)
from course.dynamics.central_impulses import (
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    separation_speed,
    velocity_after,
)
from course.dynamics.closed_form_motions import parabola, pendulum, symmetric_top
from course.dynamics.domes import Dome, DomeBias, DomePaths
from course.dynamics.dropped_boxes import FallingBoxes, falling_boxes
from course.dynamics.energy import (
    angular_kinetic_energy,
    kinetic_energy,
    linear_kinetic_energy,
    potential_energy,
    total_angular_momentum,
    total_energy,
    total_momentum,
)
from course.dynamics.faulty_integrators import body_frame_euler, quaternion_euler
from course.dynamics.homogeneous_solids import (
    box_mass_properties,
    capsule_mass_properties,
    hull_mass_properties,
    sphere_mass_properties,
)
from course.dynamics.impulses_at_points import (
    apply_impulse,
    effective_mass,
    impulse_at_point,
    normal_velocity,
    point_velocity,
)
from course.dynamics.integrators import (
    Wrench,
    advance,
    dop853,
    explicit_euler,
    midpoint,
    reference_motion,
    rk4,
    splitting,
    symplectic_euler,
    uniform_gravity,
)
from course.dynamics.ladders import (
    ladder_gaps,
    ladder_leaving_angle,
    sliding_ladder_forces,
    standing_ladder_forces,
)
from course.dynamics.mass_properties import (
    MassProperties,
    combined_mass_properties,
    principal_axes,
)
from course.dynamics.torque_free_top import (
    middle_axis_growth_rate,
    torque_free_motion,
    torque_free_rotation,
)
from course.dynamics.tumbles import (
    BodyView,
    EnergyLines,
    Tumble,
    free_tumble,
    orientation_error,
)

__all__ = [
    "BallEvents",
    "BallMotion",
    "Bodies",
    "BodyView",
    "Dome",
    "DomeBias",
    "DomePaths",
    "EnergyLines",
    "FallingBoxes",
    "MassProperties",
    "Tumble",
    "TwoBlocks",
    "Wrench",
    "advance",
    "angular_kinetic_energy",
    "apply_impulse",
    "ball_events",
    "ball_motion",
    "body_frame_euler",
    "bounce_path_length",
    "bounce_rest_time",
    "bounce_times",
    "box_mass_properties",
    "capsule_mass_properties",
    "combined_mass_properties",
    "count_collisions",
    "critical_mass_ratio",
    "dop853",
    "effective_mass",
    "explicit_euler",
    "falling_boxes",
    "free_tumble",
    "hull_mass_properties",
    "impulse_at_point",
    "impulse_central",
    "kinetic_energy",
    "kinetic_energy_lost",
    "ladder_gaps",
    "ladder_leaving_angle",
    "linear_kinetic_energy",
    "middle_axis_growth_rate",
    "midpoint",
    "momentum_after",
    "normal_velocity",
    "orientation_error",
    "parabola",
    "pendulum",
    "pi_count",
    "point_velocity",
    "potential_energy",
    "predicted_count",
    "principal_axes",
    "quaternion_euler",
    "reference_motion",
    "rk4",
    "separation_speed",
    "sliding_ladder_forces",
    "sphere_mass_properties",
    "splitting",
    "standing_ladder_forces",
    "symmetric_top",
    "symplectic_euler",
    "torque_free_motion",
    "torque_free_rotation",
    "total_angular_momentum",
    "total_energy",
    "total_momentum",
    "two_blocks",
    "uniform_gravity",
    "velocity_after",
    "wall_bounce",
]
