"""What lesson 06 says in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course import formulas
from course.study import (
    advancement_steps,
    ball_ahead,
    by_looks,
    by_sweep,
    by_swept_bounds,
    distance_of_the_root,
    held_share,
    missed_hit_costs,
    missed_share,
    random_shots,
    rod_time,
    true_hits,
    typical_depth,
    wrong_in_single,
)
from course.study.engines import swept_engines

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def shots():
    return random_shots(2000, seed=6)


@pytest.fixture(scope="module")
def hits(shots):
    return true_hits(shots)


def missed(looks):
    return formulas.miss_probability(0.1, 0.002, 900.0, 1 / looks)


def test_how_many_bullets_pass():
    looks, percent, tenfold = said(
        "06", "at # looks # in 100 pass, and ten times as many looks still let # pass"
    )
    assert rounds_to(100 * missed(float(looks)), percent)
    assert rounds_to(100 * missed(10 * float(looks)), tenfold)
    half, none = said(
        "06", "below one half only from some # looks on, and is 0 from # on"
    )
    below_half = float(half.replace(",", ""))
    assert missed(below_half - 100) > 0.5 > missed(below_half + 100)
    enough = float(none.replace(",", ""))
    assert missed(enough - 1) > 0 == missed(enough)
    way, touched = said(
        "06", "the bullet goes # m, and it touches the wall on # cm of them"
    )
    assert rounds_to(900 / 60, way) and rounds_to(10 + 0.4, touched)


def test_what_swept_boxes_say(shots, hits):
    boxes, meet = said("06", "of # pairs whose swept boxes overlap, # meet")
    said_so = by_swept_bounds(shots)
    assert int(boxes.replace(",", "")) == said_so.sum()
    assert int(meet.replace(",", "")) == hits.sum()
    assert np.all(said_so[hits]) and (~said_so).sum() > 0


def test_what_looks_miss(shots, hits):
    text = (
        "one look a step misses # percent of the hits, 16 looks # percent, "
        "128 looks # percent and 256 looks #."
    )
    for looks, written in zip((1, 16, 128, 256), said("06", text), strict=True):
        assert rounds_to(100 * missed_share(by_looks(shots, looks)[0], hits), written)
    sweep, most = said("06", "with one test a pair: # against #.")
    assert by_sweep(shots)[1] == int(sweep.replace(",", ""))
    assert rounds_to(by_looks(shots, 256)[1], most)
    assert missed_share(by_sweep(shots)[0], hits) == 0
    (again,) = said("06", "is not looked at again, or it would be #.")
    assert 256 * len(shots) == int(again.replace(",", ""))


def test_many_looks_find_what_the_sweep_finds(shots, hits):
    (both,) = said("06", "Both find the same # hits:")
    assert int(both.replace(",", "")) == hits.sum()
    assert np.array_equal(by_looks(shots, 5000)[0], hits)


def test_the_tail_falls_by_four_for_each_doubling(shots, hits):
    """Of 1,376 hits 131, 32 and 7 are left: within their scatter."""
    assert "by a factor of four for each doubling" in " ".join(said_text())
    counts = [np.sum(hits & ~by_looks(shots, k)[0]) for k in (64, 128, 256)]
    for one, next_one in zip(counts[:-1], counts[1:], strict=True):
        assert abs(next_one - one / 4) < 3 * np.sqrt(one / 4)


def test_what_is_said_of_the_looks_for_one_percent(shots, hits):
    from course.exercises.definitions.lesson_06_moving_objects import PREDICTIONS

    (asked,) = (p for p in PREDICTIONS if p.name == "looks_for_one_percent")
    assert "miss 10 in 100; 200 looks miss 0.65." in asked.explanation
    shares = [100 * missed_share(by_looks(shots, k)[0], hits) for k in (60, 200)]
    assert rounds_to(shares[0], "10") and rounds_to(shares[1], "0.65")


def said_text():
    from lesson_text import prose

    return [prose("06")]


@pytest.mark.peers
def test_what_the_library_misses(shots, hits):
    engines = swept_engines()
    if not engines:
        pytest.skip("neither python-fcl nor coal is installed")
    shares = {n: missed_share(f(*shots.arguments), hits) for n, f in engines.items()}
    by_looks_of_a_library = shares.pop("python-fcl, 100 looks", None)
    assert not any(shares.values()), "those that advance miss none"
    (looked,) = said("06-more", "looks 100 times a step, and misses # percent")
    if by_looks_of_a_library is not None:
        assert rounds_to(100 * by_looks_of_a_library, looked)
    measured = missed_hit_costs(shots, hits, looks=(1,))
    assert set(engines) < set(measured.method)


@pytest.mark.peers
def test_how_many_gaps_are_asked_of_the_library(shots, monkeypatch):
    coal = pytest.importorskip("coal")
    asked, gap = [], coal.distance
    monkeypatch.setattr(coal, "distance", lambda *two: asked.append(1) or gap(*two))
    swept_engines()["coal, advanced by its gaps"](*shots.arguments)
    (each,) = said("06-more", "asked for # gaps a pair")
    assert rounds_to(len(asked) / len(shots), each)


def test_where_numbers_of_32_bits_fail():
    """Shares hang on rounding: the order of size is promised."""
    said(
        "06-more",
        "at # m one verdict in a hundred is wrong, at # m one in ten, and from # m on",
    )
    shares = wrong_in_single(formulas.swept_spheres_time, [3.0, 10.0, 50.0])
    assert shares == pytest.approx([0.01, 0.1, 0.46], rel=0.35)
    (metres,) = said("06-more", "2^{11.5}\\,r$: at # m, the dotted line")
    assert rounds_to(2**11.5 * 0.004, metres)
    assert rounds_to(distance_of_the_root(), metres)
    (times,) = said("06-more", "With 64 bits the same happens, # times as far away")
    assert rounds_to((2**-23 / 2**-52) ** 0.5, times)


def test_half_of_the_stopped_balls_are_held():
    assert held_share(formulas.swept_spheres_time, [0.0])[0] == pytest.approx(
        0.5, abs=0.05
    )


def test_how_far_short_is_enough():
    """At a typical overlap the normal distribution leaves 16 percent of 0.6 m; other radii a little more."""
    (percent,) = said("06", "by a typical overlap, and some # percent are still held")
    at = typical_depth()
    shares = held_share(formulas.swept_spheres_time, [at, 10 * at])
    assert 100 * shares[0] == pytest.approx(float(percent), abs=3)
    assert shares[1] == 0
    assert at == pytest.approx(1.5 * 2**-53 * 25 / (2 * 0.6))


def test_hits_near_a_rim_have_short_ways():
    """A way of length s is s^2/(8 r) below the surface, to first order."""
    said("06-more", "comes no deeper than some $s^2/(8r)$ below its surface")
    s, radius = 0.01, 0.3
    below = radius - np.sqrt(radius**2 - (s / 2) ** 2)
    assert below == pytest.approx(s**2 / (8 * radius), rel=1e-3)


def test_scenes_by_what_serves():
    balls = random_shots(2000, seed=6, speed=30.0, radius=0.05)
    true = true_hits(balls)
    assert np.mean(by_looks(balls, 1)[0] != true) == pytest.approx(1 / 9, rel=0.1)
    rolling = random_shots(2000, seed=6, speed=3.0, radius=0.1)
    assert np.mean(by_looks(rolling, 1)[0] != true_hits(rolling)) < 0.001


def test_how_many_steps_a_digit_costs():
    head_on = ball_ahead(2.0, 90.0, 0.6)
    (digit,) = said("06-more", "head on, a digit costs # steps")
    time, d = rod_time(head_on), 1e-6
    closing = -np.diff(head_on.gap(np.array([time - d, time])))[0] / d
    assert rounds_to(-1 / np.log10(1 - closing / 2.0), digit)
    tenth, millionth = said(
        "06-more", "# steps for a tenth of a millimetre, # for a millionth"
    )
    grazing = ball_ahead(2.0, 90.0, 1.0999)
    found = [advancement_steps(grazing, t)[1] for t in (1e-4, 1e-6)]
    assert found == pytest.approx([int(tenth), int(millionth)], abs=1)


def test_from_which_angle_on_chords_miss():
    (degrees,) = said("06-more", "from $\\theta = #°$ on")
    assert rounds_to(np.degrees(2 * np.arccos(1.05 - 0.1)), degrees)
