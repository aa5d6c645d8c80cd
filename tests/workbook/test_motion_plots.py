"""Pictures of motion and the tumbling widget: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from workbook.pictures import text

from course.dynamics import free_tumble
from course.scenes import spinning_handle
from course.workbook import demos, plots
from course.workbook.demos import motion as motion_demo
from course.workbook.plots.motion import RUNS
from course.workbook.viewer.still import draw


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


def test_the_film_has_L_and_omega_where_the_handle_is(motion):
    scene = demos.tumbling_scene(motion)
    momentum, omega = scene.arrows
    assert (momentum.name, omega.name) == ("L", "ω")
    tip = (omega.origin + omega.length)[100, 0]
    assert tip == pytest.approx(
        motion.position[100] + omega.scale * motion.angular_velocity[100]
    )
    assert np.ptp(momentum.length, axis=0) == pytest.approx(np.zeros((1, 3)))
    assert demos.tumbling_scene(motion, arrows=False).arrows == ()


@pytest.mark.slow
def test_the_widget_starts_again_as_its_controls_say():
    demo = demos.tumbling()
    first, film = demo.picture, demo.viewer.plot.objects[0].model_matrix["100"]
    assert "lies across its axis of spin at 1.56, 4.68, 7.80 s" in first
    demo.axis.value = 2
    assert "It never turns over." in demo.picture
    assert not np.allclose(demo.viewer.plot.objects[0].model_matrix["100"], film)
    demo.axis.value = 1
    assert demo.picture == first
    assert demo.tumble.moments[1] * 6.0 == pytest.approx(
        np.linalg.norm(demo.tumble.angular_momentum)
    )
    assert set(demo.values) == {"tilt", "spin", "axis"}
    bundle = demo._repr_mimebundle_()
    assert bundle["text/html"].count("<img") == 2 and bundle["text/plain"] == "[widget]"
    assert "A dotted line marks 1.56 s, where the film stands." in bundle["text/html"]


def test_a_bar_below_the_chart_runs_with_the_film():
    """In the browser alone, from one end of the chart's axis of time to the other."""
    demo = demos.tumbling()
    assert demo._link.source == (demo.viewer.slider, "index")
    assert demo._link.target == (demo._now, "value")
    frames = demo.viewer.scene.times[demo.viewer.frames]
    assert demo._now.max == len(frames) - 1
    shown = frames / frames[-1] - np.linspace(0, 1, len(frames))
    assert np.abs(shown).max() < 0.005 and frames[-1] == motion_demo.SECONDS


def test_axis_labels_stand_above_the_legend_of_a_saved_scene(motion):
    ax = draw(demos.tumbling_scene(motion), time=1.5)
    figure = ax.get_figure()
    figure.canvas.draw()
    top = figure.legends[0].get_window_extent().y1
    for axis in (ax.xaxis, ax.yaxis):
        assert axis.label.get_window_extent().y0 > top + 3
