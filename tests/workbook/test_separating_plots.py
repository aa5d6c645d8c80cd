"""The pictures of lesson 05."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from course.study import PENTAGON, TRIANGLE, difference_body, turned
from course.workbook import plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.mark.parametrize(
    ("place", "says"), [((-1.5, 1.3), "outside"), ((-0.3, 0.2), "inside")]
)
def test_the_differences_show_whose_edges_they_are_and_where_0_is(place, says):
    left, right = plots.difference_body(
        difference_body(turned(TRIANGLE, -78, place), PENTAGON)
    )
    text = alternative_text(right.get_figure())
    assert (
        "8 edges, 3 of them edges of A and 5 edges of B" in text
        and f"0 is {says}" in text
    )
    labels = [t.get_text() for t in right.figure.legends[0].get_texts()]
    more = ["0 is beyond this edge"] if says == "outside" else []
    assert sorted(labels) == ["0", *more, "edge of A", "edge of B, turned round"]
    right.figure.canvas.draw()
    scales = [ax.bbox.width / np.ptp(ax.get_xlim()) for ax in (left, right)]
    assert scales[0] == pytest.approx(scales[1], rel=0.02), "an edge has one length"


def test_the_notch_is_drawn_with_the_cut():
    outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3.0]])
    ax = plots.notch(outline, np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]) + 1.5)
    assert "L, 3 m long" in alternative_text(ax.get_figure())
    assert len(ax.lines) == 4
