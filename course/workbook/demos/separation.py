"""Widgets for lessons 13 and 14."""

from __future__ import annotations

from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import separation as plots


def gap_rate() -> Panel:
    """A bar over a plank: let each rise and turn, and see which motion closes the gap."""
    return Panel(
        plots.contact_velocities,
        {
            "rate_a": slider("A turns", 1.5, -3.0, 3.0, 0.25, "rad/s"),
            "rate_b": slider("B turns", 0.5, -3.0, 3.0, 0.25, "rad/s"),
            "velocity_a": slider("A rises", 0.0, -2.0, 2.0, 0.1, "m/s"),
            "velocity_b": slider("B rises", 0.0, -2.0, 2.0, 0.1, "m/s"),
            "reach": slider("y of A's centre", 1.8, 0.2, 2.0, 0.1, "m"),
        },
        columns=2,
    )
