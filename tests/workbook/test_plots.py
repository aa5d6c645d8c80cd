"""Pictures draw where they are told, say in words what they show, and leave a student's own settings alone."""

import re

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest

from course.study import Method, Problem, two_blocks, work_precision
from course.workbook import demos, plots
from course.workbook.plots.figure import alternative_text


@pytest.fixture(autouse=True)
def no_figure_left():
    plt.close("all")
    yield
    plt.close("all")


def a_work_precision():
    method = Method("halving", lambda h: (1 + h, round(1 / h)), (0.5, 0.25, 0.125), "step")
    return work_precision(Problem("a problem", lambda v: abs(v - 1), "m", "exactly 1"), [method], count_unit="steps")


DRAWN = {
    "impact": lambda ax: plots.impact(2.0, 1.0, -3.0, 1.0, 0.5, ax=ax),
    "impact of bodies that part": lambda ax: plots.impact(2.0, 100.0, 3.0, 1.0, 0.5, ax=ax),
    "ball_row": lambda ax: plots.ball_row({"before": (1.0, 0.0), "after": (0.0, 1.0)}, ax=ax),
    "blocks_and_wall": lambda ax: plots.blocks_and_wall(ax=ax),
    "block_paths": lambda ax: plots.block_paths(two_blocks(100), ax=ax),
    "velocity_circle": lambda ax: plots.velocity_circle(two_blocks(100), ax=ax),
    "reflection": lambda ax: plots.reflection(20.0, -25.0, 0.8, ax=ax),
    "stability_sweep": lambda ax: plots.stability_sweep([1, 2], [3, 4], threshold=1.5, labels=("a", "b", "c"), ax=ax),
    "work_precision": lambda ax: plots.work_precision(a_work_precision(), by="count", tolerance=0.3, ax=ax),
}


@pytest.mark.parametrize("draw", DRAWN.values(), ids=DRAWN.keys())
def test_draws_into_the_axes_it_is_given_and_says_what_it_shows(draw):
    _, (mine, other) = plt.subplots(1, 2)
    before = mpl.rcParams.copy()  # after the first figure, which settles the backend
    assert draw(mine) is mine
    assert mine.has_data() or mine.patches or mine.texts
    assert not (other.lines or other.patches or other.texts)
    assert len(alternative_text(mine.figure)) > 30
    assert draw(None) is not mine and len(plt.get_fignums()) == 2
    assert mpl.rcParams == before


def test_a_figure_is_shown_once_with_its_text_escaped(capsys):
    ax = plots.axes()
    ax.plot([1, 2])
    plots.describe(ax, 'Speed < 3 m/s, "fast" & loose.')
    html = plots.figure_html(ax.figure)
    assert 'alt="Speed &lt; 3 m/s, &quot;fast&quot; &amp; loose."' in html
    plots.show()
    assert capsys.readouterr().out.startswith("[figure] Speed < 3 m/s")
    plots.show()
    assert capsys.readouterr().out == "" and plt.get_fignums() == []


def test_a_figure_without_words_is_refused_once_and_does_not_come_back(capsys):
    plt.plot([1, 2])
    with pytest.raises(ValueError, match="expected alternative text"):
        plots.show()
    plots.blocks_and_wall()
    plots.show()
    assert "[figure]" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("demo", demos.DEMOS, ids=lambda d: d.name)
def test_a_demo_redraws_with_its_words_as_a_slider_moves(demo):
    panel = demo.make()
    words = [re.search('alt="([^"]*)"', panel.picture).group(1)]
    control = next(iter(panel._controls.values()))
    control.value = control.value * 0.5 or control.max * 0.5  # a slider may stand at 0
    words.append(re.search('alt="([^"]*)"', panel.picture).group(1))
    assert words[0] != words[1] and plt.get_fignums() == []
    assert all(np.isfinite(v) for v in panel.values.values())
