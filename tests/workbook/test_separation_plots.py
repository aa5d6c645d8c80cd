"""Pictures of gaps: what is drawn, and that the alternative text says the numbers."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from course.study import TurningPair, difference_errors
from course.study.moving_contacts import CENTRAL, FORWARD
from course.workbook import demos, plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def text(ax):
    return alternative_text(ax.get_figure(root=True))


def test_turning_pair_tells_its_gaps():
    ax = plots.turning_pair(TurningPair(), (0.0, 0.14))
    assert "0.250 m at 0 s" in text(ax) and f"{TurningPair().gap(0.14):.3f} m at 0.14 s" in text(ax)
    assert len(ax.patches) >= 4


def test_ladder_tells_both_gaps():
    ax = plots.ladder_picture(-1.4, 2.1, np.radians(60))
    assert "floor is 0.37 m" in text(ax) and "wall 0.40 m" in text(ax)


@pytest.mark.parametrize(
    ("motion", "rate"),
    [((1.5, 0.5, 0.0, 0.0), "-1.70"), ((0.0, 0.0, 0.3, 0.0), "+0.30"), ((0.0, 0.0, 0.0, 0.3), "-0.30")],
)
def test_contributions_add_up(motion, rate):
    ax = plots.contact_velocities(*motion)
    assert f"in all {rate}" in text(ax) and rate in ax.get_title(loc="left")
    bars = ax.get_figure().axes[1].patches
    assert sum(b.get_height() for b in bars[:4]) == pytest.approx(bars[4].get_height())


def test_a_rigid_whole_keeps_its_gap():
    """Both turn at one rate about their own centres, and A rises as the whole would carry it: d_dot = 0."""
    assert "in all +0.00" in text(plots.contact_velocities(1.0, 1.0, 1.8, 0.0, reach=1.8))


def test_difference_errors_show_every_stencil():
    pair, steps = TurningPair(), [1e-3, 1e-2]
    found = difference_errors([(FORWARD, pair.gap), (CENTRAL, pair.gap)], -1.7, steps)
    ax = plots.difference_errors(found, formula=0.0, expected={"one-sided": steps, "central": steps})
    assert len(ax.lines) == 5 and "one-sided, central" in text(ax) and "level line" in text(ax)


def test_passing_a_corner_draws_a_normal_at_every_place():
    ax = plots.passing_a_corner((0.3, 0.03))
    assert len(ax.texts) == 22 and "at 0.3 m and at 0.03 m" in text(ax)  # annotations without text: arrows


def test_the_widget_redraws():
    panel = demos.gap_rate()
    before = panel.picture
    panel.children[0].children[0].value = 0.0
    assert "in all -0.50" in panel.picture and panel.picture != before
