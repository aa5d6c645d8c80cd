"""Quaternions, scalar last: matrices, turning, the exponential map."""

import numpy as np
import pytest

from course import rotations


def unit(rng, *batch):
    q = rng.normal(size=(*batch, 4))
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def test_quarter_turn_about_z_takes_x_to_y():
    q = rotations.from_rotation_vector([0.0, 0.0, np.pi / 2])
    assert np.allclose(q, [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-15)
    assert np.allclose(rotations.rotate(q, [1.0, 0.0, 0.0]), [0, 1, 0], atol=1e-15)
    assert np.allclose(
        rotations.to_matrix(q)[:, 0], [0, 1, 0], atol=1e-15
    )  # a column is a body axis


def test_matrix_follows_from_the_quaternion_product():
    rng = np.random.default_rng(11)
    q, v = unit(rng, 4, 5), rng.normal(size=(5, 3))
    axis, w = q[..., :3], q[..., 3:]
    expected = v + 2 * np.cross(axis, np.cross(axis, v) + w * v)  # Rodrigues for q v q*
    assert np.allclose(rotations.rotate(q, v), expected, atol=1e-14)


def test_batch_equals_loop_and_empty_batches_pass():
    rng = np.random.default_rng(12)
    q, turn = unit(rng, 3, 1), rng.normal(size=(4, 3))
    batch = rotations.turned(q, turn)
    assert batch.shape == (3, 4, 4)
    for i in range(3):
        for j in range(4):
            assert np.allclose(
                batch[i, j], rotations.turned(q[i, 0], turn[j]), atol=1e-15
            )
    assert rotations.to_matrix(np.empty((0, 4))).shape == (0, 3, 3)
    assert rotations.from_matrix(np.empty((2, 0, 3, 3))).shape == (2, 0, 4)
    assert rotations.turned(np.empty((0, 4)), np.empty((0, 3))).shape == (0, 4)


def test_turned_applies_the_new_turn_last_in_world_axes():
    rng = np.random.default_rng(13)
    q, theta, v = unit(rng, 20), rng.normal(size=(20, 3)), rng.normal(size=(20, 3))
    after = rotations.rotate(rotations.turned(q, theta), v)
    assert np.allclose(
        after,
        rotations.rotate(rotations.from_rotation_vector(theta), rotations.rotate(q, v)),
    )


def test_exponential_map_is_exact_for_constant_spin_at_any_step():
    omega, q = np.array([0.3, -0.7, 1.1]), np.array([0.5, 0.5, -0.5, 0.5])
    small = q
    for _ in range(1000):
        small = rotations.turned(small, omega / 1000)
    assert np.allclose(small, rotations.turned(q, omega), atol=1e-13)
    assert abs(np.linalg.norm(small) - 1) < 1e-15


def test_matrix_there_and_back():
    rng = np.random.default_rng(14)
    q = unit(rng, 50)
    back = rotations.from_matrix(rotations.to_matrix(q))
    assert np.allclose(
        np.abs(np.sum(back * q, axis=-1)), 1
    )  # q and -q are the same turn


def test_refuses_what_is_no_orientation():
    with pytest.raises(
        ValueError,
        match=r"orientation: expected unit quaternions of shape \(\.\.\., 4\); got length 2",
    ):
        rotations.to_matrix([0.0, 0.0, 0.0, 2.0])
    with pytest.raises(ValueError, match="rotation: expected rotation matrices"):
        rotations.from_matrix(np.diag([1.0, 1.0, -1.0]))
    with pytest.raises(
        ValueError, match="vector: expected a batch that broadcasts with orientation"
    ):
        rotations.rotate(np.tile([0.0, 0.0, 0.0, 1.0], (2, 1)), np.zeros((3, 3)))


def test_identity_turns_nothing_and_can_be_written_to():
    q = rotations.identity(2)
    q[0] = 0
    assert np.array_equal(q[1], [0, 0, 0, 1])


def test_angles_between_are_exact_for_small_and_large_turns():
    axis = np.array([1.0, -2.0, 0.5]) / np.sqrt(5.25)
    start = rotations.to_matrix(rotations.from_rotation_vector([0.3, 1.1, -0.4]))
    for angle in (0.0, 1e-9, 1e-3, 1.0, 3.0, np.pi):
        turn = rotations.to_matrix(rotations.from_rotation_vector(angle * axis))
        found = rotations.angle_between(start @ turn, start)
        assert found == pytest.approx(angle, rel=1e-6, abs=1e-15)
    assert rotations.angle_between(np.stack([start] * 3), start).shape == (3,)
