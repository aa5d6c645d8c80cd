"""The library checks its arguments and gives what the formulas give, or has a faster
form that agrees with them."""

import numpy as np
import pytest
from contact.entry_by_entry import plain
from formulas.clouds import unit
from scenes.parts import bodies_and_contacts
from scipy.spatial.transform import Rotation

from course import contact, dynamics, formulas, overlap, rotations
from course.contact.solvers import complementarity_residual
from course.contact.solvers.pivot import solve_pivot
from course.contact.solvers.projected_gauss_seidel import solve_projected_gauss_seidel
from course.contact.solvers.qp import solve_qp
from course.overlap import Contacts
from course.scenes import (
    falling_rods,
    ladder,
    moving_contact,
    random_scene,
    stack,
    table,
    tangle,
)

SEEDS = pytest.mark.parametrize("seed", [1, 2, 3])


def drawn_impacts(seed, count=40):
    """masses, velocities, normal, e; some part, some meet a fixed body."""
    rng = np.random.default_rng(seed)
    masses = rng.uniform(0.5, 3, (2, count))
    masses[1, :5] = np.inf
    v, n = rng.normal(size=(2, count, 3)), unit(rng.normal(size=(count, 3)))
    return *masses, *v, n, rng.uniform(0, 1, count)


@SEEDS
def test_impulses_of_bodies_that_do_not_turn(seed):
    m_1, m_2, v_1, v_2, n, e = given = drawn_impacts(seed)
    for name in ("impulse_central", "kinetic_energy_lost"):
        mine, theirs = (getattr(m, name)(*given) for m in (formulas, dynamics))
        np.testing.assert_allclose(mine, theirs, rtol=1e-13, atol=1e-15)
    given = v_1, v_2, n, m_1
    for name, arguments in (
        ("momentum_after", given[:2] + (m_1, n)),
        ("separation_speed", (v_1, v_2, n, e)),
        ("wall_bounce", (v_1, n, e)),
        ("linear_kinetic_energy", (v_1, v_2)),
        ("angular_kinetic_energy", (v_1, v_2)),
        ("point_velocity", (v_1, v_2, n)),
        ("bounce_times", (m_1, e, 7, 9.81)),
    ):
        mine, theirs = (getattr(m, name)(*arguments) for m in (formulas, dynamics))
        np.testing.assert_allclose(mine, theirs, rtol=1e-14, err_msg=name)
    np.testing.assert_array_equal(
        formulas.separation(v_1, v_2, n), contact.separation(v_1, v_2, n)
    )
    rest = [float(formulas.rest_time(h, x, 9.81)) for h, x in zip(m_1, e, strict=True)]
    np.testing.assert_allclose(rest, dynamics.bounce_rest_time(m_1, e), rtol=1e-13)


@pytest.fixture
def pairs():
    """Twenty pairs of turning bodies with one contact each, in some of them body 2
    fixed."""
    rng, n = np.random.default_rng(121), 20
    mass = rng.uniform(0.5, 3.0, 2 * n)
    mass[n : n + 5] = np.inf
    free = np.isfinite(mass)[:, None]
    inertia = np.array([np.diag(rng.uniform(1, 1.9, 3)) for _ in mass])
    momentum, angular = rng.normal(size=(2, 2 * n, 3)) * free
    orientation = Rotation.random(2 * n, random_state=rng).as_quat()
    bodies = dynamics.Bodies(
        mass, inertia, rng.normal(size=(2 * n, 3)), orientation, momentum, angular
    )
    normal = unit(rng.normal(size=(n, 3)))
    point = rng.normal(size=(n, 3))
    contacts = Contacts(np.arange(n), np.arange(n) + n, point, normal, np.zeros(n))
    return bodies, contacts, (slice(n), slice(n, None))


def test_impulses_of_bodies_that_turn(pairs):
    bodies, contacts, sides = pairs
    arms = [contacts.point - bodies.position[s] for s in sides]
    points = [
        formulas.point_velocity(bodies.velocity[s], bodies.angular_velocity[s], r)
        for s, r in zip(sides, arms, strict=True)
    ]
    mu = formulas.effective_mass(
        *(bodies.inverse_mass[s] for s in sides),
        *(bodies.world_inverse_inertia[s] for s in sides),
        *arms,
        contacts.normal,
    )
    np.testing.assert_allclose(
        mu, dynamics.effective_mass(bodies, contacts), rtol=1e-13
    )
    for e in (0.0, 0.4, 1.0):
        mine = formulas.impulse_at_point(*points, contacts.normal, mu, e)
        theirs = dynamics.impulse_at_point(bodies, contacts, e)
        np.testing.assert_allclose(mine, theirs, rtol=1e-12, atol=1e-14)
    push = np.random.default_rng(5).uniform(0.5, 2.0, len(contacts))
    after = dynamics.apply_impulse(bodies, contacts, push)
    for s, arm, sign in zip(sides, arms, (1.0, -1.0), strict=True):
        velocity, turning = formulas.apply_impulse(
            bodies.velocity[s], bodies.angular_velocity[s], bodies.inverse_mass[s],
            bodies.world_inverse_inertia[s], arm, contacts.normal, sign * push,
        )  # fmt: skip
        np.testing.assert_allclose(velocity, after.velocity[s], atol=1e-13)
        np.testing.assert_allclose(turning, after.angular_velocity[s], atol=1e-13)


def test_rod_impulse_is_what_a_rod_gets():
    angle = np.linspace(0, 1.5, 6)
    rods, floor = bodies_and_contacts(
        falling_rods(angle, mass=2.0, length=3.0, speed=1.5)
    )
    mine = [float(formulas.rod_impulse(2.0, 1.5, a, 0.3, 3.0)) for a in angle]
    theirs = dynamics.impulse_at_point(rods, floor, 0.3)
    np.testing.assert_allclose(mine, theirs, rtol=1e-13)


@SEEDS
def test_steps_and_turns(seed):
    rng = np.random.default_rng(seed)
    R, (L, force, torque, x, p) = Rotation.random(rng=rng), rng.normal(size=(5, 3))
    second = rng.uniform(0.5, 1.5, 3)
    inertia, h = np.diag(second.sum() - second), 0.1
    bodies = dynamics.Bodies([2.0], [inertia], [x], [R.as_quat()], [p], [L])
    world = formulas.world_inertia(R.as_matrix(), inertia)
    np.testing.assert_allclose(world, bodies.world_inertia[0], rtol=1e-13)
    after = dynamics.symplectic_euler(bodies, lambda *_: (force[None], torque[None]), h)
    given = x, R.as_matrix(), p, L, 2.0, inertia, force, torque, h
    mine = formulas.symplectic_euler_step(*given)
    theirs = after.position, after.rotation, after.momentum, after.angular_momentum
    for one, other in zip(mine, theirs, strict=True):
        np.testing.assert_allclose(one, other[0], atol=1e-14)
    turned = rotations.rotate(rotations.from_rotation_vector(L), x)
    np.testing.assert_allclose(formulas.rotate(x, L), turned, atol=1e-14)
    sigma = float(formulas.sigma(1.0, 2.0, 3.5, 4.0))
    growth = dynamics.middle_axis_growth_rate([1.0, 2.0, 3.5], 4.0)
    assert sigma == pytest.approx(float(growth), rel=1e-14)


def state(bodies, index):
    return (
        bodies.position[index],
        bodies.velocity[index],
        bodies.angular_velocity[index],
    )


def motion(scene, index):
    bodies = scene.bodies
    omega_dot = formulas.angular_acceleration_free(
        bodies.world_inverse_inertia,
        bodies.angular_momentum,
        bodies.angular_velocity,
        scene.torque,
    )
    v_dot = scene.force * bodies.inverse_mass[:, None]
    return (*state(bodies, index), v_dot[index], omega_dot[index])


@SEEDS
@pytest.mark.parametrize("kind", ["face_b", "face_a"])
def test_rates_and_bias_of_faces(kind, seed):
    scene = moving_contact(kind, seed=seed, gap=0.2)
    contacts, bodies = scene.contacts, scene.bodies
    n, body_a, body_b = contacts.normal, state(bodies, [0]), state(bodies, [1])
    n_dot = formulas.normal_rate(n, body_a[2], body_b[2], kind)
    np.testing.assert_allclose(n_dot, contact.normal_rate(bodies, contacts), atol=1e-14)
    points = contacts.point_a, contacts.point_b
    mine = formulas.separation_rate(*points, body_a, body_b, n, n_dot)
    theirs = contact.separation_rate(bodies, contacts)
    np.testing.assert_allclose(mine, theirs, atol=1e-13)
    scene = moving_contact(kind, seed=seed)
    contacts = scene.contacts
    motions = motion(scene, contacts.body_a), motion(scene, contacts.body_b)
    mine = formulas.contact_bias(contacts.point, contacts.normal, kind, *motions)
    theirs = contact.separation_acceleration(
        scene.bodies, contacts, scene.force, scene.torque
    )
    np.testing.assert_allclose(mine, theirs, atol=1e-12)


@SEEDS
@pytest.mark.parametrize("gap", [0.0, 0.2, -0.05])
@pytest.mark.parametrize("kind", ["face_b", "face_a"])
def test_second_rates_of_faces(kind, gap, seed):
    """The library has -d |N_dot|^2 for the first term and never forms N_ddot."""
    scene = moving_contact(kind, seed=seed, gap=gap)
    contacts, n = scene.contacts, scene.contacts.normal
    a, b = motion(scene, contacts.body_a), motion(scene, contacts.body_b)
    omega, omega_dot = (b if kind == "face_b" else a)[2::2]
    n_dot = np.cross(omega, n)
    n_ddot = np.cross(omega_dot, n) + np.cross(omega, n_dot)
    points = contacts.point_a, contacts.point_b
    mine = formulas.separation_acceleration(*points, a, b, n, n_dot, n_ddot)
    theirs = contact.separation_acceleration(
        scene.bodies, contacts, scene.force, scene.torque
    )
    np.testing.assert_allclose(mine, theirs, rtol=1e-12, atol=1e-12)


@SEEDS
def test_rate_of_the_normal_of_edges(seed):
    scene = moving_contact("edges", seed=seed, gap=0.2)
    contacts, omega = scene.contacts, scene.bodies.angular_velocity
    edges = contacts.edge_a[0], contacts.edge_b[0]
    mine = formulas.edge_normal_rate(*edges, *omega, contacts.normal[0])
    theirs = contact.normal_rate(scene.bodies, contacts)[0]
    np.testing.assert_allclose(mine, theirs, atol=1e-13)


def test_ladder_by_sympy_and_by_points():
    """The derivatives of lessons 13 and 14, with the accelerations of free fall, are
    d_dot and b of the top."""
    scene = ladder(0.9, rate=-0.7, length=3.0)
    contacts = scene.contacts
    motions = motion(scene, contacts.body_a), motion(scene, contacts.body_b)
    b = formulas.contact_bias(contacts.point, contacts.normal, "face_b", *motions)
    top = float(formulas.top_acceleration(0.0, 0.0, -0.7, 0.9, 3.0))
    assert b[1] == pytest.approx(top, abs=1e-14)
    assert b[0] == pytest.approx(-9.81 + 1.5 * 0.49 * np.sin(0.9), abs=1e-14)
    v_y = scene.bodies.velocity[0, 1]
    assert float(formulas.top_rate(v_y, -0.7, 0.9, 3.0)) == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize(
    "scene",
    [table(), tangle(5, 12, np.random.default_rng(2)), random_scene(4, contacts=10)],
    ids=lambda s: s.name,
)
def test_contact_matrix(scene):
    mine = formulas.contact_matrix(*plain(scene.bodies, scene.contacts))
    theirs = scene.system().A.toarray()
    np.testing.assert_allclose(mine, theirs, atol=1e-13 * np.abs(theirs).max())


@SEEDS
def test_contact_forces(seed):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(20, 6, 8))
    a, b = root @ np.swapaxes(root, 1, 2), 5 * rng.normal(size=(20, 6))
    f = rng.uniform(0, 3, (20, 6))
    mine = formulas.complementarity_residual(a, f, b)
    np.testing.assert_allclose(mine, complementarity_residual(a, f, b), rtol=1e-13)
    for one, bias in zip(a, b, strict=True):
        forces = solve_pivot(one, bias).force
        np.testing.assert_allclose(formulas.pivot(one, bias), forces, atol=1e-9)
    mine, theirs = formulas.solve_contact_qp(a[0], b[0]), solve_qp(a[0], b[0])[0]
    np.testing.assert_allclose(mine, theirs, atol=1e-6)


def test_sweeps():
    """A chain in colours is swept as odd, then even contacts: the same limit, not the
    same path."""
    system = stack(6, corners=1).system()
    a = system.A.toarray()
    mine = formulas.projected_gauss_seidel(a, system.b, np.zeros(6), 400)
    theirs = solve_projected_gauss_seidel(a, system.b, tolerance=1e-13).force
    np.testing.assert_allclose(mine, theirs, rtol=1e-9)


@SEEDS
def test_overlaps_of_simple_shapes(seed):
    rng = np.random.default_rng(seed)
    a, b, c, d, x = rng.uniform(-2, 2, (5, 300, 3))
    c[:20], d[:20] = a[:20] + 0.7, b[:20] + 0.7  # parallel
    b[20:40] = a[20:40]  # only a point
    r, big = rng.uniform(0.1, 1.0, (2, 300))
    lower, upper = np.minimum(c, d), np.maximum(c, d)
    first = np.minimum(a, x), np.maximum(a, x)
    for name, given in (
        ("spheres_overlap", (a, r, c, big)),
        ("boxes_overlap", (*first, lower, upper)),
    ):
        mine, theirs = (getattr(m, name)(*given) for m in (formulas, overlap))
        assert np.array_equal(mine, theirs) and 0 < mine.sum() < 300
    for name, given in (
        ("closest_point_on_segment", (x, a, b)),
        ("sphere_capsule_gap", (x, r, a, b, big)),
        ("capsule_gap", (a, b, r, c, d, big)),
        ("sphere_box_gap", (x, r, lower, upper)),
    ):
        mine, theirs = (getattr(m, name)(*given) for m in (formulas, overlap))
        np.testing.assert_allclose(mine, theirs, atol=1e-13, err_msg=name)
