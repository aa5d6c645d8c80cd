"""The widget of lesson 15: a table that is pushed somewhere from below."""

from __future__ import annotations

from course import study
from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import contact_matrix


def pushed_table() -> Panel:
    """A table pushed up with 1 N: move the push and the centre of mass, and see which
    feet feel it, and how.
    """
    return Panel(
        lambda **chosen: contact_matrix.pushed_table(study.pushed_table(**chosen)),
        {
            "x": slider("push at x", 0.5, -0.55, 0.55, 0.01, "m"),
            "y": slider("push at y", 0.3, -0.35, 0.35, 0.01, "m"),
            "offset_x": slider("centre of mass, x", 0.1, -0.3, 0.3, 0.05, "m"),
            "offset_y": slider("centre of mass, y", 0.05, -0.2, 0.2, 0.05, "m"),
        },
        columns=2,
    )
