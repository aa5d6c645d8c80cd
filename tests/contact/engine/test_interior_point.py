"""Gauss' principle: the interior point method, its eliminations, and the set of pushing contacts it ends with."""

import numpy as np
import pytest

from course.contact.engine.active_set import settle
from course.contact.engine.banded_cholesky import BandedCholesky
from course.contact.engine.interior_point import solve_gauss
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.engine.regularization import (
    RegularizedByAccelerations,
    RegularizedByForces,
    RegularizedDense,
    regularized,
)
from course.contact.engine.scaling import ScaledSystem
from course.contact.engine.sparse_cholesky import SparseCholesky
from course.scenes import (
    cannonballs,
    on_a_moving_ground,
    pile,
    random_scene,
    shaken,
    stack,
    tangle,
    wall,
    weighed_anew,
    with_duplicates,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def seeded(seed):
    """A generator of one's own: what is drawn depends on nothing that was drawn before."""
    return np.random.default_rng(seed)


WALL = shaken(wall(6, 5), seeded(4))


def scaled_system(scene):
    system = scene.system()
    return ScaledSystem(system.A, system.b, lambda: mass_weighted_jacobian(system))


def test_factor_of_the_contact_matrix():
    for scene in (
        WALL,
        on_a_moving_ground(pile(8, seeded(5)), [1.0, 0, 0], [1.0, 2, 3]),
        tangle(5, 20, seeded(6)),
    ):
        system = scene.system()
        rows = mass_weighted_jacobian(system)
        np.testing.assert_allclose(
            (rows @ rows.T).toarray(),
            system.A.toarray(),
            rtol=0,
            atol=1e-12 * abs(system.A).max(),
        )


def eliminations(unit):
    from scipy.sparse import csr_array, diags_array

    scale = diags_array(1 / unit.root)
    a, rows = csr_array(scale @ unit.matrix @ scale), csr_array(scale @ unit._rows())
    rows = rows[:, np.unique(rows.indices)]
    pattern = csr_array(
        (np.ones(rows.nnz), rows.indices, rows.indptr), shape=rows.shape
    )
    kinds = (BandedCholesky, SparseCholesky)
    return a.toarray(), [
        RegularizedDense(a.toarray()), *(RegularizedByForces(a, kind(a)) for kind in kinds),
        *(RegularizedByAccelerations(rows, kind(csr_array(pattern.T @ pattern))) for kind in kinds),
    ]  # fmt: skip


@pytest.mark.parametrize(
    "scene", [WALL, pile(20, seeded(7)), tangle(6, 30, seeded(8))], ids=lambda s: s.name
)
def test_all_eliminations_of_one_equation(scene):
    """(A + diag(1/theta)) x = q, x = 0 where theta = 0."""
    unit = scaled_system(scene)
    a, ways = eliminations(unit)
    rng = np.random.default_rng(1)
    theta = np.where(
        rng.uniform(size=len(unit)) < 0.3, 0.0, 10.0 ** rng.uniform(-3, 3, len(unit))
    )
    q = rng.normal(size=len(unit))
    on = theta > 0
    expected = np.zeros(len(unit))
    expected[on] = np.linalg.solve(a[np.ix_(on, on)] + np.diag(1 / theta[on]), q[on])
    for each in ways:
        each.factor(theta)
        np.testing.assert_allclose(
            each.solve(q), expected, atol=1e-8 * np.abs(expected).max()
        )
        np.testing.assert_allclose(each.times(q), a @ q, atol=1e-12 * len(unit))


def test_the_cheapest_elimination_is_chosen():
    assert isinstance(scaled_system(stack(3)).operator, RegularizedDense)
    assert isinstance(scaled_system(wall(12, 12)).operator, RegularizedByAccelerations)
    chain = stack(300, corners=1).system()
    assert isinstance(ScaledSystem(chain.A, chain.b).operator, RegularizedByForces)
    assert isinstance(regularized(np.eye(200)), RegularizedDense)
    with pytest.raises(np.linalg.LinAlgError):
        regularized(np.array([[1.0, -3], [-3, 1]])).factor(np.ones(2))


CASES = {
    "wall": wall(8, 8), "wall shaken": shaken(wall(8, 8), seeded(11)), "tall": stack(80),
    "pile": pile(60, seeded(12)), "pile shaken": shaken(pile(60, seeded(13)), seeded(14)),
    "cannonballs shaken": shaken(cannonballs(6), seeded(15)),
    "duplicates": with_duplicates(wall(6, 6), seeded(16)),
    "tangle": tangle(10, 200, seeded(17)), "loose": tangle(100, 200, seeded(18)),
    "mass ratio": weighed_anew(wall(7, 7), 10.0 ** seeded(19).uniform(-3, 3, len(wall(7, 7).bodies))),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_reaches_the_tolerance(name):
    unit = scaled_system(CASES[name])
    found = solve_gauss(unit)
    assert (
        found.residual <= 1e-10 and np.all(found.force >= 0) and found.iterations < 60
    )
    assert unit.residual(found.force * unit.root) == pytest.approx(
        found.residual, abs=1e-15
    )


@pytest.mark.parametrize("seed", range(10))
def test_random_scenes(seed):
    unit = scaled_system(random_scene([57, seed], contacts=150))
    if len(unit) and np.any(unit.bias < 0):
        assert solve_gauss(unit).residual <= 1e-10


def test_iterations_hardly_grow_with_the_wall():
    """Between 60 and 15 times as many contacts it is a matter of a few iterations."""
    counts = [
        solve_gauss(
            scaled_system(shaken(wall(n, n), np.random.default_rng(2)))
        ).iterations
        for n in (3, 6, 12)
    ]
    assert max(counts) <= 15


def test_stops_at_its_limit():
    found = solve_gauss(scaled_system(WALL), max_iterations=3)
    assert (
        found.iterations == 3
        and found.residual > 1e-10
        and np.all(np.isfinite(found.force))
    )


def test_settle_mends_a_guess_that_is_nearly_right():
    unit = scaled_system(CASES["pile shaken"])
    truth = solve_gauss(unit, tolerance=1e-13)
    pushing = truth.force > 1e-9
    first, last = np.flatnonzero(pushing)[0], np.flatnonzero(~pushing)[-1]
    pushing[first], pushing[last] = False, True
    found = settle(unit, np.zeros(len(unit)), pushing, tolerance=1e-12)
    assert found.residual <= 1e-12 and 2 <= found.iterations <= 6
    hopeless = settle(unit, np.zeros(len(unit)), ~pushing, tolerance=1e-12)
    assert hopeless.residual > 1e-12 and hopeless.iterations == 1
