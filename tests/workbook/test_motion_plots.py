"""Pictures of motion: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from workbook.pictures import text

from course.dynamics import free_tumble
from course.scenes import spinning_handle
from course.workbook import plots
from course.workbook.plots.motion import RUNS


@pytest.fixture(scope="module")
def motion():
    return free_tumble(spinning_handle().bodies, np.linspace(0, 8, 401))


def test_energies_are_drawn_with_their_sum():
    times = np.array([0.0, 1.0, 2.0])
    ax = plots.energies(
        times, {"V": [3.0, 2.0, 0.0], "T": [0.0, 1.0, 3.5]}, title="A fall"
    )
    assert [line.get_label() for line in ax.lines] == ["V", "T", "their sum"]
    assert ax.lines[-1].get_ydata() == pytest.approx([3.0, 3.0, 3.5])
    assert (
        "A fall over 0 to 2 s: V runs from 0 to 3 J; T runs from 0 to 3.5 J. Their sum changes by 0.5 J."
        in text(ax)
    )
    assert len({line.get_linestyle() for line in ax.lines[:2]}) == 2


def test_L_seen_from_the_body_tells_each_turning_over(motion):
    ax = plots.seen_from_body(motion.body_view())
    for line, values in zip(ax.lines, motion.seen_from_body.T, strict=False):
        assert line.get_ydata() == pytest.approx(
            values / np.linalg.norm(motion.angular_momentum)
        )
    for when in motion.turnover_times():
        assert f"{when:.2f}" in text(ax)
    assert (
        "crossbar -0.49 to 0.49, stem -1.00 to 1.00, third axis 0.02 to 0.87"
        in text(ax)
    )
    short = free_tumble(spinning_handle().bodies, np.linspace(0, 1, 51))
    assert "The part along the stem does not cross zero." in text(
        plots.seen_from_body(short.body_view())
    )


def test_lines_of_equal_energy_hold_the_path(motion):
    """The path drawn in each panel stays on its sphere and on one level of the energy."""
    ax = plots.energy_contours(motion.energy_lines())
    panels = ax.get_figure().axes
    drawn = set()
    assert len(panels) == 3
    for toward, panel in enumerate(panels):
        for line in panel.lines:
            if line.get_label() != RUNS:
                continue
            x, y = (np.asarray(v) for v in line.get_data())
            drawn.add(toward)
            depth = 1 - x**2 - y**2
            assert depth.min() > -1e-12
            moments = np.roll(motion.moments, -toward)
            level = depth / moments[0] + x**2 / moments[1] + y**2 / moments[2]
            assert level == pytest.approx(level[0], rel=1e-9)
    assert len(drawn) == 3 and "closed rings" in text(ax)
    assert (
        "crossbar -0.49 to 0.49, stem -1.00 to 1.00, third axis 0.02 to 0.87"
        in text(ax)
    )
