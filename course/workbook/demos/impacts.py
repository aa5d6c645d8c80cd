"""The widget of lesson 11."""

from __future__ import annotations

from course.study import wall_reflection
from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import bounces


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
