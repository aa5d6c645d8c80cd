"""One gap at a time: on a dome, between bar and plank, past a corner."""

import numpy as np
import pytest

from course.contact import separation_rate
from course.dynamics import Dome
from course.scenes import bar_over_plank
from course.study import (
    corner_passing,
    gap_rate,
    old_point,
    pair_states,
)


def test_old_point_is_the_dome():
    found, dome = old_point(42.0, 0.08), Dome()
    theta = np.radians(42.0)
    assert found.gap == dome.gap(theta, 0.08)
    assert found.from_old_point == pytest.approx(
        (found.path[-1] - found.path[0]) @ found.normal
    )
    assert found.bias == pytest.approx(2 * 9.81 - 3 * 9.81 * np.cos(theta))
    assert found.speed == pytest.approx(np.sqrt(2 * 9.81 * (1 - np.cos(theta))))


def test_gap_rate_is_the_sum_of_its_parts():
    turning = bar_over_plank(-0.7, 0.9, reach=1.3, clear=0.7)
    found = gap_rate(-0.7, 0.9, 0.2, -0.4, reach=1.3)
    expected = separation_rate(turning.bodies, turning.contacts)[0] + 0.6
    assert found.total == pytest.approx(expected) and found.parts["B rises"] == 0.4
    between = found.velocity[0] - found.velocity[1]
    assert between[2] == pytest.approx(expected)


def test_states_of_a_pair_are_those_of_its_motion():
    pair, times = bar_over_plank(), (0.0, 0.1, 0.14)
    found = pair_states(pair, times)
    assert found.gaps == tuple(pair.gap(t) for t in times) and found.times == times
    for time, bodies in zip(times, found.bodies, strict=True):
        turned = 2 * np.arctan2(bodies.orientation[:, 0], bodies.orientation[:, 3])
        np.testing.assert_allclose(turned, [1.5 * time, 0.5 * time], atol=1e-14)
    normal = found.bodies[-1].rotation[1, :, 2]
    assert (found.point_a - found.point_b) @ normal == pytest.approx(found.gaps[-1])
    with pytest.raises(ValueError, match="times: expected at least one"):
        pair_states(pair, ())


def test_the_normal_at_a_corner_leaves_it_by_the_shortest_way():
    found = corner_passing((0.3, 0.03), speed=2.0, step=0.05)
    np.testing.assert_allclose(found.y, np.arange(-4, 7) / 10)
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=-1), 1)
    # Over the box straight up; past its corner the direction from the corner.
    np.testing.assert_array_equal(found.normal[:, :5], np.tile([0.0, 1.0], (2, 5, 1)))
    angle = np.arctan2(found.normal[..., 0], found.normal[..., 1])
    past = np.arctan2(found.y[5:], found.heights[:, None])
    np.testing.assert_allclose(angle[:, 5:], past)
    # The box as a cloud of points: none is nearer than the foot of the normal.
    grid = np.linspace(-1, 0, 101)
    cloud = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
    for z, normals in zip(found.heights, found.normal, strict=True):
        for y, normal in zip(found.y, normals, strict=True):
            away = np.array([y, z]) - cloud
            nearest = away[np.argmin(np.linalg.norm(away, axis=1))]
            assert normal @ nearest == pytest.approx(np.linalg.norm(nearest), abs=1e-3)
    with pytest.raises(ValueError, match="heights"):
        corner_passing((0.3, -0.1))
