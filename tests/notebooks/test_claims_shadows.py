"""What lesson 05 says in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course.formulas import (
    box_axes,
    oriented_boxes_overlap,
    project,
    shadow_gap,
)
from course.study import (
    box_verdict_costs,
    by_axes,
    called_apart,
    crossed_gaps,
    random_box_pairs,
    sinking_boxes,
    true_overlap,
    wrong_share,
)
from course.study.box_verdicts import gaps_on_axes
from course.workbook.films.sinking_boxes import six_faces

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def pairs():
    return random_box_pairs(2000, seed=5)


@pytest.fixture(scope="module")
def truth(pairs):
    return true_overlap(pairs)


def test_how_wrong_few_axes_are(pairs, truth):
    one, six = said(
        "05", "falls from # percent with one axis to # percent with six, and to 0"
    )
    assert rounds_to(100 * wrong_share(by_axes(pairs, 1)[0], truth), one)
    assert rounds_to(100 * wrong_share(by_axes(pairs, 6)[0], truth), six)
    assert wrong_share(by_axes(pairs, 15)[0], truth) == 0.0
    assert wrong_share(by_axes(pairs, 14)[0], truth) > 0.0, "not before"


def test_how_many_pairs_six_axes_call_overlapping(pairs, truth):
    called, wrong, share = said(
        "05",
        "six axes call # pairs overlapping, and # of these are apart (# percent of all",
    )
    six, tried = by_axes(pairs, 6)
    assert (np.sum(six), np.sum(six & ~truth)) == (int(called), int(wrong))
    assert rounds_to(100 * wrong_share(six, truth), share) and not np.any(~six & truth)
    assert 1.8 < by_axes(pairs, 15)[1] / tried < 2.2, "for about twice the work"


def test_near_misses_are_seen_by_products_in_about_half():
    """The prediction ``six_axes`` says so of those under a centimetre."""
    drawn = random_box_pairs(20000, seed=11)
    axes = box_axes(drawn.rotation_a, drawn.rotation_b)
    gap = gaps_on_axes(drawn) / np.linalg.norm(axes, axis=-1)
    greatest = gap.max(axis=-1)
    near = (greatest > 0) & (greatest < 0.01)
    only_products = gap[near, :6].max(axis=-1) <= 0
    assert near.sum() > 100 and np.mean(only_products) == pytest.approx(0.5, abs=0.08)


def test_upright_boxes_are_much_worse_than_three_face_normals(pairs, truth):
    measured = box_verdict_costs(pairs, truth, peers=False)
    rows = {(r["method"], r["knob"]): r for r in measured.table()}
    upright, three = rows["upright boxes", 3.0], rows["first k axes", 3.0]
    assert upright["count"] >= three["count"] and upright["error"] > 2 * three["error"]


def test_where_the_two_cubes_stop():
    six, true = said("05", "it is $z$: # m by six axes, # m in truth.")
    assert rounds_to(1 + 2 * np.sqrt(2), six) and rounds_to(2 * np.sqrt(2), true)
    (by_hand,) = said("05", "at which $h/\\sqrt2 = 1 + 1.71$: that is # m.")
    assert by_hand == six
    faces, edges = crossed_gaps(3.0)
    (overlap,) = said("05", "and $B$ reaches 1.71 m. The shadows overlap by # m.")
    assert rounds_to(-faces, overlap) and 0.17 == pytest.approx(edges, abs=0.005)


def test_where_they_stop_when_b_is_turned():
    level, at_45, true, at_90 = said(
        "05",
        "where $B$'s centre is still # m high, at 45° at # m; the products always at # m. "
        "With the edges parallel, at 90°, the six say # m too.",
    )
    for turn, said_by_six in ((0.0, level), (-45.0, at_45), (-90.0, at_90)):
        times = np.linspace(0.0, 3.0, 31)
        six = sinking_boxes(turn, 0.0, times, six_faces).height[-1]
        all_axes = sinking_boxes(turn, 0.0, times, oriented_boxes_overlap).height[-1]
        assert rounds_to(six, said_by_six) and rounds_to(all_axes, true)


def test_the_short_form_fails_in_the_order_that_is_said():
    """The shares hang on the last bit of a product: to a third, on any machine."""
    sixteen, fifteen = said(
        "05-more",
        "the short form calls # percent of overlapping pairs apart, "
        "at $10^{-15}$ # percent",
    )
    shares = 100 * called_apart([1e-16, 1e-15, 1e-13], count=8000)
    assert shares[:2] == pytest.approx([float(sixteen), float(fifteen)], rel=0.35)
    assert shares[2] == 0.0


def test_the_square_in_the_notch_is_hidden_by_the_hull():
    """No axis of 3,600 shows a gap for the L; farther out the hull's slanted side does."""
    outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3.0]])
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    angle = np.radians(np.arange(3600) / 20)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def greatest(corner):
        shadows = project(outline, around), project(square + corner, around)
        return shadow_gap(*shadows[0], *shadows[1]).max()

    (inside,) = said("05", "the square's corner $(1.5, #)$ lies in the hull")
    assert 2 * float(inside) < 4 and greatest(float(inside)) < 0
    out, gap = said(
        "05", "Moved out to $(2.1, #)$ it is outside, and on the normal of the "
        "hull's slanted side there is a gap of # m",
    )  # fmt: skip
    assert rounds_to((2 * float(out) - 4) / np.sqrt(2), gap)
    assert rounds_to(greatest(float(out)), gap)
