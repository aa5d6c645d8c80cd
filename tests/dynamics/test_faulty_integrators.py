"""The faults are exactly as large as predicted."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.dynamics import body_frame_euler, quaternion_euler

SEEDS = [0, 1, 2]


@pytest.mark.parametrize("seed", SEEDS)
def test_body_frame_euler_lengthens_the_angular_momentum(seed):
    """|l|^2 grows by h^2 |l x omega|^2 a step, as l x omega is across l."""
    rng = np.random.default_rng(seed)
    turn = Rotation.random(50, random_state=rng).as_matrix()
    second = rng.uniform(0.5, 1.5, (50, 1, 3))
    inertia = (turn * (second.sum(axis=-1, keepdims=True) - second)) @ np.swapaxes(
        turn, 1, 2
    )
    inertia = 0.5 * (inertia + np.swapaxes(inertia, 1, 2))
    momentum = rng.normal(size=(50, 3))
    for step in (0.3, 0.01):
        omega = np.array(
            [np.linalg.solve(i, m) for i, m in zip(inertia, momentum, strict=True)]
        )
        predicted = step**2 * np.sum(np.cross(momentum, omega) ** 2, axis=1)
        later = body_frame_euler(momentum, inertia, step)
        grown = np.sum(later**2, axis=1) - np.sum(momentum**2, axis=1)
        # What rounding leaves of a difference of squares near 1: within 1 percent where it exceeds that.
        assert np.all(np.abs(grown - predicted) < 0.01 * predicted + 1e-14)
        assert np.any(predicted > 1e-9)
        momentum = later


def test_body_frame_euler_by_hand():
    # l = (1, 2, 0) on moments (1, 2, 2.5): omega = (1, 1, 0), l x omega = (0, 0, -1); torque 4 about axis 1.
    later = body_frame_euler([1, 2, 0], np.diag([1.0, 2, 2.5]), 0.5, torque=[4, 0, 0])
    assert np.allclose(later, [3, 2, -0.5])


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("x", [0.01, 0.1, 1.0])
def test_quaternion_euler_lengthens_the_quaternion(seed, x):
    """|q|^2 times 1 + x^2/4 a step: omega q is across q."""
    rng = np.random.default_rng(seed)
    q, omega, steps = (
        Rotation.random(random_state=rng).as_quat(),
        rng.normal(size=3),
        50,
    )
    h = x / np.linalg.norm(omega)
    for _ in range(steps):
        q = quaternion_euler(q, omega, h)
    assert (q @ q) ** (1 / steps) - 1 == pytest.approx(x**2 / 4, rel=1e-2)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("x", [0.05, 0.3, 1.0, 2.5])
def test_renormalised_it_turns_too_little(seed, x):
    """By (2/x) atan(x/2) of the angle, about the right axis."""
    rng = np.random.default_rng(seed)
    start, omega = Rotation.random(random_state=rng), rng.normal(size=3)
    q = quaternion_euler(
        start.as_quat(), omega, x / np.linalg.norm(omega), renormalize=True
    )
    assert np.linalg.norm(q) == pytest.approx(1, abs=1e-15)
    turn = (Rotation.from_quat(q) * start.inv()).as_rotvec()
    assert np.allclose(np.cross(turn, omega), 0, atol=1e-13)
    assert 1 - np.linalg.norm(turn) / x == pytest.approx(
        1 - 2 / x * np.arctan(x / 2), rel=1e-2
    )
    if x < 0.1:
        assert 1 - np.linalg.norm(turn) / x == pytest.approx(x**2 / 12, rel=1e-2)


def test_batches_are_loops_and_inputs_are_not_written():
    rng = np.random.default_rng(0)
    q, omega, h = (
        rng.normal(size=(4, 1, 4)),
        rng.normal(size=(5, 3)),
        rng.uniform(0.1, 1, (4, 5)),
    )
    before = q.copy()
    table = quaternion_euler(q, omega, h)
    assert table.shape == (4, 5, 4) and np.array_equal(q, before)
    assert np.allclose(
        table[1, 2], quaternion_euler(q[1, 0], omega[2], h[1, 2]), rtol=1e-14
    )
    inertia = np.diag([1.0, 2, 3])
    momenta = body_frame_euler(omega, inertia, h)
    assert momenta.shape == (4, 5, 3)
    assert np.allclose(
        momenta[1, 2], body_frame_euler(omega[2], inertia, h[1, 2]), rtol=1e-14
    )


def test_bad_input_is_refused_by_name():
    with pytest.raises(
        ValueError,
        match=r"orientation: expected vectors of shape \(\.\.\., 4\); got shape \(3,\)",
    ):
        quaternion_euler([0, 0, 1], [1, 0, 0], 0.1)
    with pytest.raises(
        ValueError,
        match="orientation: expected quaternions of length above 0; got length 0.0",
    ):
        quaternion_euler([0, 0, 0, 0], [1, 0, 0], 0.1)
    with pytest.raises(ValueError, match="step: expected finite real numbers; got nan"):
        quaternion_euler([0, 0, 0, 1], [1, 0, 0], np.nan)
    with pytest.raises(
        ValueError, match="inertia: expected symmetric positive definite"
    ):
        body_frame_euler([1, 0, 0], np.zeros((3, 3)), 0.1)
    with pytest.raises(ValueError, match="torque: expected vectors"):
        body_frame_euler([1, 0, 0], np.eye(3), 0.1, torque=1.0)
