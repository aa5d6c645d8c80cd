"""``solve`` on systems that no geometry would make: within the tolerance, or a plain word that there is none."""

import warnings

import numpy as np
import pytest
from scipy.sparse import csr_array

from course.contact import ContactSystem, NoContactForce, NotConverged, solve
from course.contact.engine.methods import METHODS

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def hostile(seed):
    """J, b, with J M^-1 J' = J J': rounded, repeated and empty rows, ratios to 1e12, b from 1e-310 to 1e100."""
    rng = np.random.default_rng([4711, seed])
    c = int(rng.integers(1, 25))
    m = 6 * int(rng.integers(1, c // 6 + 2))
    j = rng.normal(size=(c, m))
    changes = {
        "whole": lambda j: np.rint(j),
        "contacts of other size": lambda j: j * 10.0 ** rng.uniform(-6, 6, (c, 1)),
        "mass ratio": lambda j: j * 10.0 ** rng.uniform(-3, 3, m),
        "repeated": lambda j: j[rng.integers(c, size=c)],
        "nothing moves": lambda j: np.where(rng.uniform(size=(c, 1)) < 0.3, 0.0, j),
        "nearly parallel": lambda j: j[:1] + 10.0 ** rng.uniform(-9, -1) * j,
        "enormous": lambda j: j * 1e60,
        "minute": lambda j: j * 1e-60,
    }
    for change in changes.values():
        if rng.uniform() < 0.2:
            j = change(j)
    b = [rng.normal(size=c), j @ rng.normal(size=m), -np.abs(rng.normal(size=c))][
        rng.integers(3)
    ]
    if rng.uniform() < 0.3:
        b = b * 10.0 ** rng.choice([-310, -150, 100]) * 10.0 ** rng.uniform(-5, 5, c)
    return j, b


def system_of(j, b, sparse):
    a = j @ j.T
    m = j.shape[1]
    return ContactSystem(
        csr_array(a) if sparse else a,
        b,
        csr_array(j),
        csr_array(np.eye(m)),
        np.zeros(m),
    )


def checked(system, solution):
    for value in (solution.force, solution.acceleration, solution.residual):
        assert np.all(np.isfinite(value))
    assert np.all(solution.force >= 0)
    assert not solution.converged or solution.residual <= 1e-10


@pytest.mark.parametrize("seed", range(60))
def test_every_method_answers_or_says_that_it_did_not(seed):
    j, b = hostile(seed)
    system = system_of(j, b, seed % 2)
    for method in METHODS[
        2:
    ]:  # without "qp", which takes as long as all others; see below
        limit = 200 if method == "projected_gauss_seidel" else None
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # no NaN on the way either
            checked(system, solve(system, method=method, max_iterations=limit))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60, 100))
def test_the_quadratic_programme_as_well(seed):
    system = system_of(*hostile(seed), seed % 2)
    checked(system, solve(system, method="qp"))


@pytest.mark.parametrize("seed", range(200))
def test_auto_gives_forces_or_the_proof_or_the_best_there_is(seed):
    j, b = hostile(seed)
    system = system_of(j, b, seed % 2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            solution = solve(system)
        except NoContactForce as error:
            y = error.certificate
            assert np.all(y >= 0) and y.max() == 1 and b @ y < 0
            length = np.sqrt(np.sum(j * j, axis=1)) * y
            assert np.all(np.abs(j.T @ y) <= 1e-11 * length.sum())
        except NotConverged as error:
            checked(system, error.solution)
            # Only where A is singular to rounding: nothing that bodies could do.
            assert "nearly singular" in str(error)
        else:
            checked(system, solution)
            assert (
                solution.residual <= 1e-10
                and solution.acceleration.min() >= -1e-3 * np.abs(b).max()
            )
