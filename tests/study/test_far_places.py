"""Places far out: steps, thresholds and verdicts; spheres a few roundings from touching; peers."""

from decimal import Decimal, localcontext

import numpy as np
import pytest

from course import formulas
from course.study import (
    DECIDED,
    called_touching,
    nearly_touching,
    safe_until,
    seen_from_a,
    spacing,
    sphere_pairs,
    sphere_verdict_bytes,
    sphere_verdict_seconds,
    steps_say,
    stored,
    tenths,
    with_margin,
    with_root,
    wrong_far_out,
    wrong_verdicts,
)
from course.study.engines import installed_sphere_engines

VERDICT = formulas.spheres_overlap


@pytest.mark.parametrize("size, digits", [(2, 11), (4, 24), (8, 53)])
def test_steps_are_those_of_so_many_binary_digits(size, digits):
    for power in (0, 3, 10):
        inside = 1.5 * 2.0**power
        assert spacing(inside, size) == 2.0 ** (power + 1 - digits)
    if size == 4:
        assert spacing(1e8) == 8.0 and spacing(1e7) == 1.0


@pytest.mark.parametrize("gap, size", [(0.01, 4), (0.01, 8), (1.0, 4), (0.1, 2)])
def test_the_safe_place_is_the_last_with_steps_small_enough(gap, size):
    limit = safe_until(gap, size)
    assert np.sqrt(3) * spacing(0.99 * limit, size) <= gap
    assert np.sqrt(3) * spacing(limit, size) > gap


def test_gaps_are_as_they_were_drawn():
    pairs = sphere_pairs(500, 1e6, seed=1)
    apart = np.linalg.norm(pairs.center_b - pairs.center_a, axis=-1)
    gap = apart - pairs.radius_a - pairs.radius_b
    np.testing.assert_allclose(gap, pairs.gap, atol=1e-9)
    assert 0.01 <= np.abs(gap).min() + 1e-9 and np.abs(gap).max() < 0.5 + 1e-9
    assert 0.4 < np.mean(pairs.overlap) < 0.6


def test_no_verdict_is_wrong_up_to_the_computed_place_and_many_are_beyond():
    limit = safe_until(0.01)
    near, far = wrong_far_out(VERDICT, [0.99 * limit, 10 * limit], count=20_000)
    assert near == 0.0 and far > 0.01
    assert wrong_far_out(VERDICT, [1e9], size=8)[0] == 0.0


def test_steps_alone_say_how_many_verdicts_are_wrong():
    """Two draws of 10,000 pairs: within four of their standard errors."""
    distances = [1e5, 4e5, 1e6, 1e7, 1e8]
    found, said = wrong_far_out(VERDICT, distances), steps_say(distances)
    scatter = np.sqrt(np.maximum(said * (1 - said), 1e-4) * 2 / 10_000)
    assert np.all(np.abs(found - said) < 4 * scatter)
    assert found[0] == 0 and found[-1] > 0.4


def test_seen_from_a_nothing_is_lost():
    for size in (4, 8):
        share = wrong_far_out(VERDICT, [1e3, 1e9], size=size, first_from_a=True)
        assert np.all(share == 0.0)
    pairs = sphere_pairs(200, 1e5, seed=2)
    seen = seen_from_a(pairs)
    assert np.array_equal(VERDICT(*seen.arguments), pairs.overlap)
    assert np.all(seen.center_a == 0) and np.all(seen.radius_b == 0)


def test_stored_places_are_off_by_half_a_step_at_most():
    pairs = sphere_pairs(500, 1e7, seed=3)
    off = np.abs(stored(pairs, 4).center_a.astype(float) - pairs.center_a)
    assert 0.4 < off.max() <= 0.5 * spacing(1e7)


def test_reckoning_in_more_bytes_brings_nothing_back():
    pairs = stored(sphere_pairs(4000, 1e8, seed=4), 4)
    four, eight = (wrong_verdicts(VERDICT, p) for p in (pairs, stored(pairs, 8)))
    assert four == pytest.approx(eight, abs=0.002) and eight > 0.4


def test_bytes_and_errors_are_measured_for_every_way():
    pairs = sphere_pairs(3000, 1e6, seed=4, clear=1e-3)
    found = sphere_verdict_bytes(pairs)
    assert found.count.tolist() == [16, 32, 64, 8, 16, 32]
    as_they_are, from_a = found.error[:3], found.error[3:]
    assert as_they_are[1] > 10 * from_a[0] > 0 and as_they_are[2] == from_a[1] == 0
    seconds = sphere_verdict_seconds(pairs, peers=False)
    assert set(seconds.method) == {
        "without the root", "with the root", "seen from A first"
    }  # fmt: skip
    assert seconds.error[0] == as_they_are[1] and seconds.error[1] == 0
    assert np.array_equal(with_root(*pairs.arguments), pairs.overlap)


def test_tenths_touch_in_decimals_and_are_called_so_by_chance():
    pairs = tenths()
    decimal = [
        Decimal(f"{a:.1f}") + Decimal(f"{b:.1f}") - Decimal(f"{x:.1f}")
        for a, b, x in zip(pairs.radius_a, pairs.radius_b, pairs.center_b[:, 0], strict=True)
    ]  # fmt: skip
    assert len(pairs) == 2500 and not any(decimal)
    said = VERDICT(*pairs.arguments)
    assert 0 < np.sum(~said) < 1250
    assert with_margin(VERDICT, 1e-9)(*pairs.arguments).all()


def test_gaps_of_nearly_touching_spheres_are_right_to_the_last_digit():
    pairs = nearly_touching(40, seed=6)
    with localcontext() as context:
        context.prec = 60
        for k in range(40):
            apart = [
                Decimal(float(p)) - Decimal(float(q))
                for p, q in zip(pairs.center_a[k], pairs.center_b[k], strict=True)
            ]
            reach = Decimal(float(pairs.radius_a[k])) + Decimal(float(pairs.radius_b[k]))  # fmt: skip
            exact = sum(d * d for d in apart).sqrt() - reach
            assert pairs.gap[k] == pytest.approx(float(exact), rel=1e-9, abs=1e-25)


def test_beyond_eight_roundings_every_verdict_is_right():
    pairs = nearly_touching(3000, seed=7)
    relative = pairs.gap / (pairs.radius_a + pairs.radius_b)
    said = VERDICT(*pairs.arguments)
    decided = np.abs(relative) > DECIDED
    assert np.array_equal(said[decided], pairs.overlap[decided])
    assert np.any(said != pairs.overlap), "within them some are wrong"
    middle, share = called_touching(VERDICT, pairs, DECIDED * np.array([-2, -1, 1, 2]))
    assert share[0] == 1 and share[2] == 0 and 0 < share[1] < 1
    assert middle == pytest.approx(DECIDED * np.array([-1.5, 0, 1.5]))


@pytest.mark.peers
@pytest.mark.parametrize("name", ["python-fcl", "coal"])
def test_a_library_gives_the_same_verdicts(name):
    engines = installed_sphere_engines()
    if name not in engines:
        pytest.skip(f"{name} is not installed")
    pairs = sphere_pairs(300, 1e6, seed=8)
    assert np.array_equal(engines[name](*pairs.arguments), pairs.overlap)
