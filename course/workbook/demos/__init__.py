"""Widgets to play with: in a lesson ``demos.impulse()``, in front of a room ``course
demo impulse``.
"""

from course.workbook.demos.impacts import wall
from course.workbook.demos.panel import Panel
from course.workbook.demos.registry import DEMOS, Demo, find_demo, player, table
from course.workbook.demos.separation import dome, gap_rate
from course.workbook.demos.spin import rod

impulse = player("impulse")
handle = player("handle")
pushed_table = player("pushed_table")
plank = player("plank")
sweeps = player("sweeps")

__all__ = [
    "DEMOS", "Demo", "Panel", "dome", "find_demo", "gap_rate", "handle", "impulse", "plank",
    "pushed_table", "rod", "sweeps", "table", "wall",
]  # fmt: skip
