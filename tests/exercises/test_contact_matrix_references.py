"""The references of lesson 15 against the contact package, on drawn bodies and contacts."""

import numpy as np
import pytest

from course.contact.by_entries import contact_matrix_by_entries, point_response
from course.exercises.definition import find_exercise
from course.study import ladder
from course.study.contact_matrices import plain_arrays
from course.study.resting_scenes import random_scene, table, tangle


def reference(name):
    return find_exercise(name)[1].reference


def test_response_is_that_of_the_readable_form():
    rng = np.random.default_rng(8)
    root, (arm, push_arm, push) = rng.normal(size=(3, 3)), rng.normal(size=(3, 3))
    second = root @ root.T
    inverse = np.linalg.inv(np.trace(second) * np.eye(3) - second)
    expected = point_response(2.5, inverse, arm, push_arm, push)
    np.testing.assert_allclose(
        reference("point_response")(2.5, inverse, arm, push_arm, push),
        expected,
        atol=1e-13,
    )


@pytest.mark.parametrize(
    "scene",
    [table(), tangle(5, 12, np.random.default_rng(2)), random_scene(4, contacts=10)],
    ids=lambda s: s.name,
)
def test_matrix_is_that_of_the_contact_package(scene):
    expected, arrays = (
        contact_matrix_by_entries(scene.bodies, scene.contacts),
        plain_arrays(scene),
    )
    size = np.abs(expected).max()
    np.testing.assert_allclose(
        reference("contact_matrix")(*arrays), expected, atol=1e-13 * size
    )
    count = range(len(expected))
    found = [
        [reference("contact_matrix_entry")(i, j, *arrays) for j in count] for i in count
    ]
    np.testing.assert_allclose(found, expected, atol=1e-13 * size)


@pytest.mark.parametrize("degrees", [20.0, 60.0])
def test_the_ladders_entries_in_closed_form(degrees):
    """(1 + 3 cos^2)/m, (1 + 3 sin^2)/m and -3 sin cos/m, by hand."""
    theta = np.radians(degrees)
    a = ladder(theta, mass=7.0, length=3.0).system().A.toarray()
    coupling = reference("ladder_entry")(7.0, theta, 3.0)
    expected = [
        [(1 + 3 * np.cos(theta) ** 2) / 7, coupling],
        [coupling, (1 + 3 * np.sin(theta) ** 2) / 7],
    ]
    np.testing.assert_allclose(a, expected, atol=1e-15)
