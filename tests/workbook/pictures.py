"""What the tests of several pictures need."""

from course.workbook.plots.figure import alternative_text


def text(ax):
    """The alternative text of the figure that an axes lies in."""
    return alternative_text(ax.get_figure(root=True))
