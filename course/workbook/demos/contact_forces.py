"""The widget for lesson 16."""

from __future__ import annotations

from course.study import plank_forces
from course.workbook.demos.panel import Panel, slider
from course.workbook.plots import two_contacts


def plank() -> Panel:
    """A plank on two feet: drag the load, and see the forces, the programme they
    minimise, and a foot that lifts.
    """
    return Panel(
        lambda **chosen: two_contacts.plank_and_forces(plank_forces(**chosen)),
        {"load_at": slider("place of the load", 0.3, -1.5, 1.5, 0.05, "m")},
    )
