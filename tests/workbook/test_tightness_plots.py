"""The picture of lesson 01."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from course.study import mug_costs, probes
from course.workbook import plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_a_mark_stands_at_each_collider_s_count_and_tightness():
    measured = mug_costs(probes(500, seed=1), library=False)
    ax = plots.tightness_against_cost(measured, by="count")
    marks = [(line.get_xdata()[0], line.get_ydata()[0]) for line in ax.lines]
    assert np.allclose(marks, np.transpose([measured.count, 1 - measured.error]))
    assert "sphere" in alternative_text(ax.get_figure())
    assert [t.get_text() for t in ax.texts] == ["sphere", "box", "hull", "compound"]


@pytest.mark.slow
def test_what_has_no_count_is_drawn_by_seconds_only():
    measured = mug_costs(probes(100, seed=1))
    by_count = plots.tightness_against_cost(measured, by="count")
    by_time = plots.tightness_against_cost(measured, by="seconds")
    drawn = [line for line in by_time.lines if len(line.get_xdata())]
    assert len(by_count.lines) == 4 and len(drawn) == len(measured.method)
    ways = [t.get_text() for t in by_time.get_legend().get_texts()]
    assert ways[:2] == ["one comparison a face, in NumPy", "course.overlap"]
