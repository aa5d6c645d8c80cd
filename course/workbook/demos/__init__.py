"""Widgets to play with: in a lesson ``demos.impulse()``, in front of a room ``course
demo impulse``.
"""

from course.workbook.demos.contact_forces import plank
from course.workbook.demos.contact_matrix import pushed_table
from course.workbook.demos.impacts import wall
from course.workbook.demos.motion import tumbling
from course.workbook.demos.panel import Panel
from course.workbook.demos.registry import DEMOS, Demo, find_demo, player, table
from course.workbook.demos.separation import dome, gap_rate
from course.workbook.demos.spin import rod

impulse = player("impulse")

__all__ = [
    "DEMOS", "Demo", "Panel", "dome", "find_demo", "gap_rate", "impulse", "plank", "pushed_table", "rod", "table",
    "tumbling", "wall",
]  # fmt: skip
