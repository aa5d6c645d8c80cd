"""The exact motion of a handle in space: what it keeps, and when it turns over."""

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from course.dynamics import (
    free_tumble,
    middle_axis_growth_rate,
)
from course.scenes import handle_mass_properties, spinning_handle

SIZE = lambda v: np.linalg.norm(v, axis=-1)  # noqa: E731


def test_L_and_energy_stay_and_it_turns_over():
    motion = free_tumble(spinning_handle().bodies, np.linspace(0, 8, 401))
    energy = motion.turning_energy.sum(axis=1)
    assert energy == pytest.approx(energy[0], rel=1e-12)
    world = np.einsum("tij,tj->ti", motion.rotation * motion.moments, np.einsum("tji,tj->ti", motion.rotation,
                                                                                motion.angular_velocity))  # fmt: skip
    np.testing.assert_allclose(
        world, np.broadcast_to(motion.angular_momentum, (401, 3)), atol=1e-15
    )
    assert motion.seen_from_body[:, 1].min() < -0.99 * SIZE(motion.angular_momentum)


@pytest.mark.slow
def test_turning_over_is_found_between_the_samples():
    """Twenty times as many samples find the same times; between two of them lies half a period of the motion."""
    few, many = (
        free_tumble(spinning_handle().bodies, np.linspace(0, 8, n)).turnover_times()
        for n in (401, 8001)
    )
    assert len(few) == 3 and few == pytest.approx(many, abs=1e-5)
    assert np.diff(few) == pytest.approx(np.diff(few)[0], abs=1e-4)
    assert (
        free_tumble(spinning_handle(axis=2).bodies, np.linspace(0, 8, 401))
        .turnover_times(axis=2)
        .size
        == 0
    )


def test_ten_times_the_care_is_a_fixed_time_more():
    """ln(10)/sigma, from the growth rate of the linear equations."""
    solid = handle_mass_properties()
    sigma = middle_axis_growth_rate(np.diag(solid.inertia), 6.0)
    times = np.linspace(0, 5, 2001)
    first = [
        free_tumble(spinning_handle(tilt=np.radians(d)).bodies, times).turnover_times()[
            0
        ]
        for d in (1, 0.1, 0.01)
    ]
    assert np.diff(first) == pytest.approx(np.log(10) / sigma, rel=1e-3)


def test_the_view_from_the_body_is_a_direction():
    motion = free_tumble(spinning_handle().bodies, np.linspace(0, 8, 401))
    view = motion.body_view()
    np.testing.assert_allclose(SIZE(view.direction), 1)
    world = np.einsum("tij,tj->ti", motion.rotation, view.direction)
    np.testing.assert_allclose(world, np.tile(world[0], (401, 1)), atol=1e-12)
    assert view.turnovers == pytest.approx(motion.turnover_times())
    at = [np.interp(t, view.times, view.direction[:, 1]) for t in view.turnovers]
    assert at == pytest.approx(np.zeros(3), abs=1e-3)
    assert motion.body_view(axis=2).turnovers.size == 0


def test_lines_of_equal_energy_are_those_of_the_motion():
    motion = free_tumble(spinning_handle().bodies, np.linspace(0, 8, 41))
    lines = motion.energy_lines(points=201, levels=5)
    least, most = 1 / motion.moments[2], 1 / motion.moments[0]
    assert np.nanmin(lines.energy) == pytest.approx(least)
    assert np.nanmax(lines.energy) == pytest.approx(most)
    assert len(lines.levels) == 5 and least < lines.levels[0] < lines.levels[-1] < most
    # On its way l stays on one level, that of its energy, seen along any axis.
    momentum = motion.angular_momentum
    level = 2 * motion.turning_energy.sum(axis=1)[0] / (momentum @ momentum)
    for k in range(3):
        y, x = lines.direction[:, (k + 2) % 3], lines.direction[:, (k + 1) % 3]
        within = x**2 + y**2 < 0.95
        seen = RegularGridInterpolator((lines.grid, lines.grid), lines.energy[k])
        found = seen(np.stack([y, x], axis=-1)[within])
        assert len(found) > 2
        assert found == pytest.approx(np.full(len(found), level), abs=2e-4 * most)
    outside = lines.grid[:, None] ** 2 + lines.grid**2 > 1 + 1e-9
    assert np.isnan(lines.energy[:, outside]).all()
