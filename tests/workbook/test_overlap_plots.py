"""The pictures of lesson 04."""

import matplotlib.pyplot as plt
import pytest

from course import study
from course.workbook import plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_the_foot_is_where_the_parabola_is_least():
    _, right = plots.foot_of_point((3.0, 2.5), (4.0, 1.0))
    # (3, 2.5).(4, 1) = 14.5 over 17.
    assert "least at s = 0.853" in alternative_text(right.get_figure())
    least = right.lines[1].get_xdata()[0]
    curve = right.lines[0]
    lowest = curve.get_xdata()[curve.get_ydata().argmin()]
    assert least == pytest.approx(14.5 / 17) and abs(lowest - least) < 0.02


def test_steps_are_marked_where_they_are_asked_for():
    ax = plots.number_steps(study.steps_of_numbers(marked=1e7))
    text = alternative_text(ax.get_figure())
    assert "At 1e+07 m numbers of 4 bytes have steps of 1 m" in text
    labels = [t.get_text() for t in ax.get_legend().get_texts()]
    assert labels == ["2 bytes", "4 bytes", "8 bytes"]
