"""Widgets for lessons 10 and 11."""

from __future__ import annotations

from course.study import central_impact, wall_reflection
from course.workbook.demos.panel import Panel, log_slider, slider
from course.workbook.plots import ball_impacts, bounces


def impulse() -> Panel:
    """Two balls on one line: masses, speeds and restitution, and what the impulse makes
    of them.
    """
    return Panel(
        lambda **chosen: ball_impacts.impact(central_impact(**chosen)),
        {
            "mass_1": log_slider("mass 1 (right)", 2.0, -2, 2, "kg"),
            "mass_2": log_slider("mass 2 (left)", 1.0, -2, 2, "kg"),
            "restitution": slider("restitution e", 0.5, 0.0, 1.0, 0.05),
            "velocity_1": slider("speed 1 along n", -3.0, -4.0, 4.0, 0.25, "m/s"),
            "velocity_2": slider("speed 2 along n", 1.0, -4.0, 4.0, 0.25, "m/s"),
        },
        columns=2,
    )


def wall() -> Panel:
    """A ball meets a wall: turn both, and choose how much of the speed comes back."""
    return Panel(
        lambda **chosen: bounces.reflection(wall_reflection(**chosen)),
        {
            "wall_angle": slider("angle of the wall", 20.0, -60.0, 60.0, 1.0, "°"),
            "incoming_angle": slider(
                "direction of the ball", -25.0, -180.0, 180.0, 1.0, "°"
            ),
            "restitution": slider("restitution e", 0.8, 0.0, 1.0, 0.05),
        },
        columns=2,
    )
