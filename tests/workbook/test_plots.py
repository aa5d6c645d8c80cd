"""Pictures draw where they are told, say in words what they show, and leave a student's own settings alone."""

import ast
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest

from course import study
from course.dynamics import two_blocks
from course.study import Method, Problem, WorkPrecision, work_precision
from course.workbook import plots
from course.workbook.plots.figure import alternative_text

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def a_work_precision():
    method = Method(
        "halving", lambda h: (1 + h, round(1 / h)), (0.5, 0.25, 0.125), "step"
    )
    return work_precision(
        Problem("a problem", lambda v: abs(v - 1), "m", "exactly 1"),
        [method],
        count_unit="steps",
    )


DRAWN = {
    "impact": lambda ax: plots.impact(
        study.central_impact(2.0, 1.0, -3.0, 1.0, 0.5), ax=ax
    ),
    "impact of bodies that part": lambda ax: plots.impact(
        study.central_impact(2.0, 100.0, 3.0, 1.0, 0.5), ax=ax
    ),
    "ball_row": lambda ax: plots.ball_row(
        {"before": (1.0, 0.0), "after": (0.0, 1.0)}, ax=ax
    ),
    "blocks_and_wall": lambda ax: plots.blocks_and_wall(ax=ax),
    "block_paths": lambda ax: plots.block_paths(two_blocks(100), ax=ax),
    "velocity_circle": lambda ax: plots.velocity_circle(two_blocks(100), ax=ax),
    "reflection": lambda ax: plots.reflection(
        study.wall_reflection(20.0, -25.0, 0.8), ax=ax
    ),
    "stability_sweep": lambda ax: plots.stability_sweep(
        [1, 2], [3, 4], threshold=1.5, labels=("a", "b", "c"), ax=ax
    ),
    "work_precision": lambda ax: plots.work_precision(
        a_work_precision(), by="count", tolerance=0.3, ax=ax
    ),
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


def spread_over(decades, *, start):
    """Runs that take from ``start`` [s] on over so many decades, each at half the error."""
    seconds, error = start * 10 ** np.linspace(0, decades, 5), 0.5 ** np.arange(5)
    problem = Problem("a problem", abs, "m", "exactly 0")
    names = ("halving",) * 5
    return WorkPrecision(problem, "steps", names, error, error, seconds, seconds)


@pytest.mark.parametrize(
    ("exact", "side"), [(0, "right"), (4, "left"), ([0, 4], "center")]
)
def test_the_words_at_the_level_of_exact_runs_stand_away_from_them(exact, side):
    result = spread_over(2.0, start=1e-3)
    result.error[exact] = 0.0
    ax = plots.work_precision(result)
    (words,) = (t for t in ax.texts if t.get_text() == "exact to rounding")
    assert words.get_ha() == side


def test_they_stand_between_exact_runs_at_both_ends():
    result = spread_over(2.0, start=1e-3)
    result.error[[0, 4]] = 0.0
    ax = plots.work_precision(result)
    (words,) = (t for t in ax.texts if t.get_text() == "exact to rounding")
    left, right = sorted(result.cost("seconds")[[0, 4]])
    assert 2 * left < words.get_position()[0] < right / 2
    assert words.get_ha() == "center"


@pytest.mark.parametrize("decades", [0.05, 0.3, 0.7, 1.0, 1.5, 1.9, 2.5, 6.0])
@pytest.mark.parametrize("start", [1.2e-4, 3e-3, 7.0])
def test_labels_of_a_logarithmic_axis_stand_apart(decades, start):
    ax = plots.work_precision(spread_over(decades, start=start))
    ax.figure.draw_without_rendering()
    low, high = ax.get_xlim()
    boxes = [
        label.get_window_extent()
        for tick, label in zip(ax.get_xticks(), ax.get_xticklabels(), strict=True)
        if low <= tick <= high and label.get_text()
    ]
    assert len(boxes) >= 2 and not any(
        t.get_text() for t in ax.get_xticklabels(minor=True)
    )
    assert all(a.x1 < b.x0 for a, b in zip(boxes, boxes[1:], strict=False))


def test_ring_and_star_touch_neither_in_the_chart_nor_in_its_legend():
    ax = plots.work_precision(a_work_precision(), by="count", tolerance=0.3)
    ax.figure.draw_without_rendering()
    ring, star = (line for line in ax.lines if line.get_markersize() >= 10)
    reach = 0.5 * (ring.get_markersize() + ring.get_markeredgewidth())
    # A pentagram's inner corners are 0.382 as far from its centre as its tips.
    inner = 0.5 * (0.381966 * star.get_markersize() - star.get_markeredgewidth())
    assert reach < inner
    legend = ax.get_legend()
    points = 72 / ax.figure.dpi
    rows = [points * text.get_window_extent().y0 for text in legend.get_texts()]
    sizes = [handle.get_markersize() for handle in legend.legend_handles]
    for above, below, a, b in zip(rows, rows[1:], sizes, sizes[1:], strict=False):
        assert above - below > 0.5 * (a + b)


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


def words_of_a_sweep(knob, measured, **options):
    labels = ("step [s]", "growth [-]", "A title")
    return alternative_text(
        plots.stability_sweep(knob, measured, labels=labels, **options).figure
    )


def test_a_sweep_is_told_at_its_ends_and_beside_its_threshold():
    x = np.array([0.0, 0.5, 1.5, 2.5, 3.0, 4.0])
    told = words_of_a_sweep(
        x,
        x**2,
        predicted=x**2 + 1e-15,
        cure=0.5 + 0 * x,
        threshold=2.0,
        names=("plain", "x squared", "mended"),
    )
    assert told == (
        "A title: growth [-] over step [s]. The predicted threshold is 2, between 1.5 and 2.5. plain: below 1e-12 at "
        "0, 2.25 at 1.5, 6.25 at 2.5, 16 at 4. x squared: the same there as plain. mended: 0.5 at each of these."
    )
    assert "x squared: 1 at 0, 3.25 at 1.5," in words_of_a_sweep(
        x, x**2, predicted=x**2 + 1, threshold=2.0, names=("plain", "x squared", "")
    )


def test_a_sweep_is_told_in_the_order_of_its_knob_and_where_it_peaks():
    x = np.array([3.0, 1.0, 2.0, 5.0, 4.0])
    told = words_of_a_sweep(x, np.array([0.3, 0.1, 0.2, 0.5, 0.4]))
    assert "measured: 0.1 at 1, 0.3 at 3, 0.5 at 5." in told
    x = np.linspace(0.0, 1.0, 11)
    told = words_of_a_sweep(x, x * (1 - x) * np.where(x < 0.5, 1, -1), threshold=0.95)
    assert (
        "measured: below 1e-12 at 0, 0.24 at 0.4, -0.25 at 0.5, -0.09 at 0.9, below 1e-12 at 1."
        in told
    )


@pytest.mark.parametrize(
    ("threshold", "where"),
    [
        (0.5, "is 0.5, before the first point. measured: 1 at 1, 3 at 3."),
        (7.0, "is 7, past the last point. measured: 1 at 1, 3 at 3."),
        (
            2.0,
            "is 2, between 1 and 3. measured: 1 at 1, 3 at 3.",
        ),  # the point on it is neither
    ],
)
def test_a_threshold_outside_a_sweep_or_on_a_point_of_it(threshold, where):
    assert words_of_a_sweep(
        [1.0, 2.0, 3.0], [1.0, 2.0, 3.0], threshold=threshold
    ).endswith(where)


def test_a_sweep_with_gaps_says_so():
    nan = float("nan")
    assert words_of_a_sweep([1, 2, 3], [nan, 5.0, 6.0]).endswith(
        "measured: no value at 1, 5 at 2, 6 at 3."
    )
    assert words_of_a_sweep([1, 2, 3], [nan] * 3).endswith(
        "measured: no value at 1, no value at 2, no value at 3."
    )
    assert words_of_a_sweep([1, 2, 3, 4, 5], [nan, 7.0, nan, 9.0, nan]).endswith(
        "no value at 1, 7 at 2, no value at 3, 9 at 4, no value at 5."
    )


def worked_out(source):
    """What a module of plots imports to work something out: functions of the numerics, fits, solvers."""
    said = []
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.ImportFrom) or node.module is None:
            continue
        if node.module.split(".")[0] == "scipy":
            said.append(node.module)
        if node.module.split(".")[:2] in NUMERIC_ROOMS:
            # Types and constants begin with a capital letter; outlines are drawn.
            said += [a.name for a in node.names if not a.name[0].isupper()]
    return [name for name in said if name != "bar_and_plank_outlines"]


NUMERIC_ROOMS = [
    ["course", room]
    for room in ("formulas", "overlap", "dynamics", "contact", "scenes", "study")
]
MODULES = sorted(Path(plots.__file__).parent.glob("*.py"))


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_plots_draw_results_and_work_nothing_out(path):
    source = path.read_text(encoding="utf-8")
    assert worked_out(source) == [] and "polyfit" not in source


def test_a_plot_that_works_something_out_is_found():
    source = (
        "from course.dynamics import Dome, ladder_gaps\nfrom scipy.optimize import f"
    )
    assert worked_out(source) == ["ladder_gaps", "scipy.optimize"]
