"""The exact motion of a handle in space: what it keeps, and when it turns over."""

import numpy as np
import pytest

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
