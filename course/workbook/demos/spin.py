"""The widget of lesson 12: a rod that the floor hits somewhere."""

from __future__ import annotations

from course.study import rod_landing
from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import rods


def rod() -> Panel:
    """A falling rod before and after it is hit: its angle, the restitution, and where
    the floor meets it.
    """
    return Panel(
        lambda **chosen: rods.rod_impact(rod_landing(**chosen)),
        {
            "place": slider("hit at (0 middle, 1 end)", 1.0, -1.0, 1.0, 0.05),
            "angle": slider("angle of the rod", 0.0, 0.0, 90.0, 1.0, "°"),
            "restitution": slider("restitution e", 1.0, 0.0, 1.0, 0.05),
        },
        columns=2,
    )
