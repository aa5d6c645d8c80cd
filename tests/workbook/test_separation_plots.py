"""Pictures of gaps: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from workbook.pictures import text

from course import study
from course.contact import separation_acceleration_terms
from course.dynamics import Dome
from course.scenes import bar_over_plank, moving_contact
from course.study import (
    CENTRAL,
    FORWARD,
    Method,
    Problem,
    difference_errors,
    work_precision,
)
from course.workbook import plots

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def test_turning_pair_tells_its_gaps():
    ax = plots.turning_pair(study.pair_states(bar_over_plank(), (0.0, 0.14)))
    assert "0.250 m at 0 s" in text(
        ax
    ) and f"{bar_over_plank().gap(0.14):.3f} m at 0.14 s" in text(ax)
    assert len(ax.patches) >= 4


def test_later_gaps_stand_in_the_picture():
    ax = plots.turning_pair(study.pair_states(bar_over_plank(), (0.0, 0.14)))
    assert (
        f"d = {bar_over_plank().gap(0.14):.3f} m at 0.14 s"
        in [t.get_text() for t in ax.texts][2]
    )


def test_a_marked_point_and_the_opposite_one():
    ax = plots.marked_point(bar_over_plank(), -0.4)
    drawn = [
        tuple(np.round(line.get_xydata()[0], 9))
        for line in ax.lines
        if line.get_marker() == "o"
    ]
    assert drawn == [
        (1.0, 0.3),
        (1.0, 0.05),
        (-0.4, 0.05),
    ]  # the corner, the point below it, the marked one
    assert "N_dot points to the left" in text(ax)


def test_ladder_tells_both_gaps():
    ax = plots.ladder_picture(-1.4, 2.1, np.radians(60))
    assert "floor is 0.37 m" in text(ax) and "wall 0.40 m" in text(ax)


@pytest.mark.parametrize(
    ("motion", "rate"),
    [
        ((1.5, 0.5, 0.0, 0.0), "-1.70"),
        ((0.0, 0.0, 0.3, 0.0), "+0.30"),
        ((0.0, 0.0, 0.0, 0.3), "-0.30"),
    ],
)
def test_contributions_add_up(motion, rate):
    ax = plots.contact_velocities(study.gap_rate(*motion))
    assert f"in all {rate}" in text(ax) and rate in ax.get_title(loc="left")
    bars = ax.get_figure().axes[1].patches
    assert sum(b.get_height() for b in bars[:4]) == pytest.approx(bars[4].get_height())


def test_a_rigid_whole_keeps_its_gap():
    """Both turn at one rate about their own centres, and A rises as the whole would carry it: d_dot = 0."""
    assert "in all +0.00" in text(
        plots.contact_velocities(study.gap_rate(1.0, 1.0, 1.8, 0.0, reach=1.8))
    )


def test_difference_errors_show_every_stencil():
    pair, steps = bar_over_plank(), [1e-3, 1e-2]
    found = difference_errors([(FORWARD, pair.gap), (CENTRAL, pair.gap)], -1.7, steps)
    ax = plots.difference_errors(
        found, formula=0.0, expected={"one-sided": steps, "central": steps}
    )
    assert (
        len(ax.lines) == 5
        and "one-sided, central" in text(ax)
        and "level line" in text(ax)
    )


def test_the_level_line_is_said_to_be_below_only_where_it_is():
    pair, steps = bar_over_plank(), [1e-3, 1e-2]
    found = difference_errors([(CENTRAL, pair.gap)], -1.7, steps)
    lowest = float(found.error["central"].min())
    for formula, where in ((0.5 * lowest, "below them all"), (2 * lowest, "among")):
        assert where in text(plots.difference_errors(found, formula=formula))


def test_errors_by_looks_has_a_column_for_each_way():
    problem = Problem("Rates", abs, "m/s", "0")
    ways = {"once": ((0.0,), 1), "twice": ((1e-3, 1e-5), 2)}
    methods = [
        Method(name, lambda h, n=n: (h + 1e-9, n), knobs)
        for name, (knobs, n) in ways.items()
    ]
    ax = plots.errors_by_looks(
        work_precision(problem, methods, count_unit="looks"), tolerance=1e-4
    )
    once, twice, line = ax.lines
    np.testing.assert_array_equal(once.get_xdata(), [0])
    np.testing.assert_array_equal(twice.get_xdata(), [1, 1])
    np.testing.assert_allclose(line.get_ydata(), 1e-4)
    columns = [label.get_text() for label in ax.get_xticklabels()]
    assert columns == ["once\n(1 look)", "twice\n(2 looks)"]
    assert "once (1 look): 1e-09; twice (2 looks): from 1e-05 to 1e-03" in text(ax)


def test_the_legend_of_the_dome_is_whole():
    ax = plots.dome(Dome().paths())
    figure = ax.get_figure()
    figure.draw_without_rendering()
    assert ax.get_legend().get_window_extent().x1 < figure.bbox.x1


def test_normals_past_a_corner_do_not_reach_the_next_place():
    ax = plots.passing_a_corner(study.corner_passing((0.03,), step=0.1))
    for arrow in ax.texts:
        assert np.linalg.norm(np.subtract(arrow.xy, arrow.xyann)) < 0.1


def test_passing_a_corner_draws_a_normal_at_every_place():
    ax = plots.passing_a_corner(study.corner_passing((0.3, 0.03)))
    assert len(ax.texts) == 22 and "at 0.3 m and at 0.03 m" in text(
        ax
    )  # annotations without text: arrows


def test_dome_tells_both_angles():
    ax = plots.dome(Dome().paths())
    assert "48.2 degrees" in text(ax) and "36.9 degrees" in text(ax)


def test_dome_looks_closer_where_the_printed_path_is_deepest_inside():
    scene = Dome()
    ax = plots.dome(scene.paths())
    times = np.linspace(
        0, 0.4, 4001
    )  # it comes out after 0.23 s, and meets the floor after 0.29 s
    gaps = scene.gap(scene.leaving_angle_as_printed, times)
    deepest = int(np.argmin(gaps))
    out = scene.flight(
        scene.leaving_angle_as_printed, times[deepest + np.argmax(gaps[deepest:] > 0)]
    )
    assert f"up to {-1000 * gaps[deepest]:.0f} mm deep" in text(
        ax
    ) and f"z = {out[1]:.2f} m" in text(ax)
    (near,) = ax.child_axes
    y, z = scene.flight(scene.leaving_angle_as_printed, times[deepest])
    assert np.mean(near.get_xlim()) == pytest.approx(y, abs=1e-2)
    assert np.mean(near.get_ylim()) == pytest.approx(z, abs=1e-2)
    assert np.ptp(near.get_xlim()) < 12 * -gaps[deepest]  # 19 mm are a good part of it


def test_dome_bias_draws_points_on_their_lines():
    scene, angles = Dome(), np.radians([20.0, 50.0])
    measured = {"gap": scene.bias(angles), "old point": scene.bias_as_printed(angles)}
    ax = plots.dome_bias(scene.bias_curves(), angles, measured)
    lines = {line.get_label(): line for line in ax.lines}
    for name, curve in (
        ("gap", lines[r"$v^2/R - g\,\cos\varphi$"]),
        ("old point", lines[r"$2\,v^2/R - g\,\cos\varphi$"]),
    ):
        there = np.interp([20.0, 50.0], *curve.get_data())
        np.testing.assert_allclose(lines[name].get_ydata(), there, atol=1e-2)
    assert "48.19" in text(ax) and "36.87" in text(ax)


def test_old_point_tells_both_gaps():
    scene, theta = Dome(), np.radians(42)
    ax = plots.old_point(study.old_point(42.0, 0.08))
    for gap in (scene.gap(theta, 0.08), scene.gap_from_the_old_point(theta, 0.08)):
        assert f"{1000 * gap:.1f} mm" in text(ax)
    assert "sinks in" in ax.get_title(loc="left")
    lines = {str(line.get_label()): np.transpose(line.get_data()) for line in ax.lines}
    (bar,) = (
        points
        for label, points in lines.items()
        if label.startswith("gap from the old point")
    )
    for end, name in zip(
        bar, ("through the old point", "through the particle"), strict=True
    ):
        (helper,) = (
            points for label, points in lines.items() if label.startswith(name)
        )
        along, off = helper[1] - helper[0], end - helper[0]
        assert (
            abs(along[0] * off[1] - along[1] * off[0]) < 1e-9
        )  # the end lies on its helper line
    assert "lets it go" in plots.old_point(study.old_point(60.0, 0.05)).get_title(
        loc="left"
    )


def test_bias_terms_add_up():
    scene = moving_contact("face_b")
    contacts = scene.contacts
    ax = plots.bias_terms(
        separation_acceleration_terms(
            scene.bodies, contacts, scene.force, scene.torque
        ),
        ["one"],
    )
    heights = [bar.get_width() for bar in ax.patches]
    assert len(heights) == 6 and sum(heights[:5]) == pytest.approx(heights[5])
    assert [label.get_text() for label in ax.texts] == [f"{h:.2f}" for h in heights]
