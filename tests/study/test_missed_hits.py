"""Shots: what looks miss is what the chords say, what the sweep finds is what many looks see, peers agree."""

import numpy as np
import pytest

from course.study import (
    by_looks,
    by_sweep,
    by_swept_bounds,
    chords,
    missed_by_chords,
    missed_hit_costs,
    missed_share,
    random_shots,
    true_hits,
)
from course.study.engines import swept_engines


@pytest.fixture(scope="module")
def shots():
    return random_shots(500, seed=2)


@pytest.fixture(scope="module")
def hits(shots):
    return true_hits(shots)


def test_they_begin_apart_and_most_hit(shots, hits):
    apart = np.linalg.norm(shots.center_a - shots.center_b, axis=-1)
    assert np.all(apart > shots.radius_a + shots.radius_b)
    assert 0.5 < hits.mean() < 0.9 and len(shots) == 500


def test_many_looks_see_no_hit_that_the_truth_has_not_and_miss_only_rims(shots, hits):
    seen, tests = by_looks(shots, 3000)
    assert not np.any(seen & ~hits)
    # Less than two of these looks fit into the way within reach, for all that they miss.
    assert np.all(chords(shots)[hits & ~seen] < 2 * 15.1 / 3000)
    assert tests < 500 * 3000


def test_the_sweep_is_the_truth_with_one_test_a_pair(shots, hits):
    said, tests = by_sweep(shots)
    assert np.array_equal(said, hits) and tests == len(shots)


@pytest.mark.parametrize("looks", [1, 8, 64])
def test_looks_miss_what_the_chords_say(shots, hits, looks):
    """Within four standard errors of a share of some 350 hits."""
    share = missed_by_chords(shots, hits, looks)
    found = missed_share(by_looks(shots, looks)[0], hits)
    scatter = np.sqrt(max(share * (1 - share), 1e-3) / hits.sum())
    assert abs(found - share) < 4 * scatter + 0.01


def test_swept_boxes_that_are_apart_are_proof(shots, hits):
    boxes = by_swept_bounds(shots)
    assert np.all(boxes[hits]), "who meets sweeps a common point"
    assert np.sum(boxes & ~hits) > 0.1 * len(shots), "and no verdict"
    slow = random_shots(500, seed=3, speed=3.0, radius=0.1)
    apart = ~by_swept_bounds(slow)
    assert apart.sum() > 30 and not true_hits(slow)[apart].any()


def test_slow_balls_are_hardly_ever_missed_by_one_look():
    slow = random_shots(500, seed=3, speed=3.0, radius=0.1)
    assert missed_share(by_looks(slow, 1)[0], true_hits(slow)) < 0.03


def test_costs_are_measured_for_every_method(shots, hits):
    measured = missed_hit_costs(shots, hits, looks=(1, 16), peers=False)
    assert measured.method == ("k looks a step", "k looks a step", "sweep")
    assert measured.count.tolist() == [500, by_looks(shots, 16)[1], 500]
    assert measured.method[measured.pick(0.01, "count")] == "sweep"


@pytest.mark.peers
def test_libraries_that_advance_agree_and_one_that_looks_misses(shots, hits):
    engines = swept_engines()
    if not engines:
        pytest.skip("neither python-fcl nor coal is installed")
    said = {name: asked(*shots.arguments) for name, asked in engines.items()}
    looked = said.pop("python-fcl, 100 looks", None)
    for name, advanced in said.items():
        assert np.array_equal(advanced, hits), name
    if looked is not None:
        assert 0 < missed_share(looked, hits) < 0.15 and not np.any(looked & ~hits)


@pytest.mark.peers
def test_coal_is_asked_of_balls_that_overlap_rest_or_part_as_well():
    asked = swept_engines().get("coal, advanced by its gaps")
    if asked is None:
        pytest.skip("coal is not installed")
    x = np.array([[0.5, 0, 0], [3.0, 0, 0], [3.0, 0, 0], [3.0, 0, 0]])
    v = np.array([[1.0, 0, 0], [0, 0, 0], [1.0, 0, 0], [-2.0, 0, 0]])
    ones, zeros = np.ones(4), np.zeros((4, 3))
    said = asked(x, ones, v, zeros, ones, zeros, 1.0)
    assert said.tolist() == [True, False, False, True]


def test_without_the_library_there_is_no_way_of_it(monkeypatch):
    monkeypatch.setattr("course.study.engines.find_spec", lambda name: None)
    assert swept_engines() == {}
