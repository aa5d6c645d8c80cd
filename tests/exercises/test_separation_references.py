"""The references of lessons 13 and 14 against the contact package, on drawn bodies and contacts."""

import numpy as np
import pytest

from course.contact import normal_rate, separation_acceleration, separation_rate
from course.contact.by_entries import angular_acceleration_free, free_point_acceleration
from course.exercises.definition import find_exercise
from course.study import ladder, moving_contact


def reference(name):
    return find_exercise(name)[1].reference


def state(bodies, index):
    return (
        bodies.position[index],
        bodies.velocity[index],
        bodies.angular_velocity[index],
    )


def motion(scene, index):
    bodies = scene.bodies
    omega_dot = reference("angular_acceleration_free")(
        bodies.world_inverse_inertia,
        bodies.angular_momentum,
        bodies.angular_velocity,
        scene.torque,
    )
    v_dot = scene.force * bodies.inverse_mass[:, None]
    return (*state(bodies, index), v_dot[index], omega_dot[index])


@pytest.mark.parametrize("kind", ["face_b", "face_a"])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_rates_are_those_of_the_contact_package(kind, seed):
    scene = moving_contact(kind, seed=seed, gap=0.2)
    contacts, bodies = scene.contacts(scene.bodies), scene.bodies
    n, body_a, body_b = contacts.normal, state(bodies, [0]), state(bodies, [1])
    n_dot = reference("normal_rate")(n, body_a[2], body_b[2], kind)
    np.testing.assert_allclose(n_dot, normal_rate(bodies, contacts), atol=1e-14)
    rate = reference("separation_rate")(
        contacts.point_a, contacts.point_b, body_a, body_b, n, n_dot
    )
    np.testing.assert_allclose(rate, separation_rate(bodies, contacts), atol=1e-13)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_edge_normal_rate_is_that_of_the_contact_package(seed):
    scene = moving_contact("edges", seed=seed, gap=0.2)
    contacts, (_, _, omega) = (
        scene.contacts(scene.bodies),
        state(scene.bodies, slice(None)),
    )
    e_a, e_b = contacts.edge_a[0], contacts.edge_b[0]
    found = reference("edge_normal_rate")(
        e_a, e_b, omega[0], omega[1], contacts.normal[0]
    )
    np.testing.assert_allclose(
        found, normal_rate(scene.bodies, contacts)[0], atol=1e-13
    )


@pytest.mark.parametrize("kind", ["face_b", "face_a"])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_bias_is_that_of_the_contact_package(kind, seed):
    scene = moving_contact(kind, seed=seed)
    contacts = scene.contacts(scene.bodies)
    given = (
        contacts.point,
        contacts.normal,
        kind,
        motion(scene, contacts.body_a),
        motion(scene, contacts.body_b),
    )
    expected = separation_acceleration(
        scene.bodies, contacts, scene.force, scene.torque
    )
    np.testing.assert_allclose(reference("contact_bias")(*given), expected, atol=1e-12)


def test_ladder_by_sympy_and_by_points():
    """The student's derivative, with the accelerations of free fall, is b of the ladder's top."""
    scene = ladder(0.9, rate=-0.7, length=3.0)
    contacts = scene.contacts
    given = (
        contacts.point,
        contacts.normal,
        "face_b",
        motion(scene, contacts.body_a),
        motion(scene, contacts.body_b),
    )
    b = reference("contact_bias")(*given)
    assert b[1] == pytest.approx(
        reference("top_acceleration")(0.0, 0.0, -0.7, 0.9, 3.0), abs=1e-14
    )
    assert b[0] == pytest.approx(-9.81 + 1.5 * 0.49 * np.sin(0.9), abs=1e-14)
    v_y = scene.bodies.velocity[0, 1]
    assert reference("top_rate")(v_y, -0.7, 0.9, 3.0) == pytest.approx(0, abs=1e-14)


def test_point_and_spin_are_those_of_the_readable_form():
    rng = np.random.default_rng(6)
    inverse, (l_, w, tau, v_dot, w_dot, r) = (
        np.diag(rng.uniform(1, 2, 3)),
        rng.normal(size=(6, 3)),
    )
    np.testing.assert_allclose(
        reference("angular_acceleration_free")(inverse, l_, w, tau),
        angular_acceleration_free(inverse, l_, w, tau),
    )
    np.testing.assert_allclose(
        reference("free_point_acceleration")(v_dot, w_dot, w, r),
        free_point_acceleration(v_dot, w_dot, w, r),
    )
