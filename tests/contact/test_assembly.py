"""A and b: against their definition entry by entry, against motion, and what is refused."""

import numpy as np
import pytest
from contact.entry_by_entry import bias_by_entries, matrix_by_entries
from contact.moving_geometry import (
    EYE,
    KINDS,
    Flight,
    capsules,
    draw_numbers,
    drawn_inertias,
    sphere_capsule,
    sphere_sphere,
)
from scipy.sparse import csr_array

from course import rotations
from course.contact import (
    ContactSystem,
    contact_system,
    contact_wrench,
    resting,
    separation_acceleration,
    separation_rate,
)
from course.dynamics import Bodies
from course.overlap import Contacts

pytestmark = pytest.mark.slow  # with its like, left out of --quick

EVERY = {"rate_tolerance": np.inf}
ROUND = (sphere_sphere, sphere_capsule, capsules)


def soup(seed, bodies=6, contacts=25):
    """Bodies anywhere, some of them fixed, with contacts of every feature between them."""
    rng = np.random.default_rng(seed)
    inertia = drawn_inertias(rng, bodies)
    fixed = np.arange(bodies) < 2
    momentum, spin = np.where(fixed[:, None], 0, rng.normal(size=(2, bodies, 3)))
    quaternion = rng.normal(size=(bodies, 4))
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    mass = np.where(fixed, np.inf, 10.0 ** rng.uniform(-2, 2, bodies))
    made = Bodies(
        mass, inertia, rng.normal(size=(bodies, 3)), quaternion, momentum, spin
    )
    a = rng.integers(bodies, size=contacts)
    b = (a + rng.integers(1, bodies, size=contacts)) % bodies
    kept = ~(fixed[a] & fixed[b])
    normal, edge_a, edge_b = rng.normal(size=(3, contacts, 3))
    feature = rng.choice(["face_b", "face_a", "edges", "curved"], contacts)
    normal = np.where((feature == "edges")[:, None], np.cross(edge_a, edge_b), normal)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    k = rng.normal(size=(2, contacts, 3, 3))
    k = k @ np.swapaxes(k, 2, 3)
    gap = np.where(feature == "curved", 0.0, 0.1 * rng.normal(size=contacts))
    every = Contacts(
        a,
        b,
        rng.normal(size=(contacts, 3)),
        normal,
        gap,
        feature,
        edge_a,
        edge_b,
        k[0],
        k[1],
    )
    return made, every[kept], rng.normal(size=(bodies, 3)), rng.normal(size=(bodies, 3))


FEET = ((0.5, 0.3), (-0.5, 0.3), (-0.5, -0.3), (0.5, -0.3))


def on_the_floor(velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0), feet=FEET):
    """A table on fixed ground, its centre of mass 0.7 above it."""
    momentum, angular = (
        [2 * np.array(velocity), np.zeros(3)],
        [np.array(spin), np.zeros(3)],
    )
    inertia, position = (
        np.stack([np.diag([1.0, 2.0, 3.0]), EYE]),
        [[0, 0, 0.7], [0, 0, -1.0]],
    )
    bodies = Bodies(
        [2.0, np.inf], inertia, position, rotations.identity(2), momentum, angular
    )
    count = len(feet)
    point = np.concatenate([np.array(feet), np.zeros((count, 1))], axis=1)
    contacts = Contacts(
        np.zeros(count, int),
        np.ones(count, int),
        point,
        np.tile([0, 0, 1.0], (count, 1)),
        np.zeros(count),
    )
    weight = np.array([[0, 0, -2 * 9.81], [0, 0, 0]])
    return bodies, contacts, weight, np.zeros((2, 3))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_agrees_with_its_definition_entry_by_entry(seed):
    bodies, contacts, force, torque = soup(seed)
    system = contact_system(bodies, contacts, force, torque, **EVERY)
    slow_a, slow_b = (
        matrix_by_entries(bodies, contacts),
        bias_by_entries(bodies, contacts, force, torque),
    )
    np.testing.assert_allclose(
        system.A.toarray(), slow_a, rtol=0, atol=1e-13 * np.abs(slow_a).max()
    )
    np.testing.assert_allclose(
        system.b, slow_b, rtol=0, atol=1e-12 * np.abs(slow_b).max()
    )
    assert np.array_equal(
        system.b, separation_acceleration(bodies, contacts, force, torque)
    )


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_is_symmetric_and_positive_semidefinite_and_made_of_its_parts(seed):
    bodies, contacts, force, torque = soup(
        seed, contacts=60
    )  # more contacts than bodies can tell apart: rank < c
    system = contact_system(bodies, contacts, force, torque, **EVERY)
    a = system.A.toarray()
    assert np.array_equal(a, a.T)
    values = np.linalg.eigvalsh(a)
    assert len(system) > 6 * 4 and np.sum(values > 1e-12 * values[-1]) == 6 * 4
    assert values[0] > -1e-13 * values[-1]
    product = (system.jacobian @ system.inverse_mass @ system.jacobian.T).toarray()
    np.testing.assert_allclose(a, product, rtol=0, atol=1e-14 * values[-1])
    velocity = np.concatenate(
        [bodies.velocity, bodies.angular_velocity], axis=1
    ).ravel()
    np.testing.assert_allclose(
        system.jacobian @ velocity, separation_rate(bodies, contacts), atol=1e-12
    )


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_predicts_the_accelerations_of_a_real_step(seed):
    """b + A f is the second difference of every gap while the bodies fly under the contact forces f.

    To 1e-8 m/s^2, and 1e-9 of it where it is large: differences of gaps of up to 10 m, rounded at 1e-15 m, over
    5e-4 s show no more.
    """
    rng = np.random.default_rng(seed)
    flight = Flight(rng, 4)
    flight.start[:12] *= 3
    pairs = [(a, b) for a in range(4) for b in range(4) if a != b][: len(KINDS)]
    numbers = [draw_numbers(rng) for _ in KINDS]
    for k, (kind, pair) in enumerate(zip(KINDS, pairs, strict=True)):
        while (
            kind in ROUND
            and flight.touch(kind, numbers[k], flight.start, *pair).gap < -0.3
        ):
            numbers[k] = draw_numbers(rng)  # deeper than their radii: refused

    def touches(state):
        return [
            flight.touch(k, g, state, a, b)
            for k, g, (a, b) in zip(KINDS, numbers, pairs, strict=True)
        ]

    start = flight.bodies(flight.start)
    contacts = Contacts.concatenate(
        [
            t.contacts(a, b)
            for t, (a, b) in zip(touches(flight.start), pairs, strict=True)
        ]
    )
    external, f = flight.wrench(0), rng.uniform(0, 0.5, len(contacts))
    system = contact_system(start, contacts, *external, **EVERY)
    pushed = contact_wrench(start, contacts, f)
    flight.wrench = lambda t: (external[0] + pushed[0], external[1] + pushed[1])
    predicted, off = system.A @ f + system.b, np.full(len(contacts), np.inf)
    for h in (
        2e-3,
        1e-3,
        5e-4,
    ):  # the error grows as h^4 where a gap changes fast, and as 1/h^2 by rounding
        d = np.array(
            [[t.gap for t in touches(flight.at(k * h))] for k in (-2, -1, 0, 1, 2)]
        )
        measured = (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * h * h)
        off = np.minimum(off, np.abs(measured - predicted))
    assert np.all(off < 1e-8 + 1e-9 * np.abs(predicted))
    acceleration = system.free_acceleration + system.inverse_mass @ (
        system.jacobian.T @ f
    )
    linear = start.inverse_mass[:, None] * (external[0] + pushed[0])
    np.testing.assert_allclose(
        acceleration.reshape(4, 6)[:, :3], linear, rtol=0, atol=1e-13
    )


def test_table_on_the_floor_by_hand():
    """Feet at (+-.5, +-.3), m = 2, I = diag(1, 2, 3): a_ij = 1/m + y_i y_j/I_x + x_i x_j/I_y, b = -g."""
    system = contact_system(*on_the_floor())
    x, y = np.array([0.5, -0.5, -0.5, 0.5]), np.array([0.3, 0.3, -0.3, -0.3])
    np.testing.assert_allclose(
        system.A.toarray(), 0.5 + np.outer(y, y) + np.outer(x, x) / 2, atol=1e-15
    )
    np.testing.assert_allclose(system.b, -9.81, atol=1e-14)
    assert np.linalg.matrix_rank(system.A.toarray()) == 3


def test_the_contact_force_on_a_fixed_body_is_what_it_carries():
    bodies, contacts, *_ = on_the_floor()
    force, torque = contact_wrench(bodies, contacts, [1.0, 2, 3, 4])
    np.testing.assert_allclose(force, [[0, 0, 10], [0, 0, -10]])
    np.testing.assert_allclose(
        torque[0], [0.3 * (1 + 2 - 3 - 4), -0.5 * (1 - 2 - 3 + 4), 0], atol=1e-15
    )


def test_contacts_that_move_are_refused_with_advice():
    with pytest.raises(
        ValueError,
        match=r"contacts.*d_dot = -0.5 m/s.*approaches.*resolve the collision first",
    ):
        contact_system(*on_the_floor(velocity=(1.0, 0, -0.5)))
    bodies, contacts, *wrench = on_the_floor(
        spin=(0.2, 0, 0)
    )  # two feet lift, two go down
    with pytest.raises(ValueError, match="2 in all: a contact that approaches"):
        contact_system(bodies, contacts, *wrench)
    with pytest.raises(
        ValueError,
        match=r"a contact that parts.*contacts\[resting\(bodies, contacts\)\]",
    ):
        contact_system(bodies, contacts[[0, 1]], *wrench)
    assert (
        len(contact_system(bodies, contacts[resting(bodies, contacts)], *wrench)) == 0
    )
    assert len(contact_system(*on_the_floor(velocity=(3.0, 2.0, 1e-7)))) == 4
    with pytest.raises(ValueError, match="rate_tolerance"):
        contact_system(bodies, contacts, *wrench, rate_tolerance=-1)


def test_two_fixed_bodies_are_refused():
    bodies = Bodies(
        [np.inf, np.inf],
        np.stack([EYE, EYE]),
        np.zeros((2, 3)),
        rotations.identity(2),
        np.zeros((2, 3)),
        np.zeros((2, 3)),
    )
    contacts = Contacts(
        np.array([0]),
        np.array([1]),
        np.zeros((1, 3)),
        np.array([[0, 0, 1.0]]),
        np.zeros(1),
    )
    with pytest.raises(ValueError, match="both fixed"):
        contact_system(bodies, contacts, np.zeros((2, 3)), np.zeros((2, 3)))


def test_no_contacts_and_wrong_shapes():
    bodies, contacts, force, torque = on_the_floor()
    empty = contact_system(bodies, contacts[[]], force, torque)
    assert (
        empty.A.shape == (0, 0)
        and empty.b.shape == (0,)
        and empty.jacobian.shape == (0, 12)
    )
    with pytest.raises(ValueError, match="force"):
        contact_system(bodies, contacts, force[:1], torque)
    with pytest.raises(ValueError, match="contacts.body_b"):
        contact_system(
            Bodies.balls(1.0, 1.0, np.zeros((1, 3))), contacts, force[:1], torque[:1]
        )


def test_rounding_noise_in_b_is_zero():
    """A wheel that is let go falls with the ground that falls as well: b is 0, not 1e-16."""
    tilt = rotations.from_rotation_vector([0.3, 0.2, 0.1])
    n = rotations.rotate(tilt, [0, 0, 1.0])
    bodies = Bodies([0.1, 0.7], np.stack([0.3 * EYE, 0.3 * EYE]), [0.3 * n, -n], [tilt, tilt], np.zeros((2, 3)),
                    [[0.1, 0.2, 0.3], [0, 0, 0]])  # fmt: skip
    flat = np.zeros((1, 3, 3))
    ball = Contacts(np.array([0]), np.array([1]), np.zeros((1, 3)), n[None], np.zeros(1), np.array(["curved"]),
                    curvature_a=EYE[None] / 0.3, curvature_b=flat)  # fmt: skip
    force = bodies.mass[:, None] * np.array([0.1, 0.7, -9.81])
    raw = separation_acceleration(bodies, ball, force, np.zeros((2, 3)))
    system = contact_system(bodies, ball, force, np.zeros((2, 3)))
    assert raw[0] != 0 and abs(raw[0]) < 1e-14, (
        "the case shows nothing if no noise comes up"
    )
    assert system.b[0] == 0
    assert system.jacobian.nnz == 6, "r x N of a ball is noise: only N and -N stay"


def test_a_system_of_wrong_parts_is_refused():
    a = np.array([[2.0, 1], [1, 2]])
    assert len(ContactSystem(a, np.zeros(2))) == 2
    assert np.array_equal(ContactSystem(csr_array(a), np.zeros(2)).diagonal, [2, 2])
    for matrix, b, match in (
        (np.array([[2.0, 1], [0, 2]]), np.zeros(2), "A.*symmetric"),
        (csr_array([[2.0, 1], [0, 2]]), np.zeros(2), "A.*symmetric"),
        (-a, np.zeros(2), "A.*semidefinite"),
        (a, np.zeros(3), "A.*shape"),
        (a, np.array([0, np.nan]), "b.*finite"),
        (a * np.inf, np.zeros(2), "A.*finite"),
        (csr_array(a), np.zeros((5, 2)), "b.*sparse"),
    ):
        with pytest.raises(ValueError, match=match):
            ContactSystem(matrix, b)
    with pytest.raises(ValueError, match="together"):
        ContactSystem(a, np.zeros(2), jacobian=csr_array((2, 6)))
    with pytest.raises(ValueError, match="inverse_mass.*shape"):
        ContactSystem(
            a, np.zeros(2), csr_array((2, 6)), csr_array((12, 12)), np.zeros(6)
        )
