"""Spheres against one another and against planes."""

import numpy as np
import pytest

from course.overlap import Spheres, sphere_contacts, sphere_plane_contacts


def test_contacts_of_balls():
    contacts = sphere_contacts([[0, 0, 0], [3.0, 0, 0], [0, 4.0, 0]], [1.0, 2.0, 3.0])
    # Centres 3, 4 and 5 apart, radii 1, 2 and 3: every pair touches.
    assert contacts.body_a.tolist() == [0, 0, 1] and contacts.body_b.tolist() == [
        1,
        2,
        2,
    ]
    assert np.allclose(
        contacts.normal, [[-1, 0, 0], [0, -1, 0], [0.6, -0.8, 0]]
    )  # out of B toward A
    assert np.allclose(contacts.point, [[1, 0, 0], [0, 1, 0], [1.8, 1.6, 0]])
    assert contacts.feature.tolist() == ["curved"] * 3
    assert np.allclose(contacts.curvature_b[1], np.diag([1 / 3, 0, 1 / 3]))
    apart = sphere_contacts([[0, 0, 0], [3.2, 0, 0]], [1.0, 2.0], margin=0.5)
    assert apart.separation[0] == pytest.approx(0.2) and np.allclose(
        apart.point, [[1.1, 0, 0]]
    )
    assert np.allclose(apart.point_a, [[1, 0, 0]]) and np.allclose(
        apart.point_b, [[1.2, 0, 0]]
    )
    assert len(sphere_contacts([[0, 0, 0], [3.2, 0, 0]], [1.0, 2.0])) == 0
    with pytest.raises(ValueError, match="center: expected centres apart"):
        sphere_contacts(np.zeros((2, 3)), 1.0)


def test_every_pair_within_the_margin_is_found():
    """Against all pairs, for radii that differ a hundredfold."""
    rng = np.random.default_rng(8)
    x, r = rng.uniform(0, 4, (200, 3)), 10.0 ** rng.uniform(-2, 0, 200)
    i, j = np.triu_indices(200, 1)
    gap = np.linalg.norm(x[i] - x[j], axis=1) - r[i] - r[j]
    near, found = gap <= 0.1, sphere_contacts(x, r, margin=0.1)
    assert 100 < near.sum() < near.size
    assert found.body_a.tolist() == i[near].tolist()
    assert found.body_b.tolist() == j[near].tolist()
    np.testing.assert_allclose(found.separation, gap[near], atol=1e-14)
    surface = x[found.body_a] - r[found.body_a, None] * found.normal
    np.testing.assert_allclose(found.point_a, surface, atol=1e-14)


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_spheres_have_no_contacts(count):
    assert len(sphere_contacts(np.zeros((count, 3)), np.ones(count))) == 0


def test_spheres_on_planes():
    """One in the corner of a floor and a wall that leans by 45 degrees, one over the floor, one away from both."""
    lean = np.array([1.0, 0, 1.0]) / np.sqrt(2)
    planes = [[0, 0, 1.0], lean], [0.5, -1.0]
    # On the floor at z = 1 and on the wall where lean.x = -0.5; radius 0.5.
    corner = [-1.0 - np.sqrt(0.5), 2.0, 1.0]
    centers = [corner, [3.0, 0, 1.2], [3.0, 0, 5.0]]
    found = sphere_plane_contacts(centers, 0.5, *planes, margin=0.25)
    assert found.body_a.tolist() == [0, 1, 0] and found.body_b.tolist() == [3, 3, 3]
    np.testing.assert_allclose(found.separation, [0, 0.2, 0], atol=1e-15)
    np.testing.assert_allclose(found.point_b[1], [3.0, 0, 0.5])
    np.testing.assert_allclose(found.point[2], corner - 0.5 * lean, atol=1e-15)
    np.testing.assert_allclose(found.curvature_a[0], np.diag([2.0, 2.0, 0]), atol=1e-15)
    assert not found.curvature_b.any()
    other = sphere_plane_contacts(centers, 0.5, *planes, margin=0.25, body_b=7)
    assert other.body_b.tolist() == [7, 7, 7]


def test_spheres_are_found_wherever_the_bodies_are():
    balls = Spheres(np.ones(2), np.array([[0, 0, 1.0]]), np.zeros(1))
    position = np.array([[0, 0, 1.0], [0, 0, 3.0], [0, 0, -1.0]])
    turned = np.stack([np.eye(3)] * 3)
    found = balls.contacts(position, turned)
    assert found.body_a.tolist() == [0, 0] and found.body_b.tolist() == [1, 2]
    raised = balls.contacts(position + [[0, 0, 0], [0, 0, 0.1], [0, 0, 0]], turned)
    assert raised.body_b.tolist() == [2]
