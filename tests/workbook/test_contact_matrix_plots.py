"""Pictures of the contact matrix: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from workbook.pictures import text

from course.scenes import table, wall
from course.study import matrix_growth, pushed_table
from course.workbook import plots


def test_a_push_at_a_foot_shows_its_column_of_a():
    ax = plots.pushed_table(pushed_table(-0.5, -0.3))  # foot 3
    column = table().system().A.toarray()[:, 2]
    assert ", ".join(f"{v:+.2f}" for v in column) in text(ax)
    bars = [bar.get_height() for bar in ax.get_figure().axes[1].patches]
    np.testing.assert_allclose(bars, column, atol=1e-12)


def test_without_the_answer_it_says_nothing():
    ax = plots.pushed_table(pushed_table(), answer=False)
    assert "accelerated" not in text(ax) and len(ax.get_figure().axes) == 1


def test_the_still_line_parts_rising_from_sinking():
    """Feet on the far side of the dashed line go down, and a push at the centre of mass has no such line."""
    ax = plots.pushed_table(pushed_table(0.5, 0.3))
    line = next(line for line in ax.lines if line.get_linestyle() == "--")
    (x_0, x_1), (y_0, y_1) = line.get_data()
    side = [
        (x_1 - x_0) * (y - y_0) - (y_1 - y_0) * (x - x_0)
        for x, y, _ in table().contacts.point
    ]
    response = table().system().A.toarray()[:, 0]
    assert np.array_equal(np.sign(side) == np.sign(side[0]), response > 0)
    even = plots.pushed_table(pushed_table(0.1, 0.05))
    assert not [line for line in even.lines if line.get_linestyle() == "--"]
    assert "+1.00, +1.00, +1.00, +1.00" in text(even)


def test_pattern_counts_what_is_not_zero():
    scene = wall(2, 2)
    ax = plots.matrix_pattern(scene.system(), name=scene.name)
    drawn = sum(len(line.get_xdata()) for line in ax.lines)
    assert drawn == np.count_nonzero(scene.system().A.toarray())
    assert "percent of A is not 0" in text(ax)


def test_costs_show_the_exponent():
    n = [10.0, 100.0, 1000.0]
    found = matrix_growth({"full": n}, {"full": np.square(n)}, {"full": np.power(n, 3)})
    ax = plots.matrix_costs(found)
    assert "full multiplications c^3.0" in text(ax)
    times, counts = (
        [entry.get_text() for entry in panel.get_legend().get_texts()]
        for panel in ax.get_figure().axes
    )
    # an exponent of seconds is another one on another machine: it is not told
    assert (times, counts) == (["full"], ["full: c^3.0"])
    first, last = n[0], n[-1]
    told = f"from {first**2:.2g} at {first:g} to {last**2:.2g} at {last:g} contacts"
    assert f"full time [s] {told}" in text(ax)


def test_a_foot_on_the_still_line_feels_nothing():
    """1 - 1.75 p_y - 2 p_x = 0 for foot 3 with the push at (0.46, 0.21) m: the lesson names this place."""
    ax = plots.pushed_table(pushed_table(0.46, 0.21))
    heights = [bar.get_height() for bar in ax.get_figure().axes[1].patches]
    assert (
        heights[2] == pytest.approx(0, abs=1e-12)
        and min(heights[0], heights[1], heights[3]) > 0.3
    )
