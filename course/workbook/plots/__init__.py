"""Pictures of results: ``plots.<what>(result, *, ax=None) -> Axes``, then ``plots.show()``.

Every function draws into ``ax`` (a new one in the house's style when none is given), writes the alternative text of
what it drew, and returns the Axes, so that a student can go on drawing.
"""

from course.workbook.plots.charts import stability_sweep, work_precision
from course.workbook.plots.figure import PALETTE, axes, describe, figure_html, show

__all__ = ["PALETTE", "axes", "describe", "figure_html", "show", "stability_sweep", "work_precision"]
