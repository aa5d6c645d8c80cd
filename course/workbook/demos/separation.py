"""Widgets for lessons 13 and 14."""

from __future__ import annotations

from course import study
from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import bar_and_plank, domes


def gap_rate() -> Panel:
    """A bar over a plank: let each rise and turn, and see what closes the gap."""
    return Panel(
        lambda **chosen: bar_and_plank.contact_velocities(study.gap_rate(**chosen)),
        {
            "rate_a": slider("A turns", 1.5, -3.0, 3.0, 0.25, "rad/s"),
            "rate_b": slider("B turns", 0.5, -3.0, 3.0, 0.25, "rad/s"),
            "velocity_a": slider("A rises", 0.0, -2.0, 2.0, 0.1, "m/s"),
            "velocity_b": slider("B rises", 0.0, -2.0, 2.0, 0.1, "m/s"),
            "reach": slider("y of A's centre", 1.8, 0.2, 2.0, 0.1, "m"),
        },
        columns=2,
    )


def dome() -> Panel:
    """A particle let go on a dome, a moment ahead: its gap, and the gap from the point
    that it touched.
    """
    return Panel(
        lambda **chosen: domes.old_point(study.old_point(**chosen)),
        {
            "angle": slider("angle from the top", 40.0, 5.0, 70.0, 1.0, "°"),
            "ahead": slider("moment ahead", 0.08, 0.0, 0.12, 0.01, "s"),
        },
        columns=2,
    )
