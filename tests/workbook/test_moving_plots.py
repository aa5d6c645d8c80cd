"""The picture of a point and a sphere: its marks are the roots, its words say them."""

import numpy as np
import pytest

from course.workbook import plots
from course.workbook.plots.figure import alternative_text


def test_its_marks_are_where_the_way_crosses_the_sphere():
    ax = plots.point_and_sphere((-4, 0.9), (2, 0), 1.5)
    marks = {
        line.get_label(): np.array(line.get_data()).ravel()
        for line in ax.get_lines()
        if line.get_label().startswith("they")
    }
    assert set(marks) == {"they touch, t = 1.4 s", "they part, t = 2.6 s"}
    for place in marks.values():
        assert np.hypot(*place) == pytest.approx(1.5) and place[1] == 0.9
    said = alternative_text(ax.get_figure())
    assert "enters the sphere at 1.4 s" in said and "leaves it at 2.6 s" in said
