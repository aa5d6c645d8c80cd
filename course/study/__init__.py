"""Experiments: scenes, measurements and comparisons whose results are ready to plot."""

from course.study.ball_flight import BallEvents, BallMotion, ball_events, ball_motion
from course.study.ball_impacts import (
    BilliardBreak,
    CradleComparison,
    SpringCradle,
    ball_contacts,
    billiard_break,
    compare_cradles,
    cradle,
    cradle_by_springs,
    rack,
    touching_row,
)
from course.study.ball_tracks import BallTracks, roll
from course.study.bouncing_ball import (
    PUBLISHED_BOUNCING,
    BouncingErrors,
    PublishedBouncing,
    bouncing_ball_step,
    bouncing_errors,
    bouncing_loop,
    energy_error,
    event_driven_error,
)
from course.study.falling_boxes import FallingBoxes, falling_boxes
from course.study.ladder import (
    ladder,
    ladder_gaps,
    leaving_angle,
    sliding_ladder_forces,
    standing_ladder_forces,
)
from course.study.moving_contacts import (
    DifferenceErrors,
    MovingContact,
    Stencil,
    TurningPair,
    difference_errors,
    moving_contact,
)
from course.study.stepped_cradle import cradle_by_steps
from course.study.two_blocks import (
    TwoBlocks,
    count_collisions,
    critical_mass_ratio,
    pi_count,
    predicted_count,
    two_blocks,
)
from course.study.work_precision import Method, Problem, WorkPrecision, work_precision

__all__ = [
    "PUBLISHED_BOUNCING",
    "BallEvents",
    "BallMotion",
    "BallTracks",
    "BilliardBreak",
    "BouncingErrors",
    "CradleComparison",
    "DifferenceErrors",
    "FallingBoxes",
    "Method",
    "MovingContact",
    "Problem",
    "PublishedBouncing",
    "SpringCradle",
    "Stencil",
    "TurningPair",
    "TwoBlocks",
    "WorkPrecision",
    "ball_contacts",
    "ball_events",
    "ball_motion",
    "billiard_break",
    "bouncing_ball_step",
    "bouncing_errors",
    "bouncing_loop",
    "compare_cradles",
    "count_collisions",
    "cradle",
    "cradle_by_springs",
    "cradle_by_steps",
    "critical_mass_ratio",
    "difference_errors",
    "energy_error",
    "event_driven_error",
    "falling_boxes",
    "ladder",
    "ladder_gaps",
    "leaving_angle",
    "moving_contact",
    "pi_count",
    "predicted_count",
    "rack",
    "roll",
    "sliding_ladder_forces",
    "standing_ladder_forces",
    "touching_row",
    "two_blocks",
    "work_precision",
]
