"""The pictures of lesson 02."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from course import study
from course.workbook import plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_the_turned_box_tells_where_its_corners_lie():
    """3 and 2 m by cos 0.8, sin 0.6: 3 * 0.8 - 2 * 0.6 = 1.2 and 3 * 0.8 + 2 * 0.6 = 3.6."""
    ax = plots.turned_box([3.0, 2.0], np.degrees(np.arccos(0.8)))
    text = alternative_text(ax.get_figure())
    assert "x = 1.2, -3.6, -1.2, 3.6 m" in text
    assert "Highest lies 3 r_1 + 2 r_2, at y = 3.4 m" in text
    said = sorted(t.get_text() for t in ax.texts if "x =" in t.get_text())
    assert said == [
        "$3 r_1 + 2 r_2$\nx = 1.2, y = 3.4", "$3 r_1 - 2 r_2$\nx = 3.6", "x = \N{MINUS SIGN}1.2",
        "x = \N{MINUS SIGN}3.6",
    ]  # fmt: skip


@pytest.mark.slow
def test_all_kinds_are_drawn_with_their_volume_and_their_numbers():
    kinds = study.collider_kinds()
    several = plots.collider_kinds(kinds, study.seen_parts(study.flat_dumbbell()))
    names = [ax.get_title("center").split("\n")[0] for ax in several]
    assert names == [
        "sphere", "capsule", "AABB", "OBB", "k-DOP, 14 sides", "convex hull", "compound",
        "half space",
    ]  # fmt: skip
    text = alternative_text(several[0].get_figure())
    for kind in kinds[:-1]:
        assert f"{kind.name}: {kind.ratio:.2f} ×" in text
    assert "half space: no end, 4 numbers" in text


def test_outlines_hold_the_dumbbell_and_touch_it():
    corners = study.flat_dumbbell().vertices[:, :2]
    for kind in study.collider_kinds()[:6]:
        (around,) = kind.outlines
        angle = np.radians(np.arange(0, 360, 7))
        ways = np.stack([np.cos(angle), np.sin(angle)])
        gain = (around @ ways).max(axis=0) - (corners @ ways).max(axis=0)
        # An outline has a corner every half degree: a circle of 0.26 m loses 3e-6 m.
        assert gain.min() > -1e-5 and gain.min() < 0.002
    assert study.compound_ratio("convex_hull") == pytest.approx(1.0)
