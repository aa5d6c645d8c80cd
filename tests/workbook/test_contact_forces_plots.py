"""Pictures of contact forces: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from workbook.pictures import text

from course.contact import solve
from course.exercises.definition import find_exercise
from course.scenes import loaded_plank
from course.study import SolverGrowth, plank_forces, two_forces
from course.workbook import plots


def test_leg_forces_draws_a_bar_for_each_answer_and_leg():
    ax = plots.leg_forces({"one": [1.0, 2.0, 0.0], "other": [2.0, 1.0, 0.0]})
    assert [bar.get_height() for bar in ax.patches] == [1, 2, 0, 2, 1, 0]
    assert "one: 1.00, 2.00, 0.00" in text(ax)


@pytest.mark.parametrize("load_at", [0.3, 1.05, -1.5])
def test_force_plane_marks_the_solution_on_the_lines(load_at):
    system = loaded_plank(load_at).system()
    a, b = system.A.toarray(), system.b
    ax = plots.force_plane(two_forces(a, b))
    lines = {line.get_label(): np.array(line.get_data()) for line in ax.lines}
    for i in (0, 1):
        points = lines[rf"$\ddot d_{i + 1} = 0$"]
        np.testing.assert_allclose(a[i] @ points, -b[i], atol=1e-9)
    np.testing.assert_allclose(
        lines["least with f ≥ 0"][:, 0], solve(system).force, atol=1e-9
    )
    np.testing.assert_allclose(a @ lines["both forced to 0"][:, 0], -b, atol=1e-9)
    swept = lines["three sweeps from 0"]
    steps = np.diff(swept, axis=1)
    assert (
        swept.shape == (2, 7)
        and np.all(steps[1, ::2] == 0)
        and np.all(steps[0, 1::2] == 0)
    )  # axis by axis
    answer = find_exercise("projected_gauss_seidel")[1].reference(a, b, np.zeros(2), 3)
    np.testing.assert_allclose(swept[:, -1], answer, rtol=1e-12)
    lifted = np.abs(solve(system).acceleration).max() > 1e-9
    named = [entry.get_text() for entry in ax.get_legend().get_texts()]
    assert (
        r"slope of q there, $\ddot d$" in named
    ) == lifted  # the arrow is drawn only where a slope is left


def test_the_path_of_the_sweeps_is_told_from_the_ellipses_without_colour():
    system = loaded_plank(1.05).system()
    ax = plots.force_plane(two_forces(system.A.toarray(), system.b))
    (path,) = (x for x in ax.lines if x.get_label() == "three sweeps from 0")
    levels = [c for c in ax.collections if hasattr(c, "levels")]
    assert levels and path.get_color() == "#000000" and path.get_marker() == "D"
    assert all(c.get_edgecolor().max() == 1 for c in levels)
    assert min(c.get_edgecolor()[0, 0] for c in levels) >= 0.4  # grey, and no darker
    assert path.get_linewidth() > max(np.max(c.get_linewidth()) for c in levels)
    assert ax.get_legend().get_texts()[0].get_fontsize() >= 11


def test_plank_says_which_foot_lifts():
    ax = plots.plank_and_forces(plank_forces(1.05))
    assert "left foot lifts" in ax.get_title(
        loc="left"
    ) and "the right one 272 N" in text(ax)
    assert "right foot lifts" in plots.plank_and_forces(plank_forces(-1.05)).get_title(
        loc="left"
    )
    assert "both feet stay" in plots.plank_and_forces(plank_forces(0.0)).get_title(
        loc="left"
    )


def test_ladder_forces_tell_where_it_lets_go():
    angles = np.radians([60.0, 45, 30])
    closed = np.array([[80.0, 30], [50, 10], [20, -20]])
    ax = plots.ladder_forces(angles, np.maximum(closed, 0), closed, leaving=0.7)
    assert "40.1 degrees" in text(
        ax
    ) and "falls to -20 N and the solved one stays at 0 N" in text(ax)


def test_solver_growth_draws_time_and_steps():
    n, rows = np.array([10.0, 100.0]), np.array([[1.0, 2.0], [3.0, np.nan]])
    ax = plots.solver_growth(SolverGrowth(n, ("a", "b"), rows, 10 * rows, rows))
    left, right = ax.get_figure().axes
    assert left is ax and len(left.lines) == len(right.lines) == 2
    np.testing.assert_array_equal(right.lines[0].get_ydata(), [10, 20])
    assert "10 to 100 contacts" in text(ax)
    assert (
        "a: 10 steps and 1 s at 10, 20 steps and 2 s at 100. b: 30 steps and 3 s at 10."
        in text(ax)
    )
