"""Every method judged by the exact answer, on thousands of small systems made to mislead it.

What is asked of an answer. Data: each entry of A may be off by a few units in
its last place, b by as many of max |b|. Forces of "auto" solve a system within
that of the stored one (backward error below 16 c eps), and where they are large
beside b, so that this says little, they are right to 1e-9; where A is singular
to rounding the tolerance is enough. A proof that there are none holds for the
stored A to one unit in the last place. Only where A is nearly singular may a
method fail.
"""

import warnings
from dataclasses import dataclass

import numpy as np
import pytest
from contact.exact_truth import moved, truth_of, violations
from scipy.sparse import csr_array

from course.contact import ContactSystem, NoContactForce, NotConverged, solve
from course.contact.solvers.certificate import certificate
from course.contact.solvers.nnls import solve_nnls
from course.contact.solvers.pivot import solve_pivot

EPS = np.finfo(float).eps
METHODS = ("auto", "nnls", "pivot", "projected_gauss_seidel", "gauss")


def heavy_on_light(rng, c):
    """Light bodies below heavy ones: differences of pushes count for 1/M, M up to 1e17."""
    a = np.eye(c)
    for k in range(1, c):
        a[k, k] += 10.0 ** -rng.uniform(0, 17)
        a[k, k - 1] = a[k - 1, k] = rng.choice([-1.0, 1.0])
        a[k - 1, k - 1] += k > 1
    return a, -rng.uniform(0, 10, c) * (rng.uniform(size=c) < 0.7)


def graded(rng, c):
    """Masses and arms from 1e-12 to 1e12."""
    j = rng.normal(size=(c, c + 1)) * 10.0 ** rng.uniform(-6, 6, (c, 1))
    return j @ j.T, rng.normal(size=c)


def redundant(rng, c):
    """Fewer freedoms than contacts, rounded: b that bodies can obey, or not."""
    j = rng.normal(size=(c, int(rng.integers(1, c + 1))))
    j = j[rng.integers(c, size=c)]
    b = j @ rng.normal(size=j.shape[1])
    return j @ j.T, b if rng.uniform() < 0.5 else rng.normal(size=c)


def whole_numbers(rng, c):
    """Small whole numbers: singular exactly or not at all."""
    g = rng.integers(-3, 4, (int(rng.integers(1, c + 2)), c)).astype(float)
    b = -g.T @ rng.integers(-3, 4, len(g)) if rng.uniform() < 0.5 else rng.integers(-3, 4, c)
    return g.T @ g, b.astype(float)


def nearly_whole(rng, c):
    """The same with entries of the diagonal a little larger, and b a little off."""
    a, b = whole_numbers(rng, c)
    size = 10.0 ** -rng.uniform(2, 17)
    a = a + np.diag(size * rng.integers(0, 2, c))
    return a, b + 10.0 ** -rng.uniform(2, 20) * rng.integers(-1, 2, c)


def nearly_parallel(rng, c):
    """Rows of J that differ by 1e-1 to 1e-9."""
    j = rng.normal(size=(1, c)) + 10.0 ** -rng.uniform(1, 9) * rng.normal(size=(c, c))
    return j @ j.T, rng.normal(size=c)


def indefinite(rng, c):
    """A semidefinite A with something taken off."""
    a, b = whole_numbers(rng, c)
    if rng.uniform() < 0.5:
        a[0, 1] = a[1, 0] = a[0, 1] + 10.0 ** -rng.uniform(-1, 12)
    else:
        v = rng.normal(size=c)
        a = a - 10.0 ** -rng.uniform(-1, 12) * np.outer(v, v)
    a = (a + a.T) / 2
    np.fill_diagonal(a, np.maximum(a.diagonal(), 0))
    return a, b


FAMILIES = (
    heavy_on_light,
    graded,
    redundant,
    whole_numbers,
    nearly_whole,
    nearly_parallel,
    indefinite,
)


@dataclass
class Case:
    a: np.ndarray
    b: np.ndarray

    def __post_init__(self):
        self.truth = truth_of(self.a, self.b)
        self.count = len(self.b)
        self.noise = 16 * self.count * EPS

    def system(self, kind="dense"):
        return ContactSystem(csr_array(self.a) if kind == "sparse" else self.a, self.b)

    def with_jacobian(self):
        """Rows whose products are A, by eigenvectors, with masses of 1."""
        values, columns = np.linalg.eigh(self.a)
        width = 6 * ((self.count + 5) // 6)
        j = np.zeros((self.count, width))
        j[:, : self.count] = columns * np.sqrt(np.maximum(values, 0.0))
        one = csr_array(np.eye(width))
        return ContactSystem(self.a, self.b, csr_array(j), one, np.zeros(width))


def drawn(family, seed):
    rng = np.random.default_rng([FAMILIES.index(family), *np.atleast_1d(seed)])
    return Case(*family(rng, int(rng.integers(2, 5))))


def judge_error(case, error):
    truth = case.truth
    if isinstance(error, ValueError):
        assert truth.verdict == "indefinite", "A is semidefinite"
    elif isinstance(error, NoContactForce):
        judge_certificate(case, error.certificate)
    else:
        assert isinstance(error, NotConverged)
        if truth.verdict == "forces" and truth.gap > 1e-11:
            _, size, largest = violations(case.a, case.b, truth.force)
            assert max(size) > 1e12 * largest, "there are forces"
        # What is impossible by more than the tolerance is proved, where A is singular beyond doubt.
        assert not (truth.verdict == "none" and truth.gap > 1e-8), "no proof"


def judge_certificate(case, y):
    truth = case.truth
    assert truth.verdict != "indefinite" or truth.least > -1e-12 * case.count
    assert np.all(y >= 0) and y.max() > 0 and case.b @ y < 0
    # The proof holds to a unit in the last place; so does its own rounding.
    assert moved(case.a, y) <= 2.1 * EPS
    if truth.verdict == "forces":
        _, size, largest = violations(case.a, case.b, truth.force)
        assert max(size) > 1e11 * largest, "there are forces"


def judge_forces(case, solution):
    """Forces of "auto"."""
    truth, a, b = case.truth, case.a, case.b
    assert solution.converged and solution.residual <= 1e-10
    assert truth.verdict != "indefinite" or truth.least > -1.1e-9
    off, size, largest = violations(a, b, solution.force)
    backward = max((float(o / s) for o, s in zip(off, size, strict=True) if s), default=0.0)  # fmt: skip
    if backward > case.noise:
        assert truth.least <= case.noise and backward <= 1e-10
        assert max(off) <= 1.01e-8 * largest
    if truth.verdict == "none":
        assert max(off) <= 1.01e-8 * largest
    if truth.verdict == "forces" and truth.regular and max(size) > 1e4 * largest:
        f = np.array([float(x) for x in truth.force])
        np.testing.assert_allclose(solution.force, f, rtol=0, atol=1e-9 * f.max())


def judge_named(case, solution):
    """Forces of any other method: right to 1e-4 where it says that it has converged.

    "gauss" knows A only as J J', which is off by rounding.
    """
    assert np.all(np.isfinite(solution.force)) and np.all(solution.force >= 0)
    if not solution.converged:
        return
    assert solution.residual <= 1e-10
    off, size, largest = violations(case.a, case.b, solution.force)
    assert max(off) <= 1.2e-6 * largest
    truth = case.truth
    if truth.verdict == "forces" and truth.regular and max(size) > 1e4 * largest:
        f = np.array([float(x) for x in truth.force])
        near = 1e-4 + (10 * case.noise / truth.gap if solution.method == "gauss" else 0)
        np.testing.assert_allclose(solution.force, f, rtol=0, atol=near * f.max())


def judged(case, system, method="auto"):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            limit = 100 if method == "projected_gauss_seidel" else None
            solution = solve(system, method=method, max_iterations=limit)
        except (ValueError, NoContactForce, NotConverged) as error:
            assert method == "auto" or isinstance(error, ValueError)
            judge_error(case, error)
            return
    if case.truth.verdict == "indefinite" and system.jacobian is None:
        assert case.truth.least > -1.1e-9, "A is indefinite"
    (judge_forces if method == "auto" else judge_named)(case, solution)


def judge_all(family, seed, slow=False):
    case = drawn(family, seed)
    for kind in ("dense", "sparse"):
        judged(case, case.system(kind))
    for method in METHODS[1:4] + (("qp",) if slow else ()):
        judged(case, case.system(), method)
    if case.truth.verdict == "indefinite":
        return
    judged(case, case.with_jacobian(), "gauss")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        proofs = [
            certificate(case.a, case.b),
            solve_pivot(case.a, case.b).certificate,
            solve_nnls(case.a, case.b).certificate,
        ]
    for y in proofs:
        if y is not None:
            judge_certificate(case, y)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
@pytest.mark.parametrize("seed", range(40))
def test_every_method_by_the_exact_answer(family, seed):
    judge_all(family, seed)
