"""Lesson 15 against the mass matrix of all bodies, exact fractions, motion, and closed
forms."""

import numpy as np
import pytest
from formulas.clouds import drawn_cloud

from course import formulas
from course.scenes import ladder, random_scene, table, tangle
from course.study import exact_matrix, measured_accelerations, plain_arrays

SCENES = pytest.mark.parametrize(
    "scene",
    [table(), tangle(5, 12, np.random.default_rng(2)), random_scene(4, contacts=10)],
    ids=lambda s: s.name,
)


def by_entries(arrays):
    c = range(len(arrays[0][0]))
    entry = formulas.contact_matrix_entry
    return np.array([[entry(i, j, *arrays) for j in c] for i in c])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_point_response_is_that_of_the_mass_matrix(seed):
    """(1, -[r_i]x) M^-1 (1, -[r_j]x)' F with the 6 by 6 mass matrix, solved."""
    rng = np.random.default_rng(seed)
    cloud, (arm, push_arm, push) = drawn_cloud(rng), rng.normal(size=(3, 3))
    mass = np.zeros((6, 6))
    mass[:3, :3], mass[3:, 3:] = cloud.mass * np.eye(3), cloud.inertia
    # (v, omega) -> v + omega x r
    ways = [np.hstack([np.eye(3), np.cross(np.eye(3), r).T]) for r in (arm, push_arm)]
    expected = ways[0] @ np.linalg.solve(mass, ways[1].T @ push)
    found = formulas.point_response(
        cloud.mass, np.linalg.inv(cloud.inertia), arm, push_arm, push
    )
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12)


def test_the_centre_of_percussion_stands_still():
    """A rod pushed across at one end turns about the point that lies ell/6 beyond its
    centre."""
    m, ell = 2.0, 3.0
    inverse = np.diag([0.0, 12 / (m * ell**2), 12 / (m * ell**2)])
    end, still = np.array([ell / 2, 0, 0]), np.array([-ell / 6, 0, 0])
    push = np.array([0.0, 0.0, 5.0])
    found = formulas.point_response(m, inverse, still, end, push)
    np.testing.assert_allclose(found, 0.0, atol=1e-14)


@SCENES
def test_matrix_and_entries_are_the_exact_ones(scene):
    """Against rational arithmetic, rounded once."""
    expected, arrays = exact_matrix(scene.bodies, scene.contacts), plain_arrays(scene)
    size = np.abs(expected).max()
    found = formulas.contact_matrix(*arrays)
    np.testing.assert_allclose(found, expected, atol=1e-12 * size)
    np.testing.assert_allclose(by_entries(arrays), expected, atol=1e-12 * size)
    assert np.linalg.eigvalsh(found)[0] > -1e-12 * size


def test_matrix_is_what_motion_says():
    """A f is the d_ddot measured with the forces less that without them; no formula of
    contacts in it."""
    scene = table()
    f = np.array([1.0, -2.0, 3.0, 0.5])
    pushed = measured_accelerations(scene, f)
    free = measured_accelerations(scene, np.zeros(4))
    found = formulas.contact_matrix(*plain_arrays(scene)) @ f
    np.testing.assert_allclose(found, pushed - free, atol=1e-7)


@pytest.mark.parametrize("degrees", [20.0, 60.0])
def test_the_ladders_entries_in_closed_form(degrees):
    """(1 + 3 cos^2)/m, (1 + 3 sin^2)/m and -3 sin cos/m, by hand."""
    theta = np.radians(degrees)
    scene = ladder(theta, mass=7.0, length=3.0)
    coupling = float(formulas.ladder_entry(7.0, theta, 3.0))
    expected = [
        [(1 + 3 * np.cos(theta) ** 2) / 7, coupling],
        [coupling, (1 + 3 * np.sin(theta) ** 2) / 7],
    ]
    for a in (scene.system().A.toarray(), by_entries(plain_arrays(scene))):
        np.testing.assert_allclose(a, expected, atol=1e-15)
