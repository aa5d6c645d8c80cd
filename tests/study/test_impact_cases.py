"""One impact at a time: what is conserved, closed forms, and the scenes that they are taken from."""

import numpy as np
import pytest

from course.scenes import falling_rods
from course.study import (
    central_impact,
    rod_landing,
    wall_reflection,
)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_central_impact_keeps_momentum_and_counts_energy(e):
    found = central_impact(2.0, 5.0, -3.0, 1.0, e)
    assert found.mass @ found.after == pytest.approx(found.mass @ found.before)
    assert np.subtract(*found.after) == pytest.approx(4 * e)  # it closed at 4 m/s
    change = 0.5 * found.mass @ (found.before**2 - found.after**2)
    assert found.lost == pytest.approx(change, abs=1e-14)
    apart = central_impact(2.0, 5.0, 3.0, 1.0, e)
    assert apart.impulse == apart.lost == 0 and np.array_equal(
        apart.after, apart.before
    )


def test_reflection_turns_the_normal_part_alone():
    found = wall_reflection(30.0, -70.0, 0.5)
    assert found.before @ found.normal == pytest.approx(-np.sin(np.radians(100)))
    assert found.after @ found.normal == pytest.approx(0.5 * np.sin(np.radians(100)))
    assert found.after @ found.along == pytest.approx(found.before @ found.along)


@pytest.mark.parametrize("place", [1.0, 0.3, 0.0, -1.0])
@pytest.mark.parametrize("e", [0.0, 0.7])
def test_rod_landing_is_the_closed_form(place, e):
    """With s = place cos angle: 1/mu = 1 + 3 s^2, and mu (1 - e^2)/2 of half a joule is lost."""
    found = rod_landing(40.0, e, place)
    impulse = float(falling_rods(np.radians(40.0), place=place).truth(e)[0])
    felt = 1 / (1 + 3 * (place * np.cos(np.radians(40.0))) ** 2)
    assert found.impulse == pytest.approx(impulse) and found.felt == pytest.approx(felt)
    assert found.kept == pytest.approx(1 - felt * (1 - e**2))
    hit = np.interp(place, [-1, 0, 1], found.after[:, 2])  # linear along the rod
    assert hit == pytest.approx(e) and found.after[1, 2] == pytest.approx(impulse - 1)
    np.testing.assert_array_equal(found.before, np.tile([0, 0, -1.0], (3, 1)))
    ends = found.after[2] - found.after[0]
    np.testing.assert_allclose(ends, np.cross([0, found.spin, 0], found.axis))
