"""Verdicts on pairs of boxes: which way each errs, the truth against linear programmes, peers."""

import numpy as np
import pytest
from scipy.optimize import linprog

from course import formulas
from course.study import (
    box_verdict_costs,
    by_axes,
    by_balls,
    by_upright_boxes,
    called_apart,
    random_box_pairs,
    relative_verdict,
    rounding_says,
    tilted_pairs,
    true_overlap,
    wrong_share,
)
from course.study.box_verdicts import CORNERS
from course.study.engines import installed_engines


@pytest.fixture(scope="module")
def pairs():
    return random_box_pairs(300, seed=1)


def test_the_truth_is_that_of_linear_programmes(pairs):
    truth = true_overlap(pairs)
    for k in range(0, 300, 15):
        c_a, r_a, e_a, c_b, r_b, e_b = (x[k] for x in pairs.arguments)
        a, b = c_a + CORNERS * e_a @ r_a.T, c_b + CORNERS * e_b @ r_b.T
        equal = np.block(
            [[a.T, -b.T], [np.ones(8), np.zeros(8)], [np.zeros(8), np.ones(8)]]
        )
        common = linprog(np.zeros(16), A_eq=equal, b_eq=[0, 0, 0, 1, 1]).status == 0
        assert common == truth[k]


def test_fewer_axes_only_ever_call_too_many_overlapping(pairs):
    truth = true_overlap(pairs)
    wrong = []
    for count in range(1, 16):
        said, tried = by_axes(pairs, count)
        assert np.all(said[truth]), "a gap is proof"
        assert len(pairs) <= tried <= count * len(pairs)
        wrong.append(wrong_share(said, truth))
    assert np.all(np.diff(wrong) <= 0) and wrong[5] > 0.02 and wrong[14] == 0.0
    for said in (by_balls(pairs), by_upright_boxes(pairs)):
        assert np.all(said[truth]) and wrong_share(said, truth) > 0.2
    assert by_balls(pairs).all(), "they are drawn so"


def test_boxes_turned_about_one_axis_need_their_faces_only():
    upright = random_box_pairs(300, seed=2, upright=True)
    assert np.array_equal(by_axes(upright, 6)[0], true_overlap(upright))


def test_the_short_form_is_the_15_axes_where_they_are_well_apart(pairs):
    said = relative_verdict(pairs)
    assert np.array_equal(said, formulas.oriented_boxes_overlap(*pairs.arguments))
    loose = relative_verdict(pairs, 0.5)
    assert np.all(loose[said]) and loose.sum() > said.sum()


def test_the_short_form_fails_where_rounding_says_and_vectors_do_not():
    """Ten thousand pairs a tilt: both shares are within four of their standard errors."""
    tilts = [1e-16, 1e-15, 1e-13]
    short, said = called_apart(tilts, count=10_000), rounding_says(tilts, count=10_000)
    scatter = np.sqrt(np.maximum(said, 1e-4) * 2 / 10_000)
    assert np.all(np.abs(short - said)[1:] < 4 * scatter[1:])
    assert 0.05 < short[0] < 0.3 and 0.005 < short[1] < 0.06 and short[2] < 2e-3
    assert called_apart(tilts, count=10_000, epsilon=1e-14).max() == 0.0
    for tilt in tilts:
        tilted = tilted_pairs(tilt, 2000, 3)
        assert formulas.oriented_boxes_overlap(*tilted.arguments).all()
        angle = np.linalg.norm(
            np.cross(tilted.rotation_a, tilted.rotation_b, axis=-2), axis=-2
        )
        assert angle.max() < 2 * tilt + 1e-15


def test_costs_are_measured_for_every_method(pairs):
    measured = box_verdict_costs(pairs, true_overlap(pairs), peers=False)
    assert (
        measured.method[:2] == ("balls", "upright boxes") and len(measured.method) == 17
    )
    best = measured.pick(0.0, "count")
    assert measured.method[best] == "first k axes" and measured.knob[best] == 15
    assert np.all(
        measured.count[2:] == [by_axes(pairs, int(k))[1] for k in measured.knob[2:]]
    )


@pytest.mark.peers
@pytest.mark.parametrize("name", ["python-fcl", "coal"])
def test_a_library_gives_the_same_verdicts(pairs, name):
    engines = installed_engines()
    if name not in engines:
        pytest.skip(f"{name} is not installed")
    assert np.array_equal(engines[name](*pairs.arguments), true_overlap(pairs))
