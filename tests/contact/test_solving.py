"""``solve``: closed forms, all methods against each other, what has no solution, batches, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import block_diag, csr_array

from course.contact import (
    ContactSystem,
    NoContactForce,
    NotConverged,
    contact_system,
    solve,
)
from course.contact.engine.methods import METHODS
from course.contact.solvers import complementarity_residual
from course.scenes import (
    GRAVITY,
    about_to_part,
    cannonballs,
    leaning_rod,
    on_a_moving_ground,
    pile,
    random_scene,
    shaken,
    side_by_side,
    spinning_between_pins,
    stack,
    table,
    tangle,
    wall,
    wedged_ball,
    weighed_anew,
    with_duplicates,
)

each_method = pytest.mark.parametrize("method", METHODS)


def seeded(seed):
    """A generator of one's own: what is drawn depends on nothing that was drawn before."""
    return np.random.default_rng(seed)


SCENES = {
    "table": table(),
    "stack": stack(6),
    "wall, shaken": shaken(wall(4, 3), seeded(11)),
    "pile": pile(15, seeded(12)),
    "cannonballs, duplicates": with_duplicates(cannonballs(3), seeded(13)),
    "tangle": tangle(6, 40, seeded(14)),
    "moving": on_a_moving_ground(stack(3), [1.0, 2, 3], [0.5, 1, -1]),
}  # fmt: skip


def within(scene, solution, tolerance=1e-10):
    """The definition, computed here once more."""
    system = scene.system()
    a = system.A.toarray()
    w = a @ solution.force + system.b
    assert np.all(solution.force >= 0)
    np.testing.assert_allclose(
        solution.acceleration, w, atol=1e-9 * (1 + np.abs(system.b).max(initial=0))
    )
    scale = np.abs(a) @ solution.force + np.abs(system.b).max(initial=0)
    worst = np.max(
        np.abs(np.minimum(np.diag(a) * solution.force, w)) / scale, initial=0
    )
    assert worst == pytest.approx(solution.residual, abs=1e-14)
    return worst <= tolerance


@each_method
def test_table_with_an_offset_centre(method):
    """TRUTHS: least-norm forces (.341667, .241667, .158333, .258333) m g; all answers add t (1, -1, 1, -1)."""
    solution = solve(
        table(offset=(0.1, 0.05), half_widths=(0.5, 0.3)).system(), method=method
    )
    least = np.array([0.341667, 0.241667, 0.158333, 0.258333])
    exact = 0.25 * (
        1 + np.array([1, -1, -1, 1]) * 0.1 / 0.5 + np.array([1, 1, -1, -1]) * 0.05 / 0.3
    )
    np.testing.assert_allclose(exact, least, atol=5e-7)
    f = solution.force / GRAVITY
    null = np.array([1.0, -1, 1, -1])
    t = (f - exact) @ null / 4
    np.testing.assert_allclose(f, exact + t * null, rtol=0, atol=1e-9)
    assert 0.183333 - 1e-6 <= f[0] <= 0.583333 + 1e-6
    assert f.sum() == pytest.approx(1, abs=1e-9)
    np.testing.assert_allclose(solution.acceleration, 0, atol=1e-9)
    assert solution.converged


@each_method
@pytest.mark.parametrize("angle", [0.0, 0.3, 1.0, 1.5])
def test_rod_let_go(method, angle):
    """The ground carries m g/(1 + 3 cos^2 angle)."""
    force = solve(leaning_rod(angle).system(), method=method).force
    assert force[0] == pytest.approx(GRAVITY / (1 + 3 * np.cos(angle) ** 2), abs=1e-9)


@each_method
def test_stack_carries_what_lies_above(method):
    masses = np.array([1.0, 5, 0.2, 3])
    tolerance = (
        1e-13 if method in ("projected_gauss_seidel", "gauss") else 1e-10
    )  # residual is not yet error
    force = solve(
        stack(4, mass=masses, corners=1).system(), method=method, tolerance=tolerance
    ).force
    np.testing.assert_allclose(
        force, GRAVITY * np.cumsum(masses[::-1])[::-1], rtol=1e-9
    )


@each_method
def test_ball_in_a_groove(method):
    """Two walls that lean by 0.5: each carries m g/(2 sin .5); upright ones carry nothing, or any t on both."""
    force = solve(wedged_ball(0.5).system(), method=method).force
    np.testing.assert_allclose(force, GRAVITY / (2 * np.sin(0.5)), rtol=1e-9)
    upright = wedged_ball(0.0).system()
    solution = solve(upright, method=method)
    assert solution.residual == 0 and np.all(solution.force == 0)
    assert complementarity_residual(upright.A, [3.0, 3.0], upright.b) < 1e-15


@each_method
def test_foot_outside_the_support_lifts(method):
    """Misprint 14: feet at +-.5, centre at .7; forcing d_ddot = 0 gives (-.2, 1.2) m g, a foot that pulls."""
    scene = table(2, offset=(0.7, 0.0))
    scene = replace(
        scene,
        contacts=replace(scene.contacts, point=np.array([[-0.5, 0, 0], [0.5, 0, 0]])),
    )
    system = scene.system()
    both = np.linalg.solve(system.A.toarray(), -system.b) / GRAVITY
    np.testing.assert_allclose(both, [-0.2, 1.2], rtol=1e-12)
    solution = solve(system, method=method)
    assert solution.force[0] == pytest.approx(0, abs=1e-9) and solution.force[1] > 1
    assert (
        solution.acceleration[0] > 0.1
        and abs(solution.acceleration[1]) < 1e-8
        and solution.converged
    )


@each_method
@pytest.mark.parametrize("name", SCENES)
@pytest.mark.slow
def test_methods_agree_on_what_bodies_do(method, name):
    """f need not be unique; A f is, for every positive semidefinite A."""
    scene = SCENES[name]
    system = scene.system()
    solution = solve(system, method=method)
    tolerance = 1e-10
    if method in ("projected_gauss_seidel", "qp") and not solution.converged:
        tolerance = (
            solution.residual
        )  # sweeps are slow, and Clarabel stops at its own gap
        assert solution.residual < 1e-4 and (
            method == "qp" or solution.iterations == 10_000
        )
    assert within(scene, solution, tolerance) and solution.method.startswith(method)
    moved = system.inverse_mass @ (system.jacobian.T @ solution.force)
    truth = solve(system, method="pivot")
    expected = system.inverse_mass @ (system.jacobian.T @ truth.force)
    size = np.abs(expected).max() + np.abs(system.b).max()
    np.testing.assert_allclose(
        moved, expected, rtol=0, atol=(1e-6 if solution.converged else 1e-2) * size
    )


def test_qp_with_a_known_answer():
    """QPTEST of Maros and Meszaros (in qpsolvers' tests): x = (.7625, .475) is the nearest allowed acceleration."""
    p, q = np.array([[8.0, 2], [2, 10]]), np.array([1.5, -2])
    g = np.array([[-2.0, -1], [-1, 2], [-1, 0], [0, -1], [1, 0]])
    h = np.array([-2.0, 6, 0, 0, 20])
    inverse = np.eye(6)
    inverse[:2, :2] = np.linalg.inv(p)
    jacobian = np.zeros((5, 6))
    jacobian[:, :2] = -g
    free = np.zeros(6)
    free[:2] = -np.linalg.solve(p, q)
    a = jacobian @ inverse @ jacobian.T
    system = ContactSystem(
        a, jacobian @ free + h, csr_array(jacobian), csr_array(inverse), free
    )
    for method in METHODS:
        x = free + inverse @ jacobian.T @ solve(system, method=method).force
        np.testing.assert_allclose(x, [0.7625, 0.475, 0, 0, 0, 0], atol=1e-9)


UNSOLVABLE = {
    "two contacts": ContactSystem(np.array([[1.0, -1], [-1, 1]]), np.array([-1.0, -1])),
    "pins": spinning_between_pins(2.0).system(),
    "pins under gravity": side_by_side(
        [table(), spinning_between_pins(3.0, gravity=GRAVITY), stack(3)]
    ).system(),
    "nothing pushes": ContactSystem(np.array([[0.0, 0], [0, 1]]), np.array([-1.0, -1])),
    "pins in a wall": side_by_side([wall(7, 7), spinning_between_pins(1e-2)]).system(),
}


@pytest.mark.parametrize("name", UNSOLVABLE)
def test_states_without_a_solution_come_with_the_proof(name):
    system = UNSOLVABLE[name]
    with pytest.raises(NoContactForce, match="no contact forces") as error:
        solve(system)
    y = error.value.certificate
    assert y.shape == system.b.shape and np.all(y >= 0) and y.max() == 1
    np.testing.assert_allclose(system.A @ y, 0, atol=1e-12)
    assert system.b @ y < 0
    if system.jacobian is not None:
        np.testing.assert_allclose(system.jacobian.T @ y, 0, atol=1e-12)


@pytest.mark.parametrize(
    "bodies, contacts",
    [(3, 60), (10, 300), pytest.param(40, 600, marks=pytest.mark.slow)],
)
@pytest.mark.parametrize("with_bodies", [True, False])
def test_forces_that_run_away_are_no_solution(bodies, contacts, with_bodies):
    """Far more contacts than bodies can obey, each with a d_ddot of its own: the residual, which is relative to the
    forces, falls below any tolerance as these grow, while some contact approaches at 1 m/s^2."""
    rng = np.random.default_rng([6, bodies])
    system = tangle(bodies, contacts, rng).system()
    b = system.b + rng.normal(size=contacts)
    parts = (
        (system.jacobian, system.inverse_mass, system.free_acceleration)
        if with_bodies
        else ()
    )
    with pytest.raises(NoContactForce) as error:
        solve(ContactSystem(system.A, b, *parts))
    y = error.value.certificate
    assert (
        np.all(y >= 0)
        and b @ y < -1e-3
        and np.abs(system.jacobian.T @ y).max() < 1e-11 * y.sum()
    )


@pytest.mark.parametrize("method", [m for m in METHODS if m != "auto"])
@pytest.mark.parametrize("name", ["two contacts", "nothing pushes"])
def test_only_auto_raises(method, name):
    system = UNSOLVABLE[name]
    if method == "gauss":
        pytest.skip("needs a jacobian")
    solution = solve(system, method=method, max_iterations=50)
    assert not solution.converged and solution.residual > 1e-3
    assert np.all(np.isfinite(solution.force)) and np.all(
        np.isfinite(solution.acceleration)
    )


def test_pins_without_spin_have_a_solution():
    assert solve(spinning_between_pins(0.0).system()).residual == 0


@each_method
def test_no_contacts_and_contacts_that_are_about_to_part(method):
    nothing = random_scene(1, contacts=0).system()
    solution = solve(nothing, method=method)
    assert (
        solution.force.shape == (0,) and solution.residual == 0 and solution.converged
    )
    for acceleration in (0.0, 1.0):
        system = about_to_part(table(), acceleration).system()
        solution = solve(system, method=method)
        assert np.all(solution.force == 0) and solution.residual == 0
        np.testing.assert_allclose(solution.acceleration, acceleration, atol=1e-14)


def test_not_converged_keeps_what_was_reached():
    system = shaken(wall(3, 3), np.random.default_rng(3)).system()
    with pytest.raises(NotConverged, match="best residual is") as error:
        solve(system, tolerance=1e-40)
    kept = error.value.solution
    assert not kept.converged and 0 < kept.residual < 1e-12
    again = complementarity_residual(system.A, kept.force, system.b)
    assert kept.residual == pytest.approx(
        again, rel=0, abs=1e-15
    )  # sums in another order


def test_a_matrix_that_is_no_contact_matrix():
    """Symmetric with a positive diagonal, but with an eigenvalue below 0: refused once the methods fail on it."""
    with pytest.raises(
        ValueError,
        match="A: expected a positive semidefinite matrix; got eigenvalue -2",
    ):
        solve(ContactSystem(np.array([[1.0, -3], [-3, 1]]), np.array([-1.0, -2])))


@each_method
def test_says_when_it_has_not_converged(method):
    system = shaken(wall(6, 6), np.random.default_rng(3)).system()
    if method in ("auto", "nnls"):
        solution = solve(system, method=method, tolerance=1e-10)
        assert solution.converged
    else:
        solution = solve(system, method=method, max_iterations=2)
        assert not solution.converged and solution.residual > 1e-10
    assert solution.residual == complementarity_residual(
        system.A, solution.force, system.b
    )


def test_mass_ratio_of_a_million():
    system = stack(3, mass=[1e-3, 1e3, 1e-3]).system()
    heavy = weighed_anew(
        wall(3, 3), 10.0 ** np.random.default_rng(2).choice([-3, 3], 9)
    ).system()
    for each in (system, heavy):
        assert solve(each).residual <= 1e-10
        assert solve(each, method="gauss").residual <= 1e-10


def test_islands_do_not_disturb_each_other():
    scenes = [table(offset=(0.1 * k, 0.05)) for k in range(4)] + [
        stack(4),
        pile(6, np.random.default_rng(4)),
        wall(8, 8),
    ]
    together = solve(side_by_side(scenes).system())
    assert (
        together.residual <= 1e-10
        and "block_pivot" in together.method
        and "gauss" in together.method
    )
    alone = np.concatenate([solve(s.system()).acceleration for s in scenes])
    np.testing.assert_allclose(together.acceleration, alone, atol=1e-8)


def batch(count=7):
    rng = np.random.default_rng(5)
    systems = [
        table(4, offset=tuple(rng.uniform(-0.6, 0.6, 2))).system() for _ in range(count)
    ]
    return np.stack([s.A.toarray() for s in systems]), np.stack([s.b for s in systems])


@pytest.mark.parametrize("method", [m for m in METHODS if m != "gauss"])
def test_a_batch_is_its_systems_one_by_one(method):
    a, b = batch(6)
    solution = solve(
        ContactSystem(a.reshape(2, 3, 4, 4), b.reshape(2, 3, 4)), method=method
    )
    assert solution.force.shape == (
        2,
        3,
        4,
    ) and solution.residual.shape == solution.converged.shape == (2, 3)
    assert np.shape(solution.iterations) == (2, 3) and np.all(solution.converged)
    for k in range(6):
        one = solve(ContactSystem(a[k], b[k]), method=method)
        np.testing.assert_allclose(
            solution.acceleration.reshape(6, 4)[k], one.acceleration, atol=1e-8
        )


def test_a_batch_with_a_system_that_has_no_solution():
    a, b = batch(5)
    a[3], b[3] = (
        block_diag([[[1.0, -1], [-1, 1]], np.eye(2)]).toarray(),
        [-1.0, -1, -1, 0],
    )
    with pytest.raises(NoContactForce, match="system 3 of the batch") as error:
        solve(ContactSystem(a, b))
    y = error.value.certificate
    assert y.shape == (5, 4) and not np.any(np.delete(y, 3, axis=0))
    np.testing.assert_allclose(y[3], [1, 1, 0, 0], rtol=1e-14)


def test_large_batches_and_large_systems_in_a_batch():
    rng = np.random.default_rng(8)
    g = rng.normal(size=(3000, 5, 4))  # 5 directions, 4 contacts: a unique force
    t = rng.normal(size=(3000, 5))
    a, b = np.swapaxes(g, 1, 2) @ g, -np.einsum("skc,sk->sc", g, t)
    assert solve(ContactSystem(a, b)).residual.max() <= 1e-10
    big = stack(40).system()
    pair = ContactSystem(np.stack([big.A.toarray()] * 2), np.stack([big.b, 2 * big.b]))
    solution = solve(pair)
    assert solution.residual.max() <= 1e-10
    np.testing.assert_allclose(solution.acceleration, 0, atol=1e-7)


def test_a_start_that_solves_the_system_is_kept():
    system = table().system()
    first = solve(system)
    again = solve(system, start=first.force)
    assert (
        np.array_equal(again.force, first.force)
        and again.iterations == 0
        and again.method == "auto: start"
    )
    assert solve(system, start=np.zeros(4)).residual <= 1e-10


def test_a_and_b_alone_are_enough_for_all_but_gauss():
    whole = shaken(wall(8, 8), np.random.default_rng(6)).system()
    bare = ContactSystem(whole.A, whole.b)
    assert len(bare) > 400
    assert solve(bare).residual <= 1e-10
    np.testing.assert_allclose(
        solve(bare).acceleration, solve(whole).acceleration, atol=1e-7
    )
    with pytest.raises(ValueError, match="jacobian"):
        solve(bare, method="gauss")


def test_inputs_are_not_written_to():
    system = shaken(wall(4, 4), np.random.default_rng(7)).system()
    a, b, start = system.A.copy(), system.b.copy(), np.ones(len(system))
    for method in METHODS:
        solve(system, method=method, start=start)
    assert (
        abs(system.A - a).max() == 0
        and np.array_equal(system.b, b)
        and np.all(start == 1)
    )


def test_refusals():
    system = table().system()
    for arguments, match in (
        ({"method": "lemke"}, "method.*'auto'"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"max_iterations": 0}, "max_iterations"),
        ({"relaxation": 2.0}, "relaxation"),
        ({"start": np.zeros(3)}, "start"),
        ({"start": np.full(4, np.nan)}, "start"),
    ):
        with pytest.raises(ValueError, match=match):
            solve(system, **arguments)
    with pytest.raises(ValueError, match="system"):
        solve((system.A, system.b))


def test_forces_are_those_that_bodies_feel():
    """A box thrown to slide and spin on a turning table keeps to it: the whole way from bodies to d_ddot."""
    scene = on_a_moving_ground(table(), [0.3, 0, 0], [0, 0, 4.0], mass=50.0)
    system = contact_system(scene.bodies, scene.contacts, scene.force, scene.torque)
    solution = solve(system)
    np.testing.assert_allclose(solution.acceleration, 0, atol=1e-9)
    # The ground gives way and, pushed .1 and .05 off its centre, turns with the table on it.
    gives = 1 + 1 / 50 + 0.05**2 / (50 + 0.2) + 0.1**2 / (50 + 0.3)
    assert solution.force.sum() == pytest.approx(GRAVITY / gives, rel=1e-9)
